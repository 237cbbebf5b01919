//! Shadow time by samples: one ray toward the sun for each instant. The judge of [`Exact`](crate::Exact), and
//! what others do.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_city::Facet;
use ombra_geometry::{Point3, Ray, Vector3};
use ombra_sun::{Instant, Sky, Span};
use rayon::prelude::*;

/// How many places go together.
const TOGETHER: usize = 256;

/// A change of light is found to so many seconds: in less the sun moves by no more than what a ray's direction is
/// rounded by.
const CHANGE: f64 = 1e-3;

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

    /// How many seconds each place lies in shadow, as truth to hold other methods against: rays look at the
    /// ends of equal parts of each span, of `step` seconds or a little less, and where two that follow
    /// one another differ, the change between them is found to a millisecond. What comes and goes between
    /// two looks is not seen.
    ///
    /// # Panics
    /// If `step` is not above 0.
    #[must_use]
    pub fn refined_seconds(
        &self,
        sky: &Sky,
        spans: &[Span],
        step: f64,
        places: &[Point3],
    ) -> Vec<f64> {
        assert!(step > 0.0, "a step takes time");
        let mut seconds = vec![0.0; places.len()];
        for span in spans {
            let count = (span.seconds() / step).ceil().max(1.0);
            let each = span.seconds() / count;
            let looks: Vec<(Instant, Vector3)> = (0..=count as usize)
                .map(|k| span.start + k as f64 * each)
                .map(|instant| (instant, toward(sky, instant)))
                .collect();
            let of_place = |&place: &Point3| self.refined(sky, &looks, place);
            let of_span = places.par_iter().map(of_place);
            (seconds.par_iter_mut().zip(of_span)).for_each(|(sum, own)| *sum += own);
        }
        seconds
    }

    fn refined(&self, sky: &Sky, looks: &[(Instant, Vector3)], place: Point3) -> f64 {
        let is_dark = |way| self.accel.occluded(&Ray::new(place, way));
        let mut seconds = 0.0;
        let mut was_dark = is_dark(looks[0].1);
        for pair in looks.windows(2) {
            let [from, to] = [pair[0].0, pair[1].0];
            let dark = is_dark(pair[1].1);
            seconds += match (was_dark, dark) {
                (true, true) => to - from,
                (false, false) => 0.0,
                _ => {
                    let (mut low, mut high) = (from, to);
                    while high - low > CHANGE {
                        let middle = low + 0.5 * (high - low);
                        if self.is_in_shadow(sky, place, middle) == was_dark {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    if dark { to - high } else { low - from }
                }
            };
            was_dark = dark;
        }
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
