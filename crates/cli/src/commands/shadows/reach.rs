//! How far shadow reaches, and whether the city's file does.

use ombra::accrual::Tiles;
use ombra::city::{Extent, Facet};
use ombra::sun::{Instant, Sky};
use rayon::prelude::*;
use serde::Serialize;

use super::bound::extent;
use super::when::When;

/// Seconds between the instants at which the sun's altitude is looked at; longer where there are more of them than
/// [`MOST_LOOKS`].
const LOOK: f64 = 600.0;
const MOST_LOOKS: f64 = 20_000.0;

/// What of the surroundings matters to the places, and what of it is known.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Reach {
    /// The sun's lowest altitude, degrees, or a little less; of a disc that of its lower rim.
    lowest_sun: f64,
    /// How much higher the top of the buildings (or of the surface model) is than the lowest place, metres.
    tallest: f64,
    /// How far that throws shadow at the lowest sun, metres; none where the sun is at the horizon.
    reach: Option<f64>,
    /// How far they reach beyond the places, on the side where it does least, metres.
    margin: f64,
    /// What stands beyond, were it as tall, could throw shadow here while the sun is lower than this, degrees.
    uncertain_below: f64,
    /// The share of the time in which it is.
    uncertain_share: f64,
}

/// The sun this low throws shadow without an end.
const HORIZON: f64 = 0.05;

impl Reach {
    /// Of the buildings among the facets, or of a surface model: what was added around them is no city.
    pub(super) fn new(
        facets: &[Facet],
        surface: Option<(Extent, f32)>,
        tiles: &Tiles,
        when: &When,
    ) -> Self {
        let (Extent { low, high }, top) = surface.unwrap_or_else(|| of_buildings(facets));
        let nothing = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        let [least, most] = tiles.places().iter().fold(nothing, |[least, most], place| {
            let at = place.to_array().map(f64::from);
            [
                [0, 1, 2].map(|k| f64::min(least[k], at[k])),
                [0, 1, 2].map(|k| f64::max(most[k], at[k])),
            ]
        });
        let tallest = (f64::from(top) - least[2]).max(0.0);
        let sides = [0, 1].map(|k| f64::min(least[k] - low[k], high[k] - most[k]));
        let margin = sides[0].min(sides[1]).max(0.0);
        let uncertain_below = tallest.atan2(margin).to_degrees();
        let altitudes = altitudes(when);
        // The same as for how much terrain counts.
        let lowest_sun = when.lowest_altitude().to_degrees().max(0.0);
        let all: f64 = altitudes.iter().map(|look| look.1).sum();
        let low = altitudes.iter().filter(|look| look.0 < uncertain_below);
        let low: f64 = low.map(|look| look.1).sum();
        Self {
            lowest_sun,
            tallest,
            reach: (lowest_sun > HORIZON).then(|| tallest / lowest_sun.to_radians().tan()),
            margin,
            uncertain_below,
            // The sum of nothing is -0.0.
            uncertain_share: low.max(0.0) / all.max(f64::MIN_POSITIVE) + 0.0,
        }
    }

    /// For people.
    pub(super) fn describe(&self) -> String {
        let Self {
            tallest,
            margin,
            lowest_sun,
            ..
        } = self;
        let far = match self.reach {
            Some(reach) => format!("throws shadow {reach:.0} m far"),
            None => "throws shadow to the horizon".to_owned(),
        };
        let known = format!(
            "the tallest, {tallest:.0} m above the lowest place, {far} at the lowest sun ({lowest_sun:.1}°); \
             the city reaches {margin:.0} m beyond the places"
        );
        if self.reach.is_some_and(|reach| reach <= *margin) {
            return format!("{known}: nothing is missing");
        }
        format!(
            "{known}: what stands farther out, were it as tall, is missing while the sun is below {:.1}°, {:.0} % of \
             the time",
            self.uncertain_below,
            100.0 * self.uncertain_share
        )
    }
}

/// Where the buildings are, and how high the highest of them reaches; of a file that has none, of all.
fn of_buildings(facets: &[Facet]) -> (Extent, f32) {
    let is_building = |facet: &&Facet| ![Facet::TERRAIN, Facet::CONTEXT].contains(&facet.owner);
    let buildings: Vec<Facet> = facets.iter().filter(is_building).copied().collect();
    let city = if buildings.is_empty() {
        facets
    } else {
        &buildings
    };
    let corners = city.iter().flat_map(|facet| facet.corners);
    let top = corners.map(|p| p.z).fold(f32::NEG_INFINITY, f32::max);
    (extent(city), top)
}

/// Altitudes in degrees of the lowest point of the sun, and the seconds that each stands for.
fn altitudes(when: &When) -> Vec<(f64, f64)> {
    let step = LOOK.max(3600.0 * when.hours() / MOST_LOOKS);
    let look = |instant: Instant, seconds| {
        let altitude = |sun: &Sky| {
            let [east, north, up] = sun.direction(instant);
            up.atan2(east.hypot(north)).to_degrees()
        };
        let lowest = when.suns.iter().map(altitude).fold(90.0, f64::min);
        (lowest, seconds)
    };
    (when.spans.par_iter())
        .flat_map_iter(|span| {
            let (each, middles) = span.middles(step);
            middles.map(move |instant| look(instant, each))
        })
        .collect()
}
