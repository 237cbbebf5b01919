//! Flat shapes as triangles in space, for what only triangles can be asked.

use super::slabs::Slabs;
use super::{ConvexPolyhedron, Shape};
use crate::{Axis, Point3, Vector3};

impl Shape {
    /// Whether the shape is made up of triangles, however large.
    #[must_use]
    pub const fn is_flat(&self) -> bool {
        match self {
            Self::Triangle(_)
            | Self::Rectangle(_)
            | Self::Cuboid(_)
            | Self::OrientedBox(_)
            | Self::Frustum(_)
            | Self::ConvexPolyhedron(_) => true,
            // A disk has a round rim, a plane no corners.
            Self::Sphere(_)
            | Self::Plane(_)
            | Self::Disk(_)
            | Self::Cylinder(_)
            | Self::Cone(_)
            | Self::Torus(_) => false,
        }
    }

    /// Shows the triangles that make up a [flat](Self::is_flat) shape; of others, none.
    pub fn visit_triangles(&self, visit: &mut impl FnMut([Point3<f64>; 3])) {
        match self {
            Self::Triangle(triangle) => visit(triangle.corners.map(Point3::wide)),
            Self::Rectangle(rectangle) => {
                let ([first, second], corner) = (rectangle.edges, rectangle.frame.origin);
                quad(
                    [
                        corner,
                        corner + first,
                        corner + first + second,
                        corner + second,
                    ],
                    visit,
                );
            }
            Self::Cuboid(cuboid) => {
                slabs(&cuboid.slabs, |local| Point3::from(local.to_array()), visit);
            }
            Self::OrientedBox(oriented) => {
                slabs(&oriented.slabs, |local| oriented.frame.world(local), visit);
            }
            Self::Frustum(frustum) => polyhedron(frustum.polyhedron(), visit),
            Self::ConvexPolyhedron(solid) => polyhedron(solid, visit),
            _ => {}
        }
    }
}

fn quad([a, b, c, d]: [Point3<f64>; 4], visit: &mut impl FnMut([Point3<f64>; 3])) {
    visit([a, b, c]);
    visit([a, c, d]);
}

fn slabs(
    slabs: &Slabs,
    place: impl Fn(Vector3<f64>) -> Point3<f64>,
    visit: &mut impl FnMut([Point3<f64>; 3]),
) {
    for axis in Axis::ALL {
        let (s, t) = (axis.next(), axis.next().next());
        for side in [slabs.lo, slabs.hi] {
            let corner = |u: Vector3<f64>, v: Vector3<f64>| {
                let mut local = side;
                (local[s], local[t]) = (u[s], v[t]);
                place(local)
            };
            let (lo, hi) = (slabs.lo, slabs.hi);
            quad(
                [
                    corner(lo, lo),
                    corner(hi, lo),
                    corner(hi, hi),
                    corner(lo, hi),
                ],
                visit,
            );
        }
    }
}

fn polyhedron(solid: &ConvexPolyhedron, visit: &mut impl FnMut([Point3<f64>; 3])) {
    for face in &solid.faces {
        let at = |corner: Vector3<f64>| solid.centre + corner;
        if let Some((&first, rest)) = face.corners().split_first() {
            for pair in rest.windows(2) {
                visit([at(first), at(pair[0]), at(pair[1])]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Cuboid, OrientedBox, Rectangle, Sphere, Surface as _, Triangle};

    #[test]
    fn the_triangles_have_the_area_of_the_shape() {
        let (x, y) = (Vector3::new(1.0, 2.0, 0.0), Vector3::new(0.0, 1.0, 3.0));
        let size = Vector3::new(1.0, 2.0, 3.0);
        let corner = Point3::new(1.0, 2.0, 3.0);
        let shapes = [
            Shape::from(Triangle::new(corner, corner + x, corner + y)),
            Shape::from(Rectangle::new(corner, x, y).unwrap()),
            Shape::from(Cuboid::new(corner, corner + size).unwrap()),
            Shape::from(OrientedBox::new(corner, x, y, size).unwrap()),
        ];
        for shape in shapes {
            let mut area = 0.0;
            shape.visit_triangles(&mut |[a, b, c]| area += (b - a).cross(c - a).length() / 2.0);
            assert!(
                shape.is_flat() && (area - shape.area()).abs() < 1e-12,
                "{shape:?}"
            );
        }
        assert!(!Shape::from(Sphere::new(corner, 1.0)).is_flat());
    }
}
