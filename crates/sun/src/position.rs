//! Where the sun stands at an instant.
//!
//! NREL's algorithm: I. Reda, A. Andreas, "Solar Position Algorithm for Solar Radiation
//! Applications", Solar Energy 76 (2004), from the crate `solar-positioning`.

use solar_positioning::time::JulianDate;
use solar_positioning::{
    Location, PreparedPositions, RefractionCorrection, SolarPositions, delta_t,
};

use crate::disc::{beside, lifted, not_below_horizon};
use crate::{Instant, Place, SunError};

/// Seconds of a day.
pub(crate) const DAY: f64 = 86_400.0;
/// The Julian date of 1970-01-01T00:00:00 UTC.
const EPOCH: f64 = 2_440_587.5;
/// Seconds of a mean year of the Gregorian calendar.
const YEAR: f64 = 31_556_952.0;

/// The centre of the sun in the sky of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Degrees clockwise from north, 0 to 360: east is 90.
    pub azimuth: f64,
    /// Degrees above the horizon, -90 to 90.
    pub altitude: f64,
}

impl Sun {
    /// The unit vector to the sun: (east, north, up).
    #[must_use]
    pub fn direction(self) -> [f64; 3] {
        let (east, north) = self.azimuth.to_radians().sin_cos();
        let (up, flat) = self.altitude.to_radians().sin_cos();
        [east * flat, north * flat, up]
    }
}

/// Whether the air lifts the sun.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Refraction {
    /// No air: the sun is where geometry has it.
    #[default]
    None,
    /// Air of one pressure and temperature, which lifts a sun at the horizon by about half a degree
    /// (Bennett's formula, as in NREL's report). A sun below -0.83337° is not lifted.
    Standard {
        /// At the place, not at the sea; 1 to 1100 mbar.
        pressure_mbar: f64,
        /// -90 to 60 °C.
        temperature_celsius: f64,
    },
}

impl Refraction {
    /// The standard atmosphere at the sea: 1013.25 mbar, 15 °C.
    pub const SEA: Self = Self::Standard {
        pressure_mbar: 1013.25,
        temperature_celsius: 15.0,
    };

    fn correction(self) -> Result<Option<RefractionCorrection>, SunError> {
        let Self::Standard {
            pressure_mbar: pressure,
            temperature_celsius: temperature,
        } = self
        else {
            return Ok(None);
        };
        if !(1.0..=1100.0).contains(&pressure) {
            return Err(SunError::Pressure(pressure));
        }
        if !(-90.0..=60.0).contains(&temperature) {
            return Err(SunError::Temperature(temperature));
        }
        RefractionCorrection::new(pressure, temperature)
            .map(Some)
            .map_err(|_| SunError::Pressure(pressure))
    }
}

/// The sky of a place, ready to be asked where the sun is.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    place: Place,
    refraction: Refraction,
    correction: Option<RefractionCorrection>,
    delta_t: Option<f64>,
    /// Which point of the sun's disc directions are to, in radii; its middle if none.
    disc_point: Option<[f64; 2]>,
}

impl Sky {
    /// The sky over a place.
    ///
    /// # Errors
    /// Air that cannot be; a place whose fields were set out of range.
    pub fn new(place: Place, refraction: Refraction) -> Result<Self, SunError> {
        Ok(Self {
            place: Place::new(place.latitude, place.longitude, place.height)?,
            refraction,
            correction: refraction.correction()?,
            delta_t: None,
            disc_point: None,
        })
    }

    /// The same with a known ΔT (terrestrial time less UT1, seconds) in place of the estimate by
    /// date. A second of it moves the sun by 0.04 arc seconds.
    #[must_use]
    pub fn with_delta_t(self, seconds: f64) -> Self {
        Self {
            delta_t: seconds.is_finite().then(|| seconds.clamp(-1e5, 1e5)),
            ..self
        }
    }

    /// The same with directions to a point of the sun's disc.
    pub(crate) fn at_disc_point(self, at: [f64; 2]) -> Self {
        Self {
            disc_point: Some(at),
            ..self
        }
    }

    /// Whether directions are to a point of the sun's disc.
    pub(crate) const fn is_at_disc_point(&self) -> bool {
        self.disc_point.is_some()
    }

    /// Which place.
    #[must_use]
    pub const fn place(&self) -> Place {
        self.place
    }

    /// Which air.
    #[must_use]
    pub const fn refraction(&self) -> Refraction {
        self.refraction
    }

    /// Where the centre of the sun is, with parallax and, if asked for, refraction. Takes some 8 µs.
    ///
    /// Good to 0.0003° over the years -2000 to 6000, but for ΔT, which is an estimate; before -500
    /// and after 3000 that of the nearest year is taken, and beyond SPA's years the sun of the
    /// nearest instant within them.
    #[must_use]
    pub fn at(&self, instant: Instant) -> Sun {
        self.seen(&prepared(instant, self.delta_t), self.correction)
    }

    /// The unit vector to the sun: (east, north, up). That is its centre, or a point of its [`Disc`](crate::Disc): where such a
    /// point has not risen yet or has set, it is the one on the horizon above it. Air lifts all of
    /// the disc by as much as its centre.
    #[must_use]
    pub fn direction(&self, instant: Instant) -> [f64; 3] {
        let toward = self.toward(instant);
        if self.is_at_disc_point() {
            not_below_horizon(toward)
        } else {
            toward
        }
    }

    /// The same wherever the horizon is.
    pub(crate) fn toward(&self, instant: Instant) -> [f64; 3] {
        let Some(point) = self.disc_point else {
            return self.at(instant).direction();
        };
        let prepared = prepared(instant, self.delta_t);
        let middle = self.seen(&prepared, None);
        let distance = prepared.earth_radius_vector().expect("SPA knows it");
        let latitude = self.place.latitude.to_radians();
        let lift = self.seen(&prepared, self.correction).altitude - middle.altitude;
        let bare = beside(middle.direction(), latitude, distance, point);
        lifted(bare, lift.to_radians())
    }

    fn seen(&self, prepared: &PreparedPositions, air: Option<RefractionCorrection>) -> Sun {
        let seen = prepared
            .at(self.location(), self.place.height, air)
            .expect("checked in `new`");
        Sun {
            azimuth: seen.azimuth(),
            altitude: seen.elevation_angle(),
        }
    }

    /// True (apparent) solar time, seconds after true midnight, 0 to 86 400: what a sundial shows.
    /// 43 200 is true noon, when the sun's centre, seen from the Earth's, crosses the meridian.
    #[must_use]
    pub fn solar_time(&self, instant: Instant) -> f64 {
        // From the pole there is no parallax in azimuth, and the azimuth is the hour angle + 180°.
        let pole = Location {
            latitude: 90.0,
            longitude: self.place.longitude,
        };
        let seen = prepared(instant, self.delta_t)
            .at(pole, 0.0, None)
            .expect("a longitude checked in `new`");
        seen.azimuth() / 360.0 * DAY
    }

    /// The instant nearest to `near` at which a sundial shows `solar_time`, seconds after true
    /// midnight; to a microsecond or what a Julian date in a double resolves, 40 µs.
    #[must_use]
    pub fn at_solar_time(&self, solar_time: f64, near: Instant) -> Instant {
        let mut instant = near;
        // A sundial gains or loses at most 30 s a day: each step leaves 0.00035 of the miss.
        for _ in 0..4 {
            let miss = (solar_time - self.solar_time(instant) + DAY / 2.0).rem_euclid(DAY);
            instant = instant + (miss - DAY / 2.0);
        }
        instant
    }

    fn location(&self) -> Location {
        Location {
            latitude: self.place.latitude,
            longitude: self.place.longitude,
        }
    }
}

/// The sun as all places share it.
pub(crate) fn prepared(instant: Instant, delta: Option<f64>) -> PreparedPositions {
    let year = 1970.0 + instant.seconds() / YEAR;
    let delta = delta.unwrap_or_else(|| {
        delta_t::estimate(year.clamp(-499.0, 2999.0)).expect("a year that ΔT is known for")
    });
    // A year within the -2000 to 6000 of SPA, so that ΔT leads out of them at neither end.
    let day = (instant.seconds() / DAY).clamp(-1_449_000.0, 1_472_000.0);
    JulianDate::new(EPOCH + day, delta)
        .and_then(|time| SolarPositions::new().for_time_from_julian(time))
        .expect("clamped to the years of SPA")
}
