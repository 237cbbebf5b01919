//! What of a map belongs to buildings.

use std::collections::{HashMap, HashSet};

use super::File;
use super::element::{Element, Kind, Member, Tag, is_of_building};
use super::room::Room;
use crate::error::FormatError;
use crate::limits::Limits;

/// The buildings of a map and what they are made of.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// In the order of the file.
    pub(super) relations: Vec<Relation>,
    /// Those of buildings and those that are members of relations, in the order of the file.
    pub(super) ways: Vec<Way>,
    /// Where in `ways` the way of a number is.
    ways_by_id: HashMap<i64, usize>,
    /// The numbers of the nodes in ways, sorted.
    nodes: Vec<i64>,
    /// Longitude and latitude of each; NaN for one that is not in the file.
    places: Vec<[f64; 2]>,
}

#[derive(Debug)]
pub(super) struct Relation {
    pub(super) id: i64,
    pub(super) members: Vec<Member>,
    pub(super) tags: Vec<Tag<'static>>,
}

#[derive(Debug)]
pub(super) struct Way {
    pub(super) id: i64,
    pub(super) nodes: Vec<i64>,
    /// None for a way that is only a member.
    pub(super) tags: Vec<Tag<'static>>,
}

impl Kept {
    pub(super) fn read(
        file: File<'_>,
        limits: &Limits,
        room: &mut Room,
    ) -> Result<Self, FormatError> {
        let mut kept = Self::default();
        kept.read_relations(file, limits, room)?;
        kept.read_ways(file, limits, room)?;
        kept.read_nodes(file, limits)?;
        Ok(kept)
    }

    /// The way of a number.
    pub(super) fn way(&self, id: i64) -> Option<&Way> {
        self.ways_by_id.get(&id).map(|&index| &self.ways[index])
    }

    /// Where a node is; `None` for one that is not in the file.
    pub(super) fn place(&self, node: i64) -> Option<[f64; 2]> {
        let index = self.nodes.binary_search(&node).ok()?;
        let place = self.places[index];
        place.iter().all(|x| x.is_finite()).then_some(place)
    }

    fn read_relations(
        &mut self,
        file: File<'_>,
        limits: &Limits,
        room: &mut Room,
    ) -> Result<(), FormatError> {
        file.each(Kind::Relation, limits, &mut |element| {
            if let Element::Relation { id, members, tags } = element
                && is_of_building(tags)
                && tags
                    .iter()
                    .any(|(key, value)| key == "type" && value == "multipolygon")
            {
                // A member takes as much as two corners.
                room.take(2 * members.len(), bytes(tags))?;
                self.relations.push(Relation {
                    id,
                    members: members.to_vec(),
                    tags: owned(tags),
                });
            }
            Ok(())
        })
    }

    fn read_ways(
        &mut self,
        file: File<'_>,
        limits: &Limits,
        room: &mut Room,
    ) -> Result<(), FormatError> {
        let members = self.relations.iter().flat_map(|relation| &relation.members);
        let members: HashSet<i64> = (members.filter(|member| member.kind == Kind::Way))
            .map(|member| member.id)
            .collect();
        file.each(Kind::Way, limits, &mut |element| {
            let Element::Way { id, nodes, tags } = element else {
                return Ok(());
            };
            let tags = if is_of_building(tags) { tags } else { &[] };
            if !tags.is_empty() || members.contains(&id) {
                room.take(nodes.len(), bytes(tags))?;
                self.ways_by_id.insert(id, self.ways.len());
                self.ways.push(Way {
                    id,
                    nodes: nodes.to_vec(),
                    tags: owned(tags),
                });
            }
            Ok(())
        })
    }

    fn read_nodes(&mut self, file: File<'_>, limits: &Limits) -> Result<(), FormatError> {
        self.nodes = self
            .ways
            .iter()
            .flat_map(|way| &way.nodes)
            .copied()
            .collect();
        self.nodes.sort_unstable();
        self.nodes.dedup();
        self.places = vec![[f64::NAN; 2]; self.nodes.len()];
        if self.nodes.is_empty() {
            return Ok(());
        }
        let (nodes, places) = (&self.nodes, &mut self.places);
        file.each(Kind::Node, limits, &mut |element| {
            if let Element::Node { id, place } = element
                && let Ok(index) = nodes.binary_search(&id)
            {
                places[index] = place;
            }
            Ok(())
        })
    }
}

fn bytes(tags: &[Tag<'_>]) -> usize {
    // Two strings have three words each, beside their letters.
    tags.iter()
        .map(|(key, value)| key.len() + value.len() + 48)
        .sum()
}

fn owned(tags: &[Tag<'_>]) -> Vec<Tag<'static>> {
    let owned = |text: &str| text.to_owned().into();
    tags.iter()
        .map(|(key, value)| (owned(key), owned(value)))
        .collect()
}
