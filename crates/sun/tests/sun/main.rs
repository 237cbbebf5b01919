//! Where the sun stands, held against facts, published values and laws.

mod days;
mod disc;
mod facts;
mod hours;
mod place;
mod reference;
mod sheets;

use jiff::civil::Date;
use jiff::tz::TimeZone;
use ombra_sun::{Hours, Instant, Place, Refraction, Sky, Span};

/// The sky over a place at the sea, without air.
fn sky(latitude: f64, longitude: f64) -> Sky {
    let place = Place::new(latitude, longitude, 0.0).unwrap();
    Sky::new(place, Refraction::None).unwrap()
}

fn date(text: &str) -> Date {
    text.parse().unwrap()
}

/// An instant such as `2026-06-21T12:00:00Z`.
fn instant(text: &str) -> Instant {
    text.parse::<jiff::Timestamp>().unwrap().into()
}

/// The whole day from sunrise to sunset, by a clock of mean solar time.
fn up(sky: &Sky, day: &str) -> Vec<Span> {
    Hours::default().spans(sky, &mean_time(sky.place().longitude), date(day))
}

/// A zone of the hour next to the sun's.
fn mean_time(longitude: f64) -> TimeZone {
    TimeZone::fixed(jiff::tz::offset((longitude / 15.0).round() as i8))
}

fn total(spans: &[Span]) -> f64 {
    spans.iter().map(Span::seconds).sum()
}

/// Random numbers from a seed (splitmix64), the same everywhere.
struct Random(u64);

impl Random {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }
}
