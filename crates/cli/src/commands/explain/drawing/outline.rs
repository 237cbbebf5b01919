//! Objects as lines: their outlines, and where a plane cuts them.

use std::collections::BTreeMap;

use ombra::geometry::{Point3, Vector3};

use super::super::solid::Solid;
use super::view::{Place, View};

/// Two triangles that meet at less than this look like one: the cosine of the angle between their
/// normals.
const SMOOTH: f64 = 0.8;

/// The edges of an object that a draughtsman would draw: where the surface turns away from the viewer
/// or ends, and where it has a crease on the near side.
pub(crate) fn outline(solid: &Solid, view: &View) -> Vec<[Place; 2]> {
    let mut edges: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (index, &[a, b, c]) in solid.triangles.iter().enumerate() {
        for [i, j] in [[a, b], [b, c], [c, a]] {
            edges.entry([i.min(j), i.max(j)]).or_default().push(index);
        }
    }
    let normals: Vec<_> = solid.triangles.iter().map(|t| solid.normal(t)).collect();
    let drawn = edges.iter().filter(|(_, of)| match of[..] {
        [a, b] => {
            let (m, n) = (normals[a], normals[b]);
            let (near_a, near_b) = (m.dot(view.toward) > 0.0, n.dot(view.toward) > 0.0);
            let crease = m.dot(n) < SMOOTH * m.length() * n.length();
            near_a != near_b || (crease && near_a)
        }
        _ => true,
    });
    drawn
        .filter_map(|([i, j], _)| {
            let at = |index: u32| view.place(solid.points[index as usize]);
            view.clip(at(*i), at(*j))
        })
        .filter(is_seen)
        .collect()
}

/// Where a plane through a point cuts an object.
pub(crate) fn cut(
    solid: &Solid,
    view: &View,
    through: Point3<f64>,
    normal: Vector3<f64>,
) -> Vec<[Place; 2]> {
    let mut segments = Vec::new();
    for triangle in &solid.triangles {
        let corners = solid.corners(triangle);
        let heights = corners.map(|corner| (corner - through).dot(normal));
        let mut ends = Vec::with_capacity(2);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (heights[i], heights[j]);
            if (a < 0.0) != (b < 0.0) {
                let s = a / (a - b);
                ends.push(corners[i] + (corners[j] - corners[i]) * s);
            }
        }
        if let [from, to] = ends[..] {
            segments.extend(view.clip(view.place(from), view.place(to)));
        }
    }
    segments.retain(is_seen);
    segments
}

/// The convex hull of an object on the page; Andrew, "Another Efficient Algorithm for Convex Hulls in
/// Two Dimensions", 1979.
pub(crate) fn hull(solid: &Solid, view: &View) -> Vec<Place> {
    let mut places: Vec<Place> = solid.points.iter().map(|&p| view.place(p)).collect();
    places.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    places.dedup();
    let turn = |o: Place, a: Place, b: Place| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let half = |places: &mut dyn Iterator<Item = Place>| {
        let mut chain: Vec<Place> = Vec::new();
        for place in places {
            while let [.., o, a] = chain[..]
                && turn(o, a, place) <= 0.0
            {
                chain.pop();
            }
            chain.push(place);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut places.iter().copied());
    hull.extend(half(&mut places.iter().rev().copied()));
    hull
}

/// Whether a segment is longer than a tenth of a pixel.
fn is_seen([a, b]: &[Place; 2]) -> bool {
    (a[0] - b[0]).hypot(a[1] - b[1]) > 0.1
}
