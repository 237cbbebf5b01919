//! Shadow time by samples: one ray toward the sun for each instant. The judge of [`Exact`](crate::Exact), and
//! what others do.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_city::Facet;
use ombra_geometry::{Point3, Ray, Vector3};
use ombra_sun::{Instant, Sky, Span};
use rayon::prelude::*;

/// How many places go together.
const TOGETHER: usize = 256;

/// Measures the shadow of polygons at places by rays.
#[derive(Debug)]
pub struct Sampled {
    accel: Accel<Mesh>,
}

impl Sampled {
    /// Over polygons in local metres. Here each of them throws shadow on both its sides: for places
    /// outside of closed solids that is the same.
    #[must_use]
    pub fn new(facets: &[Facet]) -> Self {
        Self {
            accel: Accel::build(Mesh::new(Facet::mesh(facets)), StructureKind::default()),
        }
    }

    /// Whether a place lies in shadow at an instant: something stands toward the sun, even where that is
    /// below the horizon.
    #[must_use]
    pub fn is_in_shadow(&self, sky: &Sky, place: Point3, instant: Instant) -> bool {
        self.accel.occluded(&Ray::new(place, toward(sky, instant)))
    }

    /// How many seconds each place lies in shadow.
    #[must_use]
    pub fn seconds(&self, samples: &Samples, places: &[Point3]) -> Vec<f64> {
        let mut seconds = vec![0.0; places.len()];
        (seconds.par_chunks_mut(TOGETHER))
            .zip(places.par_chunks(TOGETHER))
            .for_each(|(seconds, places)| {
                let mut occluded = vec![false; places.len()];
                for &(way, each) in &samples.0 {
                    let rays: Vec<Ray> = places.iter().map(|&p| Ray::new(p, way)).collect();
                    self.accel.occluded_many(&rays, &mut occluded);
                    for (seconds, &occluded) in seconds.iter_mut().zip(&occluded) {
                        *seconds += if occluded { each } else { 0.0 };
                    }
                }
            });
        seconds
    }
}

/// Where the sun is at the instants at which rays look, and the seconds that each of them stands for.
#[derive(Clone, Debug)]
pub struct Samples(Vec<(Vector3, f64)>);

impl Samples {
    /// Of the middles of equal parts of each span, of `step` seconds or a little less.
    ///
    /// # Panics
    /// If `step` is not above 0.
    #[must_use]
    pub fn new(sky: &Sky, spans: &[Span], step: f64) -> Self {
        let of_span = |span: &Span| {
            let (each, middles) = span.middles(step);
            middles.map(move |instant| (toward(sky, instant), each))
        };
        Self(spans.par_iter().flat_map_iter(of_span).collect())
    }
}

fn toward(sky: &Sky, instant: Instant) -> Vector3 {
    let [east, north, up] = sky.direction(instant).map(|x| x as f32);
    Vector3::new(east, north, up)
}
