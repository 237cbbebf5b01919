//! Outlines as files have them, made into polygons.

mod crossing;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

use crate::finding::Notes;
use crate::polygon::{Polygon, is_inside, signed_area};
use crate::triangulate::{covered, pieces};
use crossing::{Answer, any_crossing};

/// Corners closer than this, in metres, are one.
pub(crate) const LEAST_EDGE: f64 = 1e-3;
/// Outlines smaller than this, in square metres, cast no shadow worth the name.
const LEAST_AREA: f64 = 1e-2;
/// Outlines with more corners are not repaired: lines can cross in as many places as they have
/// corners, squared.
pub(crate) const MOST_REPAIRED: usize = 1000;

/// Outlines and faces with more corners are left out: the time to cut them up may grow with their
/// square.
pub(crate) const MOST_CORNERS: usize = 100_000;

/// What holds a ring of corners in local metres, each of single precision.
type Ring = Vec<[f64; 2]>;

/// The polygons of an outline: one, unless it is broken. Its rings may or may not repeat their
/// first corners.
pub(crate) fn polygons(rings: Vec<Ring>, place: &str, notes: &mut Notes) -> Vec<Polygon> {
    let mut rings = rings.into_iter();
    let Some(outer) = rings
        .next()
        .and_then(|ring| clean(ring, "outline", place, notes))
    else {
        return Vec::new();
    };
    let mut whole = vec![outer];
    whole.extend(rings.filter_map(|ring| clean(ring, "courtyard", place, notes)));
    for (i, ring) in whole.iter_mut().enumerate() {
        orient(ring, i == 0);
    }
    let whole = match any_crossing(&whole) {
        Answer::No => without_stray_holes(whole, place, notes),
        Answer::Yes => return repaired(&whole, "outline crosses itself", place, notes),
        Answer::TooMuch => {
            notes.add(
                place,
                "outline has too many corners to be checked: left out",
            );
            return Vec::new();
        }
    };
    let area: f64 = whole
        .iter()
        .map(|ring| signed_area(ring.iter().copied()))
        .sum();
    if signed_area(whole[0].iter().copied()) < LEAST_AREA {
        notes.add(place, "outline without area: left out");
        return Vec::new();
    }
    // Courtyards that lie in one another cross nowhere and are wrong all the same.
    let cut = covered(&whole.concat(), &pieces(&whole, false));
    if (cut - area).abs() > 1e-3 * area.abs() + LEAST_AREA {
        return repaired(&whole, "outline overlaps itself", place, notes);
    }
    vec![polygon(whole)]
}

/// A ring without its closing corner, corners that repeat, and spikes; `None` if nothing is left.
fn clean(mut ring: Ring, what: &str, place: &str, notes: &mut Notes) -> Option<Ring> {
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    if !ring.iter().flatten().all(|x| x.is_finite()) {
        notes.add(
            place,
            format!("{what} has corners that are not on the map: left out"),
        );
        return None;
    }
    let given = ring.len();
    if given < 3 {
        let points = if given == 1 { "point" } else { "points" };
        let message =
            format!("ring of the {what} has {given} {points}, at least 3 are needed: left out");
        notes.add(place, message);
        return None;
    }
    ring.dedup_by(|a, b| distance(*a, *b) < LEAST_EDGE);
    while ring.len() > 1 && distance(ring[0], ring[ring.len() - 1]) < LEAST_EDGE {
        ring.pop();
    }
    if ring.len() < given {
        notes.add(
            place,
            format!("corners of the {what} repeat: one of each kept"),
        );
    }
    let before = ring.len();
    drop_spikes(&mut ring);
    if ring.len() < 3 {
        notes.add(place, format!("{what} without area: left out"));
        return None;
    }
    if ring.len() < before {
        notes.add(place, format!("{what} has spikes of no width: cut off"));
    }
    Some(ring)
}

/// Takes off corners where the ring turns back on itself.
fn drop_spikes(ring: &mut Ring) {
    let mut kept: Ring = Vec::with_capacity(ring.len());
    for &corner in ring.iter() {
        while let [.., a, b] = kept[..]
            && is_spike(a, b, corner)
        {
            kept.pop();
        }
        if kept
            .last()
            .is_none_or(|&b| distance(b, corner) >= LEAST_EDGE)
        {
            kept.push(corner);
        }
    }
    // The same where the end meets the start.
    let mut start = 0;
    while kept.len() - start >= 3 {
        let [a, b] = [kept[kept.len() - 2], kept[kept.len() - 1]];
        if is_spike(a, b, kept[start]) || distance(b, kept[start]) < LEAST_EDGE {
            kept.pop();
        } else if is_spike(b, kept[start], kept[start + 1]) {
            start += 1;
        } else {
            break;
        }
    }
    kept.drain(..start);
    *ring = kept;
}

/// Whether the way from `a` over `b` to `c` turns back on its own line at `b`.
fn is_spike(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    let [u, v] = [[b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]];
    let back = u[0] * v[0] + u[1] * v[1] < 0.0;
    let area = (u[0] * v[1] - u[1] * v[0]).abs();
    // The height of the triangle over the longer of the two edges.
    back && area < LEAST_EDGE * u[0].hypot(u[1]).max(v[0].hypot(v[1]))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

fn orient(ring: &mut Ring, is_outer: bool) {
    if (signed_area(ring.iter().copied()) > 0.0) != is_outer {
        ring.reverse();
    }
}

/// Courtyards that lie beside their building are none.
fn without_stray_holes(whole: Vec<Ring>, place: &str, notes: &mut Notes) -> Vec<Ring> {
    let mut whole = whole.into_iter();
    let outer = whole.next().unwrap_or_default();
    let mut kept = vec![outer];
    for hole in whole {
        // Rings may touch, so that one corner alone decides nothing.
        let inside = |&p: &[f64; 2]| is_inside(kept[0].iter().copied(), p);
        let inner = hole.iter().filter(|p| inside(p)).count();
        if signed_area(hole.iter().copied()).abs() < LEAST_AREA {
            notes.add(place, "courtyard without area: left out");
        } else if 2 * inner < hole.len() {
            notes.add(place, "courtyard outside of its outline: left out");
        } else {
            kept.push(hole);
        }
    }
    kept
}

/// What the outer ring goes around at all, less what its holes go around at all.
fn repaired(whole: &[Ring], what: &str, place: &str, notes: &mut Notes) -> Vec<Polygon> {
    let corners: usize = whole.iter().map(Vec::len).sum();
    if corners > MOST_REPAIRED {
        notes.add(
            place,
            format!("{what} and has over {MOST_REPAIRED} corners: left out"),
        );
        return Vec::new();
    }
    let (outer, holes) = (whole[..1].to_vec(), whole[1..].to_vec());
    let shapes = outer.overlay(&holes, OverlayRule::Difference, FillRule::NonZero);
    let found = rounded(shapes, LEAST_AREA);
    if found.is_empty() {
        notes.add(place, format!("{what} and has no area: left out"));
    } else {
        notes.add(place, format!("{what}: repaired"));
    }
    found
}

/// Shapes as polygons of single precision, those smaller than `least` square metres left out.
pub(crate) fn rounded(shapes: Vec<Vec<Ring>>, least: f64) -> Vec<Polygon> {
    let mut found = Vec::new();
    for shape in shapes {
        let mut rings = shape.into_iter().map(|ring| {
            let rounded = |p: [f64; 2]| p.map(|x| f64::from(x as f32));
            let mut ring: Ring = ring.into_iter().map(rounded).collect();
            ring.dedup();
            ring
        });
        let large =
            |ring: &Ring| ring.len() >= 3 && signed_area(ring.iter().copied()).abs() >= least;
        let Some(mut outer) = rings.next().filter(large) else {
            continue;
        };
        orient(&mut outer, true);
        let mut whole = vec![outer];
        for mut hole in rings.filter(large) {
            orient(&mut hole, false);
            whole.push(hole);
        }
        found.push(polygon(whole));
    }
    found
}

fn polygon(whole: Vec<Ring>) -> Polygon {
    let narrow = |ring: Ring| ring.into_iter().map(|p| p.map(|x| x as f32)).collect();
    let mut rings = whole.into_iter().map(narrow);
    Polygon {
        outer: rings.next().unwrap_or_default(),
        holes: rings.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(rings: &[&[[f64; 2]]]) -> (Vec<Polygon>, Vec<String>) {
        let mut notes = Notes::default();
        let rings = rings.iter().map(|ring| ring.to_vec()).collect();
        let found = polygons(rings, "feature 0", &mut notes);
        let notes = notes
            .into_findings()
            .iter()
            .map(ToString::to_string)
            .collect();
        (found, notes)
    }

    const SQUARE: [[f64; 2]; 5] = [[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0], [0.0, 0.0]];

    #[test]
    fn a_good_outline_is_turned_to_run_counter_clockwise() {
        let hole = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]];
        let (found, notes) = run(&[&SQUARE, &hole]);
        assert!(notes.is_empty(), "{notes:?}");
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].area(), 15.0);
        assert_eq!(found[0].outer.len(), 4);
        assert!(found[0].contains([0.5, 0.5]));
        assert!(!found[0].contains([1.5, 1.5]));
    }

    #[test]
    fn a_bow_tie_is_two_triangles() {
        let (found, notes) = run(&[&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]]]);
        assert_eq!(found.len(), 2);
        assert_eq!(found.iter().map(Polygon::area).sum::<f64>(), 8.0);
        assert_eq!(notes, ["feature 0: outline crosses itself: repaired"]);
    }

    #[test]
    fn repeated_corners_and_spikes_go() {
        let spiked = [
            [0.0, 0.0],
            [0.0, 0.0],
            [4.0, 0.0],
            [9.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
        ];
        let (found, notes) = run(&[&spiked]);
        assert_eq!(found[0].area(), 16.0);
        assert_eq!(found[0].outer.len(), 4);
        assert_eq!(
            notes,
            [
                "feature 0: corners of the outline repeat: one of each kept",
                "feature 0: outline has spikes of no width: cut off"
            ]
        );
    }

    #[test]
    fn what_is_no_polygon_is_left_out_and_told() {
        for (ring, told) in [
            (&[][..], "ring of the outline has 0 points"),
            (
                &[[0.0, 0.0], [1.0, 1.0]][..],
                "ring of the outline has 2 points",
            ),
            (
                &[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]][..],
                "outline without area",
            ),
            (
                &[[0.0, 0.0], [1e-4, 0.0], [0.0, 1e-4], [1e-4, 1e-4]][..],
                "corners of the outline repeat",
            ),
            (
                &[[0.0, f64::NAN], [1.0, 0.0], [0.0, 1.0]][..],
                "outline has corners that are not on",
            ),
        ] {
            let (found, notes) = run(&[ring]);
            assert!(found.is_empty(), "{told}");
            assert!(notes[0].contains(told), "{notes:?}");
        }
    }

    #[test]
    fn holes_that_cross_or_stray_are_put_right() {
        let (found, notes) = run(&[&SQUARE, &[[3.0, 1.0], [6.0, 1.0], [6.0, 2.0], [3.0, 2.0]]]);
        assert_eq!(notes, ["feature 0: outline crosses itself: repaired"]);
        assert_eq!(found[0].area(), 15.0);
        let (found, notes) = run(&[&SQUARE, &[[5.0, 1.0], [6.0, 1.0], [6.0, 2.0], [5.0, 2.0]]]);
        assert_eq!(
            notes,
            ["feature 0: courtyard outside of its outline: left out"]
        );
        assert_eq!(found[0].area(), 16.0);
        let hole = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]];
        let (found, notes) = run(&[&SQUARE, &hole, &hole]);
        assert_eq!(notes, ["feature 0: outline overlaps itself: repaired"]);
        assert_eq!(found[0].area(), 15.0);
    }

    #[test]
    fn a_star_of_many_crossings_ends_soon() {
        let star: Vec<[f64; 2]> = (0..99_999)
            .map(|i| {
                let (sin, cos) = (f64::from(i) * 3.1).sin_cos();
                [100.0 * cos, 100.0 * sin]
            })
            .collect();
        let (found, notes) = run(&[&star]);
        assert!(found.is_empty());
        assert_eq!(notes.len(), 1, "{notes:?}");
    }

    #[test]
    fn a_comb_of_many_teeth_ends_soon() {
        // Teeth side by side, then one above the other.
        for turned in [false, true] {
            let mut comb: Vec<[f64; 2]> = (0..20_000)
                .map(|i| {
                    [
                        f64::from(i as f32 * 0.25),
                        if i % 2 == 0 { 10.0 } else { 500.0 },
                    ]
                })
                .collect();
            comb.extend([[6000.0, 0.0], [0.0, 0.0]]);
            if turned {
                comb.iter_mut().for_each(|p| p.reverse());
            }
            let (found, notes) = run(&[&comb]);
            assert_eq!((found.len(), notes.len()), (1, 0), "{notes:?}");
        }
    }
}
