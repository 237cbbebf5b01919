//! Exposure: lights in lux and candela, and a picture that shows 0 to 1.
//!
//! A camera meters the light that it gets. Here the light that arrives on the surfaces of the scene
//! is looked at, without shadows, at some thousand places. Where its median is within what a picture
//! can show, the lights stay as the file has them; where it is not, all of them are scaled by
//! one factor.

use ombra_geometry::{Object, Transform, TriangleMesh, World};
use ombra_scene::Light;

/// A mesh where it stands.
pub(super) struct Placement<'a> {
    pub(super) mesh: &'a TriangleMesh,
    pub(super) world_from_object: &'a Transform<Object, World>,
}

/// White surfaces as bright as this, 1 being white, can be seen.
const SEEN: std::ops::RangeInclusive<f64> = 0.15..=1.0;

/// What a scene that cannot be seen is scaled to.
const MIDDLE: f64 = 0.6;

/// About how many places are metered.
const PLACES: usize = 4096;

/// By what the lights have to be multiplied, if by anything.
pub(super) fn factor(lights: &[Light], placements: &[Placement<'_>]) -> Option<f32> {
    let middle = middle(lights, placements)?;
    if SEEN.contains(&middle) {
        return None;
    }
    let factor = (MIDDLE / middle) as f32;
    (factor > 0.0 && factor.is_finite()).then_some(factor)
}

/// The same lights, stronger or weaker.
pub(super) fn scale(lights: &mut [Light], factor: f32) {
    for light in lights {
        if let Light::Point { intensity, .. }
        | Light::Directional { intensity, .. }
        | Light::Spot { intensity, .. } = light
        {
            *intensity = *intensity * factor;
        }
    }
}

/// What arrives in the middle of the places that get light: half of their area gets more. `None`
/// where nothing gets any.
///
/// Not the mean, of which a place right at a light would have the most.
fn middle(lights: &[Light], placements: &[Placement<'_>]) -> Option<f64> {
    let triangles: usize = placements.iter().map(|p| p.mesh.triangles().len()).sum();
    let step = triangles.div_ceil(PLACES).max(1);
    let mut lit = Vec::new();
    let mut next = 0;
    for placement in placements {
        let count = placement.mesh.triangles().len();
        while next < count {
            lit.extend(placement.lit(next, lights));
            next += step;
        }
        next -= count;
    }
    lit.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = lit.iter().map(|(_, area)| area).sum::<f64>() * 0.5;
    let mut area = 0.0;
    let mut places = lit.into_iter();
    let found = places.find(|(_, size)| {
        area += size;
        area >= half
    });
    found.map(|(arriving, _)| arriving)
}

impl Placement<'_> {
    /// What arrives on one triangle, and its area; `None` if nothing does.
    fn lit(&self, triangle: usize, lights: &[Light]) -> Option<(f64, f64)> {
        let corners = self.mesh.corners(triangle);
        let [a, b, c] = corners.map(|p| self.world_from_object.point(p.wide()));
        let across = (b - a).cross(c - a);
        let normal = across.normalized()?;
        let centre = a + ((b - a) + (c - a)) * (1.0 / 3.0);
        let arriving: f64 = lights
            .iter()
            .filter_map(|light| light.sample_li(centre.cast(), || [0.5; 2]))
            // Which side is seen is not known here.
            .map(|l| f64::from(l.incident.max_component()) * normal.dot(l.wi.wide()).abs())
            .filter(|x| x.is_finite())
            .sum();
        (arriving > 0.0).then(|| (arriving, across.length() * 0.5))
    }
}
