//! A hit made into a place, and the only function that moves a ray off a surface.

use ombra_accel::Geometry;
use ombra_geometry::shape::{Shape, Surface};
use ombra_geometry::{Hit, Normal3, Object, Point3, Ray, Transform, TriangleMesh, Vector3, World};

use crate::Rgb;

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
    /// The colour that a mesh has here by its vertices, by which the material's own is multiplied;
    /// white where it has none.
    pub tint: Rgb,
    /// Back along the ray that came here, unit length.
    pub wo: Vector3,
    /// How far `point` may be from the surface as the next ray's test sees it.
    error: f32,
    /// See [`Scene::t_min`](crate::Scene::t_min).
    t_min: f32,
}

// What rounding does to a place, as multiples of numbers that went into it. One rounding moves a
// coordinate by half of `f32::EPSILON` at most, and so a point by √3 times that.

/// Of the world's coordinates: the place is rounded once, the origin that stands off it once more.
const WORLD_ROUNDING: f32 = 2.0 * f32::EPSILON;

/// Of the object's coordinates: the next ray's origin is rounded when a structure works in single
/// precision.
const OBJECT_ROUNDING: f32 = f32::EPSILON;

/// Of the extent of the triangle: differences, shear, products and quotient of the next ray's test.
const TEST_ROUNDING: f32 = 8.0 * f32::EPSILON;

/// Of the way that the ray came: a hit's t is rounded, so the place slides along the ray.
const SLIDE_ROUNDING: f32 = f32::EPSILON;

/// How much of the way to a target is left out at its end.
const TARGET_ROUNDING: f32 = 16.0 * f32::EPSILON;

impl Interaction {
    pub(crate) fn new(
        ray: &Ray,
        hit: &Hit,
        geometry: &Geometry,
        world_from_object: &Transform<Object, World>,
    ) -> Self {
        let local = match geometry {
            Geometry::Mesh(mesh) => Local::of_mesh(mesh.mesh(), hit),
            Geometry::Shapes(shapes) => Local::of_shape(
                &shapes.0[hit.primitive.index()],
                ray,
                hit,
                world_from_object,
            ),
        };
        Self::of_local(ray, &local, world_from_object)
    }

    fn of_local(ray: &Ray, local: &Local, world_from_object: &Transform<Object, World>) -> Self {
        let wo = -ray.direction.normalized().unwrap_or(ray.direction);
        let point: Point3 = world_from_object.point(local.point).cast();
        let object_point: Point3 = local.point.cast();
        let unit = |n: Normal3<f64>| {
            let across = world_from_object.normal(n).normalized();
            across.map_or(wo.to_normal(), Normal3::cast)
        };
        let normal = unit(local.normal);
        let shading_normal = match local.interpolated_normal.map(unit) {
            None => normal,
            Some(other) if other.dot(normal.to_vector()) < 0.0 => -other,
            Some(same) => same,
        };
        let in_object = OBJECT_ROUNDING * object_point.to_vector().max_norm()
            + TEST_ROUNDING * local.test_extent;
        Self {
            point,
            object_point,
            normal,
            shading_normal,
            uv: local.uv,
            tint: local.tint,
            wo,
            error: WORLD_ROUNDING * point.to_vector().max_norm()
                + in_object * growth(world_from_object)
                + local.slide,
            t_min: 0.0,
        }
    }

    /// Makes a place of what is known of a surface in the space of its object: a point of it, its
    /// normal there (of any length) and its parameters. `ray` is the one that sees it.
    #[must_use]
    pub fn of_surface(
        ray: &Ray,
        point: Point3<f64>,
        normal: Normal3<f64>,
        uv: [f32; 2],
        world_from_object: &Transform<Object, World>,
    ) -> Self {
        let local = Local {
            point,
            normal,
            interpolated_normal: None,
            uv,
            tint: Rgb::WHITE,
            test_extent: 0.0,
            slide: SLIDE_ROUNDING * point.to_vector().max_norm() as f32,
        };
        Self::of_local(ray, &local, world_from_object)
    }

    /// The same place, in a scene whose rays begin to look at this distance.
    #[must_use]
    pub(crate) const fn looking_from(self, t_min: f32) -> Self {
        Self { t_min, ..self }
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
        Ray {
            t_min: self.t_min,
            ..Ray::new(self.off_surface(direction), direction)
        }
    }

    /// A ray from here that ends before a distance, which may be infinite, in units of the length
    /// of `direction`: it meets neither the surface it starts from nor, were there one, a surface
    /// at its end.
    #[must_use]
    #[inline]
    pub fn spawn_within(&self, direction: Vector3, distance: f32) -> Ray {
        Ray {
            t_max: distance * (1.0 - TARGET_ROUNDING),
            ..self.spawn(direction)
        }
    }

    fn off_surface(&self, direction: Vector3) -> Point3 {
        let side = self.normal.facing(-direction).to_vector();
        self.point + side * self.error
    }
}

/// By how much a transform can enlarge a number at most: the largest absolute row sum.
fn growth(transform: &Transform<Object, World>) -> f32 {
    if transform.is_identity() {
        return 1.0;
    }
    let rows = transform.rows().iter();
    rows.map(|[x, y, z, _]| x.abs() + y.abs() + z.abs())
        .fold(0.0, f64::max) as f32
}

/// What is known in the space of the object.
struct Local {
    point: Point3<f64>,
    /// Of any length.
    normal: Normal3<f64>,
    /// Where the mesh has normals; of any length.
    interpolated_normal: Option<Normal3<f64>>,
    uv: [f32; 2],
    tint: Rgb,
    /// The extent of what the next ray's test computes with in single precision.
    test_extent: f32,
    /// How far the point may have slid along the ray, in the space of the world.
    slide: f32,
}

impl Local {
    fn of_mesh(mesh: &TriangleMesh, hit: &Hit) -> Self {
        let triangle = hit.primitive.index();
        let [a, b, c] = mesh.corners(triangle);
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let (ab, ac) = (b.wide() - a.wide(), c.wide() - a.wide());
        Self {
            // In double precision the point lies on the triangle, whatever the rounding of u and v.
            point: a.wide() + ab * u + ac * v,
            normal: ab.cross(ac).to_normal(),
            interpolated_normal: mesh
                .interpolated_normal(triangle, hit.u, hit.v)
                .map(Normal3::wide),
            uv: mesh.uv_at(triangle, hit.u, hit.v).unwrap_or([hit.u, hit.v]),
            tint: mesh
                .colour_at(triangle, hit.u, hit.v)
                .map_or(Rgb::WHITE, Rgb::from),
            test_extent: ab.max_norm().max(ac.max_norm()) as f32,
            slide: 0.0,
        }
    }

    fn of_shape(
        shape: &Shape,
        ray: &Ray,
        hit: &Hit,
        world_from_object: &Transform<Object, World>,
    ) -> Self {
        let wide: Ray<f64> = (*ray).into();
        let on_ray = wide.at(f64::from(hit.t));
        let point = world_from_object.inverse().point(on_ray);
        Self {
            point,
            normal: shape.normal_at(point),
            interpolated_normal: None,
            uv: [hit.u, hit.v],
            tint: Rgb::WHITE,
            // Shapes are tested in double precision.
            test_extent: 0.0,
            slide: SLIDE_ROUNDING * ray.direction.length() * hit.t,
        }
    }
}
