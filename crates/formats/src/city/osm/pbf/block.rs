//! A block: strings, and groups of elements that point to them.

use std::borrow::Cow;

use super::super::element::{Element, Kind, Member, Tag, Visit};
use super::broken;
use super::wire::{Deltas, Fields, Numbers, Value, signed};
use crate::error::FormatError;

/// A field that is not there.
const NONE: &[u8] = &[];

/// A block, its groups not yet read: what their numbers mean may come after them.
struct Block<'a> {
    strings: Vec<&'a [u8]>,
    groups: Vec<&'a [u8]>,
    /// Billionths of a degree that one step of a coordinate is.
    granularity: i64,
    /// Billionths of a degree to be added: longitude, latitude.
    offset: [i64; 2],
}

pub(super) fn each(bytes: &[u8], kind: Kind, visit: Visit<'_>) -> Result<(), FormatError> {
    let block = Block::read(bytes)?;
    for group in &block.groups {
        for field in Fields(group) {
            match (field?, kind) {
                ((1, Value::Bytes(node)), Kind::Node) => block.node(node, visit)?,
                ((2, Value::Bytes(nodes)), Kind::Node) => block.dense_nodes(nodes, visit)?,
                ((3, Value::Bytes(way)), Kind::Way) => block.way(way, visit)?,
                ((4, Value::Bytes(relation)), Kind::Relation) => block.relation(relation, visit)?,
                _ => {}
            }
        }
    }
    Ok(())
}

impl<'a> Block<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mut block = Self {
            strings: Vec::new(),
            groups: Vec::new(),
            granularity: 100,
            offset: [0, 0],
        };
        for field in Fields(bytes) {
            match field? {
                (1, Value::Bytes(table)) => {
                    for string in Fields(table) {
                        if let (1, Value::Bytes(string)) = string? {
                            block.strings.push(string);
                        }
                    }
                }
                (2, Value::Bytes(group)) => block.groups.push(group),
                (17, Value::Number(number)) => block.granularity = number as i64,
                (19, Value::Number(number)) => block.offset[1] = number as i64,
                (20, Value::Number(number)) => block.offset[0] = number as i64,
                _ => {}
            }
        }
        Ok(block)
    }

    fn place(&self, steps: [i64; 2]) -> [f64; 2] {
        // Exact for all that is on Earth, and no overflow for what is not.
        let degrees =
            |i: usize| (self.offset[i] as f64 + self.granularity as f64 * steps[i] as f64) / 1e9;
        [degrees(0), degrees(1)]
    }

    fn string(&self, index: u64) -> Result<Cow<'a, str>, FormatError> {
        let found = usize::try_from(index)
            .ok()
            .and_then(|i| self.strings.get(i));
        let found = found.ok_or_else(|| {
            broken(&format!(
                "string {index} is used, {} are there",
                self.strings.len()
            ))
        })?;
        Ok(String::from_utf8_lossy(found))
    }

    fn tags(&self, keys: &[u8], values: &[u8]) -> Result<Vec<Tag<'a>>, FormatError> {
        // A tag of two bytes is one of fifty in memory: to believe in millions would fill it.
        const MOST: usize = 10_000;
        let mut tags = Vec::new();
        for (key, value) in Numbers(keys).zip(Numbers(values)) {
            if tags.len() == MOST {
                return Err(broken(&format!("an element has over {MOST} tags")));
            }
            tags.push((self.string(key?)?, self.string(value?)?));
        }
        Ok(tags)
    }

    fn node(&self, bytes: &[u8], visit: Visit<'_>) -> Result<(), FormatError> {
        let [mut id, mut longitude, mut latitude] = [0; 3];
        for field in Fields(bytes) {
            match field? {
                (1, Value::Number(number)) => id = signed(number),
                (8, Value::Number(number)) => latitude = signed(number),
                (9, Value::Number(number)) => longitude = signed(number),
                _ => {}
            }
        }
        let place = self.place([longitude, latitude]);
        visit(Element::Node { id, place })
    }

    fn dense_nodes(&self, bytes: &[u8], visit: Visit<'_>) -> Result<(), FormatError> {
        let [mut ids, mut longitudes, mut latitudes] = [NONE; 3];
        for field in Fields(bytes) {
            match field? {
                (1, Value::Bytes(bytes)) => ids = bytes,
                (8, Value::Bytes(bytes)) => latitudes = bytes,
                (9, Value::Bytes(bytes)) => longitudes = bytes,
                _ => {}
            }
        }
        let mut longitudes = Deltas::new(longitudes);
        let mut latitudes = Deltas::new(latitudes);
        for id in Deltas::new(ids) {
            let (Some(longitude), Some(latitude)) = (longitudes.next(), latitudes.next()) else {
                return Err(broken("there are more nodes than places of nodes"));
            };
            let place = self.place([longitude?, latitude?]);
            visit(Element::Node { id: id?, place })?;
        }
        Ok(())
    }

    fn way(&self, bytes: &[u8], visit: Visit<'_>) -> Result<(), FormatError> {
        let mut id = 0;
        let [mut keys, mut values, mut nodes] = [NONE; 3];
        for field in Fields(bytes) {
            match field? {
                (1, Value::Number(number)) => id = number as i64,
                (2, Value::Bytes(bytes)) => keys = bytes,
                (3, Value::Bytes(bytes)) => values = bytes,
                (8, Value::Bytes(bytes)) => nodes = bytes,
                _ => {}
            }
        }
        let nodes: Vec<i64> = Deltas::new(nodes).collect::<Result<_, _>>()?;
        visit(Element::Way {
            id,
            nodes: &nodes,
            tags: &self.tags(keys, values)?,
        })
    }

    fn relation(&self, bytes: &[u8], visit: Visit<'_>) -> Result<(), FormatError> {
        let mut id = 0;
        let [mut keys, mut values] = [NONE; 2];
        let [mut roles, mut ids, mut kinds] = [NONE; 3];
        for field in Fields(bytes) {
            match field? {
                (1, Value::Number(number)) => id = number as i64,
                (2, Value::Bytes(bytes)) => keys = bytes,
                (3, Value::Bytes(bytes)) => values = bytes,
                (8, Value::Bytes(bytes)) => roles = bytes,
                (9, Value::Bytes(bytes)) => ids = bytes,
                (10, Value::Bytes(bytes)) => kinds = bytes,
                _ => {}
            }
        }
        let members =
            (Numbers(roles).zip(Deltas::new(ids)).zip(Numbers(kinds))).map(|((role, id), kind)| {
                Ok(Member {
                    kind: match kind? {
                        0 => Kind::Node,
                        1 => Kind::Way,
                        2 => Kind::Relation,
                        other => {
                            let message = format!("member of kind {other}; 0 to 2 are known");
                            return Err(broken(&message));
                        }
                    },
                    id: id?,
                    is_inner: self.string(role?)? == "inner",
                })
            });
        let members: Vec<Member> = members.collect::<Result<_, FormatError>>()?;
        visit(Element::Relation {
            id,
            members: &members,
            tags: &self.tags(keys, values)?,
        })
    }
}
