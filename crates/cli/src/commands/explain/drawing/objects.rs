//! The objects near the rays.

use ombra::accel::Geometry;
use ombra::geometry::shape::Shape;
use ombra::geometry::{Aabb, Point3};
use ombra::scene::Scene;

use super::super::path::Path;
use super::super::solid::{Solid, Solids};
use super::labels::Labels;
use super::object_bounds;
use super::outline::{cut, hull, outline};
use super::svg::Svg;
use super::view::View;

/// Draws the outlines of all objects in a view, and what the plane of the camera ray cuts.
pub(crate) fn draw(
    svg: &mut Svg,
    view: &View,
    solids: &Solids<'_>,
    paths: &[Path],
    eye: Point3<f64>,
    labels: &mut Labels,
) {
    let mut names = Vec::new();
    for index in 0..solids.scene.objects.len() {
        let bounds = object_bounds(solids.scene, index);
        if bounds.is_some_and(|bounds| !is_near(&bounds, view)) {
            continue;
        }
        let solid = solids.of(index);
        if solid.triangles.is_empty() {
            continue;
        }
        let met = paths.iter().any(|path| path.object == Some(index));
        if met && is_convex(solids.scene, index) && is_small(&solid, view) {
            svg.polygon(
                &hull(&solid, view),
                "fill=\"#8aa4b8\" fill-opacity=\"0.10\"",
            );
        }
        let edges = outline(&solid, view);
        svg.segments(&edges, "stroke=\"#9a9a9a\" stroke-width=\"0.8\"");
        let mut cut_edges = Vec::new();
        if view.cut {
            cut_edges = cut(&solid, view, eye, view.toward);
            svg.segments(&cut_edges, "stroke=\"#444\" stroke-width=\"1.5\"");
        }
        if met {
            names.push((index, solid, edges.first().or(cut_edges.first()).copied()));
        }
    }
    // Names come last, over all lines.
    let within = [
        view.corner[0],
        view.corner[1],
        view.corner[0] + view.size[0],
        view.corner[1] + view.size[1],
    ];
    for (index, solid, edge) in names {
        let name: String = solids.scene.objects[index].name.chars().take(30).collect();
        let [left, top, right, bottom] = extent(&solid, view);
        let [x, y] = [f64::midpoint(left, right), f64::midpoint(top, bottom)];
        let half = name.chars().count() as f64 * 3.4;
        let mut middles = vec![
            [x, top - 8.0],
            [x, bottom + 9.0],
            [right + half, y],
            [left - half, y],
            [x, top + 12.0],
            [x, bottom - 12.0],
        ];
        if let Some([[x, y], _]) = edge {
            middles.push([x + half, y - 8.0]);
            middles.push([x + half, y + 9.0]);
        }
        // What is larger than the view is named at its edge.
        middles.push([
            within[2] - half - 4.0,
            y.clamp(within[1] + 10.0, within[3] - 10.0) - 9.0,
        ]);
        middles.push([
            within[0] + half + 4.0,
            y.clamp(within[1] + 10.0, within[3] - 10.0) - 9.0,
        ]);
        if let Some([x, y]) = labels.find(&name, middles, within) {
            svg.text(
                [x, y + 3.8],
                &name,
                "class=\"object\" text-anchor=\"middle\"",
            );
        }
    }
}

/// Whether some of a box is in a view.
fn is_near(bounds: &Aabb<f64>, view: &View) -> bool {
    let places = bounds.corners().map(|corner| view.place(corner));
    (0..2).all(|axis| {
        let (low, high) = (view.corner[axis], view.corner[axis] + view.size[axis]);
        places.iter().any(|place| place[axis] >= low)
            && places.iter().any(|place| place[axis] <= high)
    })
}

/// Whether an object is a single shape without hollows.
fn is_convex(scene: &Scene, index: usize) -> bool {
    let geometry = &scene.geometries[scene.objects[index].geometry.index()];
    match geometry {
        Geometry::Shapes(shapes) => {
            matches!(&shapes.0[..], [shape] if !matches!(shape, Shape::Torus(_) | Shape::Plane(_)))
        }
        Geometry::Mesh(_) => false,
    }
}

/// Whether an object leaves room for others in a view.
fn is_small(solid: &Solid, view: &View) -> bool {
    let [left, top, right, bottom] = extent(solid, view);
    right - left < 0.7 * view.size[0] && bottom - top < 0.9 * view.size[1]
}

/// What an object takes up on the page: left, top, right, bottom.
fn extent(solid: &Solid, view: &View) -> [f64; 4] {
    let places = solid.points.iter().map(|&point| view.place(point));
    places.fold(
        [
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ],
        |[left, top, right, bottom], [x, y]| [left.min(x), top.min(y), right.max(x), bottom.max(y)],
    )
}
