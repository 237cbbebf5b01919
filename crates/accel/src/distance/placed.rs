//! Distances from shapes that are placed.

use ombra_geometry::shape::{Shape, Surface as _};
use ombra_geometry::triangle::{Nearest, nearest};
use ombra_geometry::{Aabb, Axis, Object, Point3, Transform, Vector3, World};

use super::measured::{Place, Placed};

/// By how much a placement may stretch one axis more than another, relative to the axis, and count as
/// even: what the rotations in files in single precision are off by. A distance from a curved shape
/// can be too large by this part of itself at most.
const EVEN: f64 = 1.0 / (1 << 20) as f64;

/// Whether a placement turns and scales and does nothing else: its columns have the same length and
/// are perpendicular. NaN is "no".
pub(super) fn is_even(placement: &Transform<Object, World>) -> bool {
    let rows = placement.rows();
    let column = |j: usize| Vector3::new(rows[0][j], rows[1][j], rows[2][j]);
    let columns = [column(0), column(1), column(2)];
    let size = columns.iter().map(|c| c.max_norm()).fold(0.0, f64::max);
    let [x, y, z] = columns.map(|c| c / size);
    let square = x.length_squared();
    [y, z]
        .iter()
        .all(|c| (c.length_squared() - square).abs() <= EVEN * square)
        && [x.dot(y), y.dot(z), z.dot(x)]
            .iter()
            .all(|product| product.abs() <= EVEN * square)
}

/// Whether the distance from a shape can be measured, placed as it is.
pub(super) fn is_measurable(shape: &Shape, is_even: bool) -> bool {
    is_even || shape.is_flat() || matches!(shape, Shape::Plane(_))
}

/// The nearest point of a shape; `None` where there is none.
pub(super) fn of_shape(shape: &Shape, place: &Place<'_>) -> Option<Nearest> {
    let point = place.point;
    let bounds = shape.bounds();
    if bounds.is_empty() {
        return None;
    }
    let Some(placed) = &place.placed else {
        let offset = within(shape.to_nearest(point), &bounds.wide(), point);
        let [u, v] = shape.surface_at(point + offset).uv;
        return Some(Nearest { offset, u, v });
    };
    let offset = if placed.is_even {
        let own = placed.object_from_world.point(point);
        let offset = within(shape.to_nearest(own), &bounds.wide(), own);
        placed.world_from_object.point(own + offset) - point
    } else if let Shape::Plane(plane) = shape {
        let normal = placed
            .world_from_object
            .normal(plane.normal())
            .normalized()?;
        let normal = normal.to_vector();
        normal * (placed.world_from_object.point(plane.point()) - point).dot(normal)
    } else {
        of_triangles(shape, placed, point)?
    };
    let found = placed.object_from_world.point(point + offset);
    let [u, v] = shape.surface_at(found).uv;
    Some(Nearest { offset, u, v })
}

/// The nearest point of a flat shape that is stretched: of its triangles, where they stand.
fn of_triangles(shape: &Shape, placed: &Placed<'_>, point: Point3<f64>) -> Option<Vector3<f64>> {
    let mut best = None::<(f64, Vector3<f64>)>;
    shape.visit_triangles(&mut |corners| {
        let corners = corners.map(|corner| placed.world_from_object.point(corner));
        let offset = nearest(point, corners).offset;
        let squared = offset.length_squared();
        if best.is_none_or(|(least, _)| squared < least) {
            best = Some((squared, offset));
        }
    });
    best.map(|(_, offset)| offset)
}

/// An offset moved by what rounding took it out of the box of its shape, so that a box is never
/// farther away than what is in it.
fn within(offset: Vector3<f64>, bounds: &Aabb<f64>, point: Point3<f64>) -> Vector3<f64> {
    let (min, max) = (bounds.min - point, bounds.max - point);
    let mut moved = offset;
    for axis in Axis::ALL {
        // Comparisons and not `clamp`: NaN stays.
        if moved[axis] < min[axis] {
            moved[axis] = min[axis];
        } else if moved[axis] > max[axis] {
            moved[axis] = max[axis];
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_mirrors_and_scales_are_even_and_stretches_are_not() {
        let scale = |x, y, z| Transform::<Object, Object>::scale(Vector3::new(x, y, z));
        let turn = Transform::<Object, World>::rotation(Vector3::new(1.0, 2.0, 3.0), 0.7);
        for even in [scale(2.0, 2.0, 2.0), scale(1e-200, -1e-200, 1e-200)] {
            assert!(is_even(&even.then(&turn)));
        }
        let sheared = [
            [1.0, 0.1, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        let sheared = Transform::from_rows(sheared).unwrap();
        for uneven in [scale(1.0, 1.0, 1.001), scale(0.0, 0.0, 0.0), sheared] {
            assert!(!is_even(&uneven.then(&turn)));
        }
    }
}
