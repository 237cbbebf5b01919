//! Ways and relations made into buildings.

use std::collections::HashSet;

use ombra_city::{Draft, DraftBuilding, DraftPart};

use super::super::CityOptions;
use super::courtyards::polygons;
use super::element::{Kind, Tag, is_of_building, says, value};
use super::kept::{Kept, Relation, Way};
use super::rings::joined;
use super::room::Room;
use crate::error::{FormatError, plural};

/// Outlines, each with its courtyards.
type Outlines = Vec<Vec<Vec<[f64; 2]>>>;

/// Adds all buildings: those of relations first, then those of ways.
pub(super) fn add(
    draft: &mut Draft,
    kept: &Kept,
    options: &CityOptions,
    room: &mut Room,
) -> Result<(), FormatError> {
    // A way that is the outline of a relation is no second building.
    let mut done = HashSet::new();
    for relation in &kept.relations {
        let place = format!("relation {}", relation.id);
        let outlines = outlines_of_relation(draft, kept, relation, &place, room)?;
        if outlines.is_empty() {
            continue;
        }
        let outer: Vec<&Way> = (relation.members.iter())
            .filter(|member| member.kind == Kind::Way && !member.is_inner)
            .filter_map(|member| kept.way(member.id))
            .collect();
        // What the relation does not tell, its outline may.
        let tagged = outer.iter().find(|way| is_of_building(&way.tags));
        let tags = [&relation.tags[..], tagged.map_or(&[], |way| &way.tags)];
        done.extend(outer.iter().map(|way| way.id));
        building(
            draft,
            ("relation", relation.id),
            place,
            tags,
            outlines,
            options,
        );
    }
    for way in &kept.ways {
        if way.tags.is_empty() || done.contains(&way.id) {
            continue;
        }
        let place = format!("way {}", way.id);
        let outline = outline_of_way(draft, kept, way, &place);
        if let Some(outline) = outline {
            room.take(outline.len(), 0)?;
            let outlines = vec![vec![outline]];
            building(
                draft,
                ("way", way.id),
                place,
                [&way.tags, &[]],
                outlines,
                options,
            );
        }
    }
    Ok(())
}

/// Adds a building or a part of one, if its tags tell its height; the first tags that do count.
fn building(
    draft: &mut Draft,
    (kind, id): (&str, i64),
    place: String,
    tags: [&[Tag<'_>]; 2],
    outlines: Outlines,
    options: &CityOptions,
) {
    if tags.iter().any(|tags| says_underground(tags)) {
        draft.notes.add(&place, "lies under the ground: left out");
        return;
    }
    let names = tags.iter().flat_map(|tags| tags.iter());
    draft
        .names
        .look(&options.heights, names.map(|(key, _)| key.as_ref()));
    let find = |name: &str| value(tags[0], name).or_else(|| value(tags[1], name));
    let Some(told) = options.heights.read(find, &place, &mut draft.notes) else {
        return;
    };
    let part = |rings| DraftPart::Footprint {
        rings,
        base: told.base,
        top: told.height,
    };
    let building = DraftBuilding {
        id: Some(format!("{kind}/{id}")),
        place,
        parts: outlines.into_iter().map(part).collect(),
        ground: 0.0,
        ground_elevation: told.ground_elevation,
    };
    if says(tags[0], "building") {
        draft.buildings.push(building);
    } else {
        draft.parts.push(building);
    }
}

fn says_underground(tags: &[Tag<'_>]) -> bool {
    (tags.iter()).any(|(key, value)| key == "location" && value == "underground")
}

fn outline_of_way(draft: &mut Draft, kept: &Kept, way: &Way, place: &str) -> Option<Vec<[f64; 2]>> {
    let places: Vec<_> = way
        .nodes
        .iter()
        .filter_map(|&node| kept.place(node))
        .collect();
    let missing = way.nodes.len() - places.len();
    if missing > 0 {
        let message = format!("{} not in the file: left out", are("node", missing));
        draft.notes.add_kind("nodes", place, message);
        None
    } else if way.nodes.len() > 1 && way.nodes.first() != way.nodes.last() {
        draft.notes.add(place, "outline is not closed: left out");
        None
    } else {
        // A way of no or one node says so when it is repaired.
        Some(places)
    }
}

fn outlines_of_relation(
    draft: &mut Draft,
    kept: &Kept,
    relation: &Relation,
    place: &str,
    room: &mut Room,
) -> Result<Outlines, FormatError> {
    let mut chains: [Vec<&[i64]>; 2] = [Vec::new(), Vec::new()];
    let mut seen = HashSet::new();
    let [mut ways, mut nodes] = [0, 0];
    for member in &relation.members {
        match member.kind {
            // Labels and entrances.
            Kind::Node => {}
            Kind::Relation if member.id == relation.id => {
                draft
                    .notes
                    .add(place, "is a member of itself: not followed");
            }
            Kind::Relation => {
                let message = "has a relation as a member, which is no outline: left out";
                draft.notes.add(place, message);
            }
            Kind::Way if !seen.insert(member.id) => {}
            Kind::Way => match kept.way(member.id) {
                None => ways += 1,
                Some(way) => {
                    let missing = (way.nodes.iter()).filter(|&&node| kept.place(node).is_none());
                    match missing.count() {
                        0 => {
                            room.take(way.nodes.len(), 0)?;
                            chains[usize::from(member.is_inner)].push(&way.nodes);
                        }
                        missing => nodes += missing,
                    }
                }
            },
        }
    }
    for (what, missing) in [("way", ways), ("node", nodes)] {
        if missing > 0 {
            let message = format!(
                "{} not in the file: its ring is left out",
                are(what, missing)
            );
            draft
                .notes
                .add_kind(&format!("ring {what}"), place, message);
        }
    }
    let [outer, inner] = chains.map(|chains| {
        let (rings, open) = joined(&chains);
        if open > 0 {
            draft.notes.add(place, "ring is not closed: left out");
        }
        let at = |ring: Vec<i64>| ring.iter().filter_map(|&node| kept.place(node)).collect();
        rings.into_iter().map(at).collect::<Vec<Vec<[f64; 2]>>>()
    });
    if outer.is_empty() {
        draft.notes.add(place, "has no closed outline: left out");
    }
    let has_outer = !outer.is_empty();
    let (outlines, stray) = polygons(outer, inner);
    if stray > 0 && has_outer {
        draft
            .notes
            .add(place, "courtyard outside of its outline: left out");
    }
    Ok(outlines)
}

fn are(what: &str, count: usize) -> String {
    let verb = if count == 1 { "is" } else { "are" };
    format!("{count} {} {verb}", plural(what, count as u64))
}
