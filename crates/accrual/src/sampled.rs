//! Shadow time by samples: one ray toward the sun for each instant. The judge of [`Exact`](crate::Exact), and
//! what others do.

use ombra_accel::{Accel, Mesh, StructureKind, Traversable as _};
use ombra_city::Facet;
use ombra_geometry::{Point3, Ray, TriangleMesh, Vector3};
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
        let mut positions = Vec::with_capacity(4 * facets.len());
        let mut triangles = Vec::with_capacity(2 * facets.len());
        for facet in facets {
            let first = positions.len() as u32;
            positions.extend(facet.corners);
            triangles.push([first, first + 1, first + 2]);
            if !facet.is_triangle() {
                triangles.push([first, first + 2, first + 3]);
            }
        }
        let mesh =
            TriangleMesh::new(positions, triangles).expect("corners are counted as they come");
        Self {
            accel: Accel::build(Mesh::new(mesh), StructureKind::default()),
        }
    }

    /// Whether a place lies in shadow at an instant: something stands toward the sun, even where that is
    /// below the horizon.
    #[must_use]
    pub fn is_in_shadow(&self, sky: &Sky, place: Point3, instant: Instant) -> bool {
        self.accel.occluded(&Ray::new(place, toward(sky, instant)))
    }

    /// How many seconds each place lies in shadow, by the middles of equal stretches of `step` seconds
    /// or a little less.
    ///
    /// # Panics
    /// If `step` is not above 0.
    #[must_use]
    pub fn seconds(&self, sky: &Sky, spans: &[Span], step: f64, places: &[Point3]) -> Vec<f64> {
        assert!(step > 0.0, "a step takes time");
        let samples: Vec<(Vector3, f64)> = (spans.par_iter())
            .flat_map_iter(|span| {
                let count = (span.seconds() / step).ceil().max(1.0);
                let each = span.seconds() / count;
                (0..count as usize).map(move |k| {
                    let instant = span.start + (k as f64 + 0.5) * each;
                    (toward(sky, instant), each)
                })
            })
            .collect();
        let mut seconds = vec![0.0; places.len()];
        (seconds.par_chunks_mut(TOGETHER))
            .zip(places.par_chunks(TOGETHER))
            .for_each(|(seconds, places)| {
                let mut occluded = vec![false; places.len()];
                for &(way, each) in &samples {
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

fn toward(sky: &Sky, instant: Instant) -> Vector3 {
    let [east, north, up] = sky.direction(instant).map(|x| x as f32);
    Vector3::new(east, north, up)
}
