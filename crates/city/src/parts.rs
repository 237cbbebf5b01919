//! Parts of buildings, put in place of the outlines that they lie in.

use std::collections::BTreeMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

use crate::building::{Building, Part, Prism};
use crate::finding::Notes;
use crate::inside::grid::Grid;
use crate::polygon::{Polygon, signed_area};
use crate::repair::{MOST_REPAIRED, rounded};
use crate::triangulate::pieces;

/// Parts that cover this much of an outline are meant to be all of it: between them and the outline
/// lie seams, not walls.
const WHOLE: f64 = 0.9;
/// Smaller rests of an outline, in square metres, are seams as well.
const LEAST_REST: f64 = 1.0;

/// A building and its place in the file.
type Named = (String, Building);

/// Gives each part to the building whose outline it lies in. There it stands in place of the outline;
/// where parts leave much of it uncovered, that rest keeps its height. A part that lies in no outline
/// is a building by itself.
pub(crate) fn in_place(
    mut buildings: Vec<Named>,
    parts: Vec<Named>,
    notes: &mut Notes,
) -> Vec<Building> {
    let outlines = Outlines::new(&buildings);
    let mut by_owner: BTreeMap<usize, Vec<Part>> = BTreeMap::new();
    let mut alone = Vec::new();
    for (_, part) in parts {
        match outlines.owner(&buildings, &part) {
            Some(owner) => by_owner.entry(owner).or_default().extend(part.parts),
            None => alone.push(part),
        }
    }
    for (owner, parts) in by_owner {
        let (place, building) = &mut buildings[owner];
        replace(building, parts, place, notes);
    }
    let buildings = buildings.into_iter().map(|(_, building)| building);
    buildings.chain(alone).collect()
}

/// Finds outlines by place.
struct Outlines {
    grid: Grid,
    /// The building and the part of it that each box of the grid is.
    of_box: Vec<[usize; 2]>,
}

impl Outlines {
    fn new(buildings: &[Named]) -> Self {
        let mut boxes = Vec::new();
        let mut of_box = Vec::new();
        for (owner, (_, building)) in buildings.iter().enumerate() {
            for (index, part) in building.parts.iter().enumerate() {
                boxes.push(part.bounds());
                of_box.push([owner, index]);
            }
        }
        Self {
            grid: Grid::new(&boxes),
            of_box,
        }
    }

    /// The building that a part lies in; of several the smallest.
    fn owner(&self, buildings: &[Named], part: &Building) -> Option<usize> {
        let place = middle(part)?;
        let near = self.grid.near(place).iter();
        let covering = near.filter_map(|&index| {
            let [owner, index] = self.of_box[index as usize];
            let outline = prism(&buildings[owner].1.parts[index])?;
            (outline.outline.contains(place)).then(|| (outline.outline.area(), owner))
        });
        covering
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, owner)| owner)
    }
}

fn prism(part: &Part) -> Option<&Prism> {
    match part {
        Part::Prism(prism) => Some(prism),
        Part::Faces(_) => None,
    }
}

/// A place well within a building: the middle of the largest triangle of its outlines.
fn middle(building: &Building) -> Option<[f32; 2]> {
    let mut best: Option<(f64, [f32; 2])> = None;
    for prism in building.parts.iter().filter_map(prism) {
        let rings = wide(&prism.outline);
        let corners = rings.concat();
        for [a, b, c, _] in pieces(&rings, false) {
            let [a, b, c] = [a, b, c].map(|i| corners[i as usize]);
            let area = signed_area([a, b, c].into_iter());
            if best.is_none_or(|(most, _)| area > most) {
                best = Some((area, [0, 1].map(|i| ((a[i] + b[i] + c[i]) / 3.0) as f32)));
            }
        }
    }
    best.map(|(_, place)| place)
}

fn wide(outline: &Polygon) -> Vec<Vec<[f64; 2]>> {
    (outline.rings())
        .map(|ring| ring.iter().map(|p| p.map(f64::from)).collect())
        .collect()
}

fn replace(building: &mut Building, parts: Vec<Part>, place: &str, notes: &mut Notes) {
    let outlines = std::mem::replace(&mut building.parts, parts);
    let mut rest = Vec::new();
    let [mut all, mut left] = [0.0, 0.0];
    for outline in outlines.iter().filter_map(prism) {
        all += outline.outline.area();
        let parts = building.parts.iter().filter_map(prism);
        let Some(uncovered) = difference(&outline.outline, parts.map(|part| &part.outline)) else {
            let message = "has parts of too many corners: they stand in place of all of it";
            notes.add(place, message);
            return;
        };
        for polygon in uncovered {
            left += polygon.area();
            rest.push(Part::Prism(Prism {
                outline: polygon,
                ..*outline
            }));
        }
    }
    if left > (1.0 - WHOLE) * all {
        let message =
            "has parts that leave some of it uncovered: that keeps the height of the whole";
        notes.add(place, message);
        building.parts.extend(rest);
    }
}

/// What parts leave of an outline; `None` if that is too much to reckon.
fn difference<'a>(
    outline: &Polygon,
    parts: impl Iterator<Item = &'a Polygon>,
) -> Option<Vec<Polygon>> {
    let [low, high] = outline.bounds();
    let mut rest = vec![wide(outline)];
    for part in parts {
        let [from, to] = part.bounds();
        if (0..2).any(|i| from[i] >= high[i] || to[i] <= low[i]) {
            continue;
        }
        let part = wide(part);
        // Lines can cross in as many places as they have corners, squared.
        let corners: usize = rest.iter().flatten().chain(&part).map(Vec::len).sum();
        if corners > 4 * MOST_REPAIRED {
            return None;
        }
        rest = rest.overlay(&part, OverlayRule::Difference, FillRule::NonZero);
    }
    Some(rounded(rest, LEAST_REST))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block([x, y]: [f32; 2], [width, depth]: [f32; 2], height: f32) -> Named {
        let outer = vec![
            [x, y],
            [x + width, y],
            [x + width, y + depth],
            [x, y + depth],
        ];
        let outline = Polygon {
            outer,
            holes: Vec::new(),
        };
        let part = Part::Prism(Prism {
            outline,
            base: 0.0,
            top: height,
        });
        let building = Building {
            parts: vec![part],
            ..Building::default()
        };
        (format!("block {x}"), building)
    }

    /// Height and area of each part of each building.
    fn run(buildings: Vec<Named>, parts: Vec<Named>) -> (Vec<Vec<(f32, f64)>>, usize) {
        let mut notes = Notes::default();
        let found = in_place(buildings, parts, &mut notes);
        let sizes = |building: &Building| {
            let size = |part: &Part| (part.range()[1], prism(part).unwrap().outline.area());
            building.parts.iter().map(size).collect()
        };
        (
            found.iter().map(sizes).collect(),
            notes.into_findings().len(),
        )
    }

    #[test]
    fn parts_that_cover_an_outline_stand_in_its_place() {
        let outline = block([0.0, 0.0], [20.0, 10.0], 50.0);
        let podium = block([0.0, 0.0], [14.8, 10.0], 8.0);
        let tower = block([15.0, 0.2], [5.0, 9.8], 50.0);
        let (found, notes) = run(vec![outline], vec![podium, tower]);
        assert_eq!((found.len(), found[0].len(), notes), (1, 2, 0));
        assert_eq!(
            found[0].iter().map(|p| p.0).collect::<Vec<_>>(),
            [8.0, 50.0]
        );
    }

    #[test]
    fn what_parts_leave_uncovered_stays() {
        let outline = block([0.0, 0.0], [20.0, 10.0], 12.0);
        let tower = block([15.0, 0.0], [5.0, 10.0], 50.0);
        let beside = block([100.0, 0.0], [5.0, 5.0], 7.0);
        let (found, notes) = run(vec![outline], vec![tower, beside]);
        assert_eq!(
            found,
            [vec![(50.0, 50.0), (12.0, 150.0)], vec![(7.0, 25.0)]]
        );
        assert_eq!(notes, 1);
    }

    #[test]
    fn a_part_is_of_the_smallest_outline_around_it() {
        let station = block([0.0, 0.0], [100.0, 100.0], 10.0);
        let hotel = block([40.0, 40.0], [10.0, 10.0], 60.0);
        let part = block([40.0, 40.0], [10.0, 10.0], 55.0);
        let (found, notes) = run(vec![station, hotel], vec![part]);
        assert_eq!(found, [vec![(10.0, 10_000.0)], vec![(55.0, 100.0)]]);
        assert_eq!(notes, 0);
    }
}
