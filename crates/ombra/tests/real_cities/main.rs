//! The shadow time of cities as they are: against rays, and what must always hold. Those from files
//! are skipped, with a line that says so, where the files are not there: see `OMBRA_TEST_DATA`.

mod against_rays;
mod whole;

use std::path::PathBuf;

use ombra::accrual::Ground;
use ombra::city::{City, Inside, Part};
use ombra::formats::city::{CityOptions, read_city};
use ombra::geometry::Point3;
use ombra::sun::{Calendar, Days, Hours, Place, Refraction, Sheet, Sky, Span};

const YEAR: i16 = 2026;

/// A city of the outside data, or `None`, said aloud, where it is not there.
fn outside(name: &str) -> Option<City> {
    let beside = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data"));
    let data = std::env::var_os("OMBRA_TEST_DATA").map_or(beside, PathBuf::from);
    let file = data.join("city").join(name);
    if !file.exists() {
        eprintln!("skipped: no {} (OMBRA_TEST_DATA)", file.display());
        return None;
    }
    Some(read_city(file, &CityOptions::default()).unwrap())
}

/// The sun over a city, and the zone of its clocks.
struct Above {
    sky: Sky,
    calendar: Calendar,
}

impl Above {
    fn of(city: &City) -> Self {
        let [latitude, longitude] = [city.origin.latitude(), city.origin.longitude()];
        let place = Place::new(latitude, longitude, 0.0).unwrap();
        Self {
            sky: Sky::new(place, Refraction::None).unwrap(),
            calendar: Calendar::of(&place, YEAR).unwrap(),
        }
    }

    /// From rise to set, on the days that a text names.
    fn spans(&self, days: &str) -> Vec<Span> {
        let days = Days::parse(days, &self.calendar).unwrap();
        let up = |day| Hours::default().spans(&self.sky, &self.calendar.zone, day);
        days.iter().flat_map(up).collect()
    }

    fn sheets(&self, days: &str) -> Vec<Sheet> {
        let spans = self.spans(days);
        (spans.iter())
            .flat_map(|&span| Sheet::cover(&self.sky, span))
            .collect()
    }
}

/// Places on the ground outside of buildings: middles of cells of a metre, each within 20 m of the box
/// around a building that chance has named.
fn places(city: &City, count: usize) -> Vec<Point3> {
    const WITHIN: f64 = 20.0;
    let (ground, inside) = (Ground::new(city), Inside::new(city));
    let parts: Vec<&Part> = city.buildings.iter().flat_map(|b| &b.parts).collect();
    let mut state = 1_u64;
    // SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
    let mut share = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut found = Vec::with_capacity(count);
    while found.len() < count {
        let [low, high] = parts[(share() * parts.len() as f64) as usize].bounds();
        let at = [0, 1].map(|axis| {
            let from = f64::from(low[axis]) - WITHIN;
            let to = f64::from(high[axis]) + WITHIN;
            (from + share() * (to - from)).floor() + 0.5
        });
        found.extend(ground.at(at).filter(|&place| !inside.contains(place)));
    }
    found
}
