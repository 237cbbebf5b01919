//! What a scene is made of, as triangles and planes.

use std::collections::BTreeMap;
use std::sync::Arc;

use ombra_accel::{Geometry, Primitives as _};
use ombra_geometry::shape::{
    Plane, Shape, Surface as _, TessellationError, tessellate, triangle_count,
};
use ombra_geometry::{Camera as CameraSpace, Object, Transform, TriangleMesh, World as WorldSpace};
use ombra_scene::Scene;

use super::view::View;

/// How far triangles may be from the curved shape that they stand for, in pixels at the place where
/// the box of the shape comes nearest within the picture.
pub const TOLERANCE: f64 = 1.0 / 16.0;

/// The most triangles for one shape and for all of a scene: where they do not suffice the tolerance
/// is doubled until they do.
const MOST_OF_SHAPE: u64 = 1 << 18;
const MOST_OF_SCENE: u64 = 1 << 22;

/// An object as the rasterizer sees it.
pub(super) struct Source<'a> {
    pub(super) camera_from_object: Transform<Object, CameraSpace>,
    pub(super) body: Body<'a>,
}

/// What there is to be drawn of an object.
pub(super) enum Body<'a> {
    /// The triangles of a mesh, each a primitive.
    Mesh(&'a TriangleMesh),
    /// Shapes, each a primitive of many triangles, or endless.
    Shapes(Vec<Form>),
}

/// A shape in the form in which it is drawn.
pub(super) enum Form {
    Triangles(Arc<TriangleMesh>),
    Endless(Plane),
    /// Not even the coarsest mesh suits its size: one that single precision cannot hold.
    Nothing,
}

/// A shape as it was described, and the size of a pixel where it is nearest, in its own units.
struct Wanted<'a> {
    shape: &'a Shape,
    /// `None` if it is out of view.
    pixel: Option<f64>,
    /// What was settled on, as a power of 2; `None` for a shape that has no triangles.
    exponent: Option<i32>,
    triangles: u64,
}

/// Every object of a scene, in order.
pub(super) fn sources<'a>(scene: &'a Scene, view: &View) -> Vec<Source<'a>> {
    let mut wanted: Vec<Vec<Wanted<'_>>> = Vec::with_capacity(scene.objects.len());
    for object in &scene.objects {
        wanted.push(match &scene.geometries[object.geometry.index()] {
            Geometry::Mesh(_) => Vec::new(),
            Geometry::Shapes(shapes) => {
                let growth = growth(&object.world_from_object);
                let one = |(i, shape)| {
                    let bounds = object.world_from_object.aabb(&shapes.bounds(i as u32));
                    let pixel = view
                        .nearest(&bounds)
                        .map(|depth| view.pixel_at(depth) / growth);
                    want(shape, pixel, TOLERANCE)
                };
                shapes.0.iter().enumerate().map(one).collect()
            }
        });
    }
    let mut tolerance = TOLERANCE;
    // Each doubling halves what curved shapes take, until they are down to the fewest there can be.
    for _ in 0..32 {
        let total = wanted.iter().flatten().map(|one| one.triangles);
        if total.fold(0, u64::saturating_add) <= MOST_OF_SCENE {
            break;
        }
        tolerance *= 2.0;
        for one in wanted.iter_mut().flatten() {
            *one = want(one.shape, one.pixel, tolerance);
        }
    }
    // A shape that many objects place is made into triangles once for each tolerance.
    let mut made: BTreeMap<(u32, usize, i32), Arc<TriangleMesh>> = BTreeMap::new();
    let mut sources = Vec::with_capacity(scene.objects.len());
    for (object, wanted) in scene.objects.iter().zip(&wanted) {
        let body = match &scene.geometries[object.geometry.index()] {
            Geometry::Mesh(mesh) => Body::Mesh(mesh.mesh()),
            Geometry::Shapes(_) => {
                let form = |(i, one): (usize, &Wanted<'_>)| match (one.shape, one.exponent) {
                    (Shape::Plane(plane), _) => Form::Endless(*plane),
                    (_, None) => Form::Nothing,
                    (shape, Some(exponent)) => {
                        let mesh =
                            made.entry((object.geometry.0, i, exponent))
                                .or_insert_with(|| {
                                    let mesh = tessellate(shape, f64::from(exponent).exp2());
                                    Arc::new(mesh.unwrap_or_default())
                                });
                        Form::Triangles(Arc::clone(mesh))
                    }
                };
                Body::Shapes(wanted.iter().enumerate().map(form).collect())
            }
        };
        sources.push(Source {
            camera_from_object: view.camera_from_object(&object.world_from_object),
            body,
        });
    }
    sources
}

/// The tolerance of a shape: the largest power of 2 that is not above a part of a pixel, or the
/// smallest one above it that takes no more triangles than are allowed.
fn want(shape: &Shape, pixel: Option<f64>, part: f64) -> Wanted<'_> {
    let Some(wanted) = pixel else {
        return Wanted {
            shape,
            pixel,
            exponent: None,
            triangles: 0,
        };
    };
    // Around the eye a pixel may be as small as can be, and single precision would not do.
    let least = f64::from(shape.bounds().extent().max_norm() * f32::EPSILON);
    let tolerance = (wanted * part).max(least).max(f64::MIN_POSITIVE);
    let mut exponent = tolerance.log2().floor() as i32;
    loop {
        let (exponent_found, triangles) = match triangle_count(shape, f64::from(exponent).exp2()) {
            Ok(triangles) if triangles <= MOST_OF_SHAPE => (Some(exponent), triangles),
            Ok(_) | Err(TessellationError::TooFine { .. }) if exponent < f64::MAX_EXP - 1 => {
                exponent += 1;
                continue;
            }
            _ => (None, 0),
        };
        return Wanted {
            shape,
            pixel,
            exponent: exponent_found,
            triangles,
        };
    }
}

/// By how much a transform can enlarge a distance at most: the largest absolute row sum times √3.
fn growth(transform: &Transform<Object, WorldSpace>) -> f64 {
    let rows = transform.rows().iter();
    let sums = rows.map(|[x, y, z, _]| x.abs() + y.abs() + z.abs());
    sums.fold(0.0, f64::max) * 3_f64.sqrt()
}
