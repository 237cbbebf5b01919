//! What the names of days mean at a place.

use jiff::tz::TimeZone;

use crate::days::checked_year;
use crate::{Place, SunError};

/// What turns words such as `winter` into dates.
#[derive(Clone, Debug)]
pub struct Calendar {
    /// By whose clock days begin.
    pub zone: TimeZone,
    /// Whether winter is in January: true on the equator too.
    pub north: bool,
    /// The year of what is named without one.
    pub year: i16,
}

impl Calendar {
    /// That of a place, with the time zone that it lies in.
    ///
    /// # Errors
    /// No zone is known there, or a year out of range.
    pub fn of(place: &Place, year: i16) -> Result<Self, SunError> {
        Self::with_zone(place, year, place.time_zone()?)
    }

    /// That of a place, with a time zone that is known already.
    ///
    /// # Errors
    /// A year out of range.
    pub fn with_zone(place: &Place, year: i16, zone: TimeZone) -> Result<Self, SunError> {
        Ok(Self {
            zone,
            north: place.latitude >= 0.0,
            year: checked_year(year.into())?,
        })
    }
}
