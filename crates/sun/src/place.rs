//! A place on the Earth, and its time zone.

use std::sync::OnceLock;

use jiff::tz::TimeZone;
use tzf_rs::DefaultFinder;

use crate::SunError;

/// Where a city is, on WGS84.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Degrees, north positive, -90 to 90.
    pub latitude: f64,
    /// Degrees, east positive, -180 to 180.
    pub longitude: f64,
    /// Metres above the sea. A kilometre moves the sun by a thousandth of an arc second or two.
    pub height: f64,
}

impl Place {
    /// From degrees and metres.
    ///
    /// # Errors
    /// A coordinate that is no number or out of its range.
    pub fn new(latitude: f64, longitude: f64, height: f64) -> Result<Self, SunError> {
        if !(-90.0..=90.0).contains(&latitude) {
            return Err(SunError::Latitude(latitude));
        }
        if !(-180.0..=180.0).contains(&longitude) {
            return Err(SunError::Longitude(longitude));
        }
        if !(-500.0..=9000.0).contains(&height) {
            return Err(SunError::Height(height));
        }
        Ok(Self {
            latitude,
            longitude,
            height,
        })
    }

    /// The IANA name of the time zone here, as `Europe/Amsterdam`. Borders are those of
    /// timezone-boundary-builder, made simpler: within some hundred metres of one the zone may be
    /// the neighbour's.
    ///
    /// # Errors
    /// No zone is mapped here.
    pub fn time_zone_name(&self) -> Result<&'static str, SunError> {
        // Reading the map takes a good part of a second, so once, and only when somebody asks.
        static MAP: OnceLock<DefaultFinder> = OnceLock::new();
        let map = MAP.get_or_init(DefaultFinder::new);
        match map.get_tz_name(self.longitude, self.latitude) {
            "" => Err(SunError::NoZone {
                latitude: self.latitude,
                longitude: self.longitude,
            }),
            name => Ok(name),
        }
    }

    /// The time zone here, with its changes of clock.
    ///
    /// # Errors
    /// No zone is mapped here, or the time zone database lacks it.
    pub fn time_zone(&self) -> Result<TimeZone, SunError> {
        let name = self.time_zone_name()?;
        TimeZone::get(name).map_err(|_| SunError::UnknownZone(name.to_owned()))
    }
}
