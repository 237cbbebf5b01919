//! A moment in time.

use std::cmp::Ordering;
use std::ops::{Add, Sub};

use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp, ZonedDateTime};

/// A moment: seconds since 1970-01-01T00:00:00 UTC, as POSIX counts them (a day has 86 400). Always
/// finite. A double tells moments of our centuries apart to a quarter of a microsecond.
#[derive(Clone, Copy, Debug, Default)]
pub struct Instant(f64);

impl Instant {
    /// From seconds since 1970.
    ///
    /// # Panics
    /// If they are infinite or no number.
    #[must_use]
    pub fn from_seconds(seconds: f64) -> Self {
        assert!(seconds.is_finite(), "an instant at {seconds} s");
        // No negative zero, which would be earlier than zero.
        Self(seconds + 0.0)
    }

    /// In seconds since 1970.
    #[must_use]
    pub const fn seconds(self) -> f64 {
        self.0
    }

    /// As jiff has it, to the nearest nanosecond; one before or after jiff's years is its first or
    /// last.
    #[must_use]
    pub fn timestamp(self) -> Timestamp {
        let last = if self.0 < 0.0 {
            Timestamp::MIN
        } else {
            Timestamp::MAX
        };
        SignedDuration::try_from_secs_f64(self.0)
            .and_then(Timestamp::from_duration)
            .unwrap_or(last)
    }

    /// What the calendar and the clock of a zone show.
    #[must_use]
    pub fn zoned(self, zone: &TimeZone) -> ZonedDateTime {
        self.timestamp().to_zoned_datetime(zone.clone())
    }
}

impl From<Timestamp> for Instant {
    fn from(timestamp: Timestamp) -> Self {
        Self(timestamp.as_duration().as_secs_f64())
    }
}

impl From<&ZonedDateTime> for Instant {
    fn from(zoned: &ZonedDateTime) -> Self {
        zoned.timestamp().into()
    }
}

impl Ord for Instant {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Instant {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Instant {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Instant {}

/// So many seconds later.
impl Add<f64> for Instant {
    type Output = Self;
    fn add(self, seconds: f64) -> Self {
        Self::from_seconds(self.0 + seconds)
    }
}

/// So many seconds earlier.
impl Sub<f64> for Instant {
    type Output = Self;
    fn sub(self, seconds: f64) -> Self {
        Self::from_seconds(self.0 - seconds)
    }
}

/// The seconds from the other to this.
impl Sub for Instant {
    type Output = f64;
    fn sub(self, other: Self) -> f64 {
        self.0 - other.0
    }
}
