//! Where the sun stands: places, periods of days and hours, positions, arcs of its way.
//!
//! The way to a sheet, of which the shadows of a day are made:
//!
//! ```
//! use ombra_sun::{Calendar, Days, Hours, Place, Refraction, Sheet, Sky};
//!
//! # fn main() -> Result<(), ombra_sun::SunError> {
//! let delft = Place::new(52.011, 4.357, 0.0)?;
//! let sky = Sky::new(delft, Refraction::None)?;
//! let calendar = Calendar::of(&delft, 2026)?;
//! let hours = Hours::default().with_clock("09:00-15:30")?;
//! for date in Days::parse("2026-12-21", &calendar)?.iter() {
//!     for span in hours.spans(&sky, &calendar.zone, date) {
//!         assert_eq!(span.seconds(), 6.5 * 3600.0);
//!         for sheet in Sheet::cover(&sky, span) {
//!             assert!(sheet.arcs().len() <= 64);
//!         }
//!     }
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # Units
//! Angles are degrees, azimuths clockwise from north; times are seconds; directions are (east,
//! north, up) at the place. The sun is its centre, a point, or each of the points of a [`Disc`]. Single places of a city differ in
//! where they are by far less than the sun's position is known: one [`Sky`] serves them all.

mod arc;
mod calendar;
mod civil;
mod crossing;
mod days;
mod disc;
mod error;
mod hours;
mod instant;
mod names;
mod place;
mod position;
mod season;
mod sheet;
mod span;
mod window;

pub use arc::Arc;
pub use calendar::Calendar;
pub use days::{Days, MAX_DAYS, YEARS};
pub use disc::Disc;
pub use error::SunError;
pub use hours::{ALMANAC_SUNRISE, Hours, MAX_WINDOWS};
pub use instant::Instant;
pub use names::{Months, Weekdays};
pub use place::Place;
pub use position::{Refraction, Sky, Sun};
pub use season::{Season, Turn};
pub use sheet::{Knots, MAX_ARCS, MAX_SWEEP, Sheet};
pub use span::Span;
pub use window::{Window, parse_duration};
