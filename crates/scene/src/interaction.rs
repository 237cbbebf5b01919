//! A hit made into a place, and the only function that moves a ray off a surface.

use ombra_accel::Geometry;
use ombra_geometry::shape::Surface;
use ombra_geometry::{Hit, Normal3, Object, Point3, Ray, Transform, TriangleMesh, Vector3, World};

/// A place on a surface, in the world's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interaction {
    /// Where.
    pub point: Point3,
    /// The same place in the space of the object.
    pub object_point: Point3,
    /// The true unit normal of the surface, outward where there is an outside.
    pub normal: Normal3,
    /// The unit normal to shade with, on the same side as `normal`: interpolated where the mesh has
    /// normals.
    pub shading_normal: Normal3,
    /// Surface parameters.
    pub uv: [f32; 2],
    /// Back along the ray that came here, unit length.
    pub wo: Vector3,
    /// How far `point` may be from the true surface.
    error: f32,
}

/// The rounding of a computed point, relative to the numbers that went into it: the sum of three
/// products (Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 3.1), and the
/// same again for moving it into the world and for the intersection of the next ray with the
/// surface that it leaves.
const POINT_ERROR: f32 = 16.0 * f32::EPSILON;

impl Interaction {
    pub(crate) fn new(
        ray: &Ray,
        hit: &Hit,
        geometry: &Geometry,
        world_from_object: &Transform<Object, World>,
    ) -> Self {
        let wo = -ray.direction.normalized().unwrap_or(ray.direction);
        let local = match geometry {
            Geometry::Mesh(mesh) => Local::of_mesh(mesh.mesh(), hit),
            Geometry::Shapes(shapes) => {
                let wide: Ray<f64> = (*ray).into();
                let on_ray = wide.at(f64::from(hit.t));
                let point = world_from_object.inverse().point(on_ray);
                let surface = shapes.0[hit.primitive.index()].surface_at(point);
                // `t` was rounded, so the point slides along the ray by as much.
                let slide = ray.direction.length() * hit.t;
                Local {
                    point: point.cast(),
                    normal: surface.normal.cast(),
                    shading_normal: surface.normal.cast(),
                    uv: [hit.u, hit.v],
                    magnitude: slide.max(point.to_vector().max_norm() as f32),
                }
            }
        };
        let point = world_from_object.point(local.point);
        let unit = |n: Normal3| {
            world_from_object
                .normal(n)
                .normalized()
                .unwrap_or(wo.to_normal())
        };
        let normal = unit(local.normal);
        let shading_normal = unit(local.shading_normal);
        let shading_normal = if shading_normal.dot(normal.to_vector()) < 0.0 {
            -shading_normal
        } else {
            shading_normal
        };
        let magnitude = point
            .to_vector()
            .max_norm()
            .max(local.magnitude * growth(world_from_object));
        Self {
            point,
            object_point: local.point,
            normal,
            shading_normal,
            uv: local.uv,
            wo,
            error: POINT_ERROR * magnitude,
        }
    }

    /// Whether the ray came from the outside.
    #[must_use]
    #[inline]
    pub fn is_front(&self) -> bool {
        self.normal.dot(self.wo) >= 0.0
    }

    /// A ray from here that does not meet the surface it starts from: its origin stands off by the
    /// bound on rounding, on the side that `direction` points to.
    #[must_use]
    #[inline]
    pub fn spawn(&self, direction: Vector3) -> Ray {
        Ray::new(self.off_surface(direction), direction)
    }

    /// A ray from here to a point, t in `[0, 1]`, that meets neither the surface it starts from
    /// nor, were there one, a surface at its end.
    #[must_use]
    #[inline]
    pub fn spawn_to(&self, target: Point3) -> Ray {
        let origin = self.off_surface(target - self.point);
        Ray {
            t_max: 1.0 - POINT_ERROR,
            ..Ray::between(origin, target)
        }
    }

    fn off_surface(&self, direction: Vector3) -> Point3 {
        let side = self.normal.facing(-direction).to_vector();
        self.point + side * self.error
    }
}

/// By how much a transform can enlarge a number at most: the largest absolute row sum.
fn growth(transform: &Transform<Object, World>) -> f32 {
    let rows = transform.rows().iter();
    rows.map(|[x, y, z, _]| x.abs() + y.abs() + z.abs())
        .fold(0.0, f64::max) as f32
}

/// What is known in the space of the object.
struct Local {
    point: Point3,
    normal: Normal3,
    shading_normal: Normal3,
    uv: [f32; 2],
    /// The largest number that went into `point`.
    magnitude: f32,
}

impl Local {
    fn of_mesh(mesh: &TriangleMesh, hit: &Hit) -> Self {
        let triangle = hit.primitive.index();
        let corners @ [a, b, c] = mesh.corners(triangle);
        let weights = [1.0 - hit.u - hit.v, hit.u, hit.v];
        let blend = |values: [Vector3; 3]| {
            values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
        };
        let normal = (b - a)
            .cross(c - a)
            .normalized()
            .unwrap_or(Vector3::Z)
            .to_normal();
        let ids = mesh.triangles()[triangle].map(|i| i as usize);
        let shading_normal = mesh
            .normals()
            .and_then(|normals| blend(ids.map(|i| normals[i].to_vector())).normalized())
            .map_or(normal, Vector3::to_normal);
        let uv = mesh.uvs().map_or([hit.u, hit.v], |uvs| {
            let corner = ids.map(|i| uvs[i]);
            std::array::from_fn(|k| (0..3).map(|i| corner[i][k] * weights[i]).sum())
        });
        let magnitude = corners
            .iter()
            .map(|p| p.to_vector().max_norm())
            .fold(0.0, f32::max);
        Self {
            point: Point3::ORIGIN + blend(corners.map(Point3::to_vector)),
            normal,
            shading_normal,
            uv,
            magnitude,
        }
    }
}
