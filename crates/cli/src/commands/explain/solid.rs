//! The objects of a scene as triangles in the space of the world.

use std::collections::HashMap;

use ombra::accel::Geometry;
use ombra::geometry::shape::{Shape, Surface as _, tessellate};
use ombra::geometry::{Aabb, Point3, TriangleMesh, Vector3};
use ombra::scene::{Object, Scene};

/// An object with more triangles than this is shown as its box.
const MAX_TRIANGLES: usize = 500_000;

/// An object as triangles.
pub(crate) struct Solid {
    pub(crate) points: Vec<Point3<f64>>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Which objects there are, and how finely curved ones are cut.
pub(crate) struct Solids<'a> {
    pub(crate) scene: &'a Scene,
    /// In the unit of the world.
    pub(crate) tolerance: f64,
    /// Endless shapes are shown as far as this.
    pub(crate) reach: Aabb<f64>,
}

impl Solids<'_> {
    /// The triangles of one object.
    pub(crate) fn of(&self, index: usize) -> Solid {
        let object = &self.scene.objects[index];
        let mut solid = Solid {
            points: Vec::new(),
            triangles: Vec::new(),
        };
        match &self.scene.geometries[object.geometry.index()] {
            Geometry::Mesh(mesh) if mesh.mesh().triangles().len() <= MAX_TRIANGLES => {
                solid.add(mesh.mesh(), object);
            }
            Geometry::Mesh(mesh) => {
                let bounds = Aabb::around(mesh.mesh().positions().iter().copied());
                solid.add(&ombra::geometry::mesh::generate::cuboid(&bounds), object);
            }
            Geometry::Shapes(shapes) => {
                // By how much lengths grow on the way to the world, at most.
                let rows = object.world_from_object.rows().iter();
                let growth = rows
                    .map(|[x, y, z, _]| x.abs() + y.abs() + z.abs())
                    .fold(f64::MIN_POSITIVE, f64::max);
                for shape in &shapes.0 {
                    self.add_shape(&mut solid, shape, object, self.tolerance / growth);
                }
            }
        }
        solid
    }

    fn add_shape(&self, solid: &mut Solid, shape: &Shape, object: &Object, tolerance: f64) {
        if let Shape::Plane(_) = shape {
            self.add_plane(solid, shape, object);
            return;
        }
        // Far from the origin single precision may be coarser than what can be seen.
        let mesh = [1.0, 100.0, 10_000.0]
            .iter()
            .find_map(|coarser| tessellate(shape, tolerance * coarser).ok());
        if let Some(mesh) = mesh {
            solid.add(&mesh, object);
        }
    }

    /// An endless plane as a square that covers what is shown.
    fn add_plane(&self, solid: &mut Solid, shape: &Shape, object: &Object) {
        let world = &object.world_from_object;
        let centre = self.reach.centre();
        let local = world.inverse().point(centre);
        let normal = shape.normal_at(local);
        let hit = ombra::geometry::Ray {
            t_min: f64::NEG_INFINITY,
            ..ombra::geometry::Ray::new(local, normal.to_vector())
        };
        let Some(crossing) = shape.crossings(&hit).first().copied() else {
            return;
        };
        let foot = world.point(hit.at(crossing.t));
        let Some(normal) = world.normal(normal).to_vector().normalized() else {
            return;
        };
        let (s, t) = normal.orthonormal_basis();
        let half = self.reach.extent().length();
        let first = solid.points.len() as u32;
        for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            solid.points.push(foot + s * (a * half) + t * (b * half));
        }
        solid
            .triangles
            .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
}

impl Solid {
    /// Adds a mesh, with one vertex for all in the same place.
    fn add(&mut self, mesh: &TriangleMesh, object: &Object) {
        let mut of_place = HashMap::new();
        let points = &mut self.points;
        let mut vertex = |index: u32| {
            let position = mesh.positions()[index as usize];
            // Negative zero is zero.
            let place = position.to_array().map(|x| (x + 0.0).to_bits());
            *of_place.entry(place).or_insert_with(|| {
                points.push(object.world_from_object.point(position.wide()));
                points.len() as u32 - 1
            })
        };
        for triangle in mesh.triangles() {
            let corners = triangle.map(&mut vertex);
            let [a, b, c] = corners;
            if a != b && b != c && c != a {
                self.triangles.push(corners);
            }
        }
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: &[u32; 3]) -> [Point3<f64>; 3] {
        triangle.map(|index| self.points[index as usize])
    }

    /// The normal of a triangle, of any length.
    pub(crate) fn normal(&self, triangle: &[u32; 3]) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a)
    }
}
