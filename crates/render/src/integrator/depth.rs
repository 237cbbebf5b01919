//! Distances from the camera.

use ombra_geometry::{Aabb, Hit, Ray};
use ombra_pipeline::{Batch, Context, Exception, Pipeline, RayGeneration, RayProgram};
use ombra_scene::camera::Projection;
use ombra_scene::{Camera, Rgb, World};

use super::{View, view};
use crate::display::Quantity;
use crate::explain::{Event, Observer};
use crate::exposure::Exposure;
use crate::film::Pixel;

/// Measures how far it is along each camera ray, in units of the scene: from the place of the
/// camera, or from its plane or lens. All cameras have it, panoramas included.
pub(crate) struct Depth<'a, O = ()> {
    world: &'a World,
    exposure: Exposure<'a>,
    observer: O,
}

impl<'a> Depth<'a> {
    pub(crate) const fn new(world: &'a World, exposure: Exposure<'a>) -> Self {
        Self::observed(world, exposure, ())
    }
}

impl<'a, O> Depth<'a, O> {
    pub(crate) const fn observed(world: &'a World, exposure: Exposure<'a>, observer: O) -> Self {
        Self {
            world,
            exposure,
            observer,
        }
    }
}

/// The distances that a picture shows from white to dark: to the nearest and the farthest point of
/// some bounds. It does not depend on the picture, so that a crop looks like a part of the whole.
pub(crate) fn range(bounds: &Aabb, camera: &Camera) -> Quantity {
    if bounds.is_empty() {
        return Quantity::Distance {
            near: 0.0,
            far: 1.0,
        };
    }
    let eye = camera.pose.position();
    let corners = bounds.corners().map(|corner| corner - eye);
    let (near, far) = if matches!(camera.projection, Projection::Orthographic(_)) {
        let along = corners.map(|corner| corner.dot(camera.pose.direction()));
        (
            along.into_iter().fold(f32::INFINITY, f32::min),
            along.into_iter().fold(0.0, f32::max),
        )
    } else {
        let nearest = eye.max(bounds.min).min(bounds.max);
        let lengths = corners.map(|corner| corner.length());
        (
            (nearest - eye).length(),
            lengths.into_iter().fold(0.0, f32::max),
        )
    };
    Quantity::Distance {
        near: near.max(0.0),
        far,
    }
}

impl<O: Observer> Pipeline for Depth<'_, O> {
    type World = World;

    fn world(&self) -> &World {
        self.world
    }
}

impl<O: Observer> RayProgram<View> for Depth<'_, O> {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        measured: &mut Rgb,
    ) -> Result<(), Exception> {
        self.observer
            .tell(|| Event::met(hit, &self.world.interaction(ray, hit)));
        // Camera rays have unit length.
        *measured = Rgb::new(hit.t, 1.0, 0.0);
        Ok(())
    }
}

impl<O: Observer> RayGeneration for Depth<'_, O> {
    type Output = Pixel;

    fn generate(&self, cx: &mut Context<'_, Self>, pixel: &mut Pixel) -> Result<(), Exception> {
        self.exposure.expose(cx.launch_index(), pixel, |ray, _| {
            let mut measured = Rgb::BLACK;
            view(&self.observer, cx, ray, &mut measured)?;
            Ok(measured)
        })
    }

    fn generate_many(&self, batch: &mut Batch<'_, Self>, pixels: &mut [Pixel]) -> bool {
        // One who listens is told of one ray after another.
        !O::LISTENS
            && self.exposure.expose_many(batch, pixels, |cx, ray, hit, _| {
                let mut measured = Rgb::BLACK;
                cx.shade::<View>(ray, hit, &mut measured)?;
                Ok(measured)
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::{Angle, Point3, Vector3};
    use ombra_scene::camera::{Orthographic, Perspective, Pose};

    fn camera(x: f32, projection: Projection) -> Camera {
        let pose = Pose::new(Point3::new(x, 0.0, 0.0), -Vector3::X, Vector3::Y).unwrap();
        Camera { pose, projection }
    }

    #[test]
    fn the_range_spans_the_scene_as_the_camera_sees_it() {
        let bounds = Aabb::around([Point3::new(-1.0, -3.0, 0.0), Point3::new(1.0, 3.0, 0.0)]);
        let fov = Angle::from_degrees(40.0);
        let perspective = Projection::Perspective(Perspective::new(fov));
        let orthographic = Projection::Orthographic(Orthographic { height: 2.0 });
        let distance = |near, far| Quantity::Distance { near, far };
        assert_eq!(
            range(&bounds, &camera(3.0, perspective)),
            distance(2.0, 5.0)
        );
        assert_eq!(
            range(&bounds, &camera(0.0, perspective)),
            distance(0.0, 10_f32.sqrt())
        );
        assert_eq!(
            range(&bounds, &camera(3.0, orthographic)),
            distance(2.0, 4.0)
        );
        assert_eq!(
            range(&Aabb::EMPTY, &camera(3.0, perspective)),
            distance(0.0, 1.0)
        );
    }
}
