//! The world of these tests: balls of radius ½ in a row along x, their centres at 2, 4, 6, …

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Point3, Ray, Vector3};

/// A row of balls. A ray from the origin along x enters ball i at 1.5 + 2 i and leaves it 1 later.
pub(crate) fn balls(count: usize, kind: StructureKind) -> Accel<Shapes> {
    let ball = |i| Sphere::new(Point3::new(2.0 + 2.0 * i as f32, 0.0, 0.0), 0.5).into();
    Accel::build(Shapes((0..count).map(ball).collect()), kind)
}

/// From the origin through the whole row.
pub(crate) fn along() -> Ray {
    Ray::new(Point3::ORIGIN, Vector3::X)
}

/// From the origin past the row.
pub(crate) fn past() -> Ray {
    Ray::new(Point3::ORIGIN, Vector3::Y)
}
