//! The lecture's other loop: for each primitive, for each pixel.
//!
//! ```text
//! for each primitive                   for each pixel
//!     for each pixel                       for each primitive
//!         does it cover the pixel?             does the pixel's ray meet it?
//!         is it nearer than before?            is it nearer than before?
//! ```
//!
//! Rasterization keeps what was nearest in every pixel (the z-buffer), ray tracing what was nearest
//! along one ray. Here both have the same camera, the same samples in each pixel, the same meshes,
//! materials and Phong shading; what the rasterizer has not is rays, and so neither shadows nor
//! mirrors nor glass.
//!
//! A primitive goes this way: `source` says what there is (curved shapes become triangles), `view`
//! projects its corners, `facet` clips it at the near plane, `outline` says which pixels it covers
//! with the edge functions of `predicate`, `presence` leaves out what its material says is not there,
//! `band` keeps what is nearest, `shade` lights it. `bands` deals primitives out to rows of the
//! picture, so that threads share nothing.

mod band;
mod bands;
mod facet;
mod nearest;
mod outline;
mod predicate;
mod presence;
pub(crate) mod shade;
mod source;
mod view;

use std::sync::atomic::{AtomicBool, Ordering};

use ombra_geometry::shape::Plane;
use ombra_geometry::{GeometryId, InstanceId, PrimitiveId, TriangleMesh};
use ombra_scene::camera::Projection;
use ombra_scene::{Camera, World};
use rayon::prelude::*;

pub use band::Tally;
pub use source::TOLERANCE;

use crate::exposure::Exposure;
use crate::film::Pixel;
use crate::{Crop, RenderError, Settings};
use band::{Band, Nearest};
use bands::{Bands, ROWS};
use presence::PresenceTest;
use source::{Body, Form, Source, sources};
use view::View;

/// A scene, ready to be drawn from one camera.
pub(crate) struct Raster<'a> {
    world: &'a World,
    view: View,
    sources: Vec<Source<'a>>,
    bands: Bands,
    extent: Crop,
}

/// Something that is drawn of an object.
pub(crate) enum Drawable<'a> {
    Mesh(&'a TriangleMesh),
    Plane(Plane),
}

/// What is seen in a pixel, by either loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Which object of the scene.
    pub instance: InstanceId,
    /// Its geometry.
    pub geometry: GeometryId,
    /// Which primitive of the geometry: a triangle of a mesh, or a shape.
    pub primitive: PrimitiveId,
    /// How far it is along the direction of the camera, in units of the scene.
    pub depth: f64,
}

/// What became of a pass over the film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Pass {
    pub(crate) tally: Tally,
    /// Whether it was stopped before the end.
    pub(crate) stopped: bool,
}

impl Pass {
    const fn and(self, other: Self) -> Self {
        Self {
            tally: self.tally.and(other.tally),
            stopped: self.stopped | other.stopped,
        }
    }
}

/// What a user of rasterization should know about a camera, if there is anything to be said.
#[must_use]
pub fn notice(camera: &Camera) -> Option<&'static str> {
    match &camera.projection {
        Projection::ThinLens(lens) if lens.lens_radius > 0.0 => {
            Some("the rasterizer draws through the middle of the lens: everything is in focus")
        }
        _ => None,
    }
}

impl<'a> Raster<'a> {
    /// Projects and sorts everything there is. `settings` are valid.
    pub(crate) fn new(
        world: &'a World,
        camera: &Camera,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        let bounds = world.finite_bounds();
        let corners = bounds.corners().into_iter().filter(|c| c.is_finite());
        let reach = corners.map(|corner| corner.to_vector().max_norm());
        let reach = reach.fold(0.0, f32::max);
        let view = View::new(camera, settings, f64::from(reach))?;
        let sources = sources(world.scene(), &view);
        let extent = settings.extent();
        let bands = Bands::new(&sources, &view, &extent, settings.spp == 1);
        Ok(Self {
            world,
            view,
            sources,
            bands,
            extent,
        })
    }

    /// How many triangles and planes there are, in the picture or not.
    pub(crate) const fn primitives(&self) -> u64 {
        self.bands.primitives
    }

    /// What is drawn of each object, in order.
    pub(crate) fn drawables(&self) -> impl Iterator<Item = Vec<Drawable<'_>>> {
        self.sources.iter().map(|source| match &source.body {
            Body::Mesh(mesh) => vec![Drawable::Mesh(mesh)],
            Body::Shapes(forms) => forms
                .iter()
                .filter_map(|form| match form {
                    Form::Triangles(mesh) => Some(Drawable::Mesh(mesh)),
                    Form::Endless(plane) => Some(Drawable::Plane(*plane)),
                    Form::Nothing => None,
                })
                .collect(),
        })
    }

    /// Adds the samples of a pass to the pixels of the film. A band that is not finished when it is
    /// stopped holds no part of the pass. `done` hears of pixels as they are finished.
    pub(crate) fn expose(
        &self,
        exposure: &Exposure<'_>,
        pixels: &mut [Pixel],
        stop: Option<&AtomicBool>,
        done: &(dyn Fn(u64) + Sync),
    ) -> Pass {
        let per_band = self.extent.width() as usize * ROWS as usize;
        let bands = pixels.par_chunks_mut(per_band).enumerate();
        let passes = bands.map(|(index, pixels)| {
            let mut exposed = pixels.to_vec();
            let mut band = Band::new(&self.extent, index);
            let mut tally = Tally::default();
            for sample in exposure.samples() {
                if stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                    return Pass {
                        tally,
                        stopped: true,
                    };
                }
                tally = tally.and(self.draw(&mut band, index, exposure, sample));
                for ((place, seen), pixel) in band.seen().zip(&mut exposed) {
                    let sample = exposure.sample(place, sample);
                    let ray = exposure.ray(place, &sample);
                    pixel.add(match seen {
                        None => self.world.scene().background.at(ray.direction),
                        Some(nearest) => self.shade(&ray, &sample, &nearest),
                    });
                }
            }
            pixels.copy_from_slice(&exposed);
            done(pixels.len() as u64);
            Pass {
                tally,
                stopped: false,
            }
        });
        passes.reduce(Pass::default, Pass::and)
    }

    /// What is seen at one sample of each pixel of the film, row by row from the top, and what it
    /// took to find it.
    pub(crate) fn seen(&self, exposure: &Exposure<'_>, sample: u32) -> (Vec<Option<Seen>>, Tally) {
        let mut seen = vec![None; self.extent.pixels() as usize];
        let per_band = self.extent.width() as usize * ROWS as usize;
        let bands = seen.par_chunks_mut(per_band).enumerate();
        let tallies = bands.map(|(index, seen)| {
            let mut band = Band::new(&self.extent, index);
            let tally = self.draw(&mut band, index, exposure, sample);
            for ((_, nearest), seen) in band.seen().zip(seen) {
                *seen = nearest.map(|nearest| self.identify(&nearest));
            }
            tally
        });
        let tally = tallies.reduce(Tally::default, Tally::and);
        (seen, tally)
    }

    fn draw(&self, band: &mut Band, index: usize, exposure: &Exposure<'_>, sample: u32) -> Tally {
        let test = PresenceTest {
            world: self.world,
            view: &self.view,
            exposure,
            sample,
        };
        band.draw(&self.bands, index, &self.sources, &test)
    }

    fn identify(&self, nearest: &Nearest) -> Seen {
        let item = self.bands.item(nearest.item);
        let object = &self.world.scene().objects[item.object as usize];
        Seen {
            instance: InstanceId(item.object),
            geometry: object.geometry,
            primitive: PrimitiveId(item.primitive),
            depth: nearest.fragment.depth,
        }
    }
}
