//! A day of the calendar, as instants.

use jiff::ToSpan;
use jiff::civil::{Date, Time};
use jiff::tz::TimeZone;

use crate::window::Window;
use crate::{Instant, Span};

/// A civil day: from local midnight to the next. It has 23, 24 or 25 hours, or others, or none
/// (Samoa had no 30 December 2011).
#[derive(Clone, Debug)]
pub(crate) struct CivilDay {
    /// From midnight to midnight.
    pub(crate) whole: Span,
    /// The parts of the day in which the clock runs on without a change.
    pieces: Vec<Piece>,
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    span: Span,
    /// When the clock would have shown the midnight that the day begins with.
    midnight: Instant,
}

impl CivilDay {
    /// The day of a date; none at the ends of jiff's years.
    pub(crate) fn new(date: Date, zone: &TimeZone) -> Option<Self> {
        let start = midnight(date, zone)?;
        let end = midnight(date.checked_add(1.day()).ok()?, zone)?;
        let whole = Span::new(start, end);
        let changes = zone
            .following(start.timestamp())
            .map(|change| Instant::from(change.timestamp()))
            .take_while(|change| *change < end);
        let mut cuts = vec![start];
        cuts.extend(changes);
        cuts.push(end);
        let pieces = cuts
            .windows(2)
            .map(|cut| Piece::new(Span::new(cut[0], cut[1]), date, zone))
            .collect();
        Some(Self { whole, pieces })
    }

    /// The instants at which the clock shows a time of the window: at a change of clock, those that
    /// are skipped do not count, and those that come twice count twice.
    pub(crate) fn clock(&self, window: Window) -> Vec<Span> {
        let shown = |piece: &Piece| {
            let from = piece.midnight + window.from();
            let to = piece.midnight + window.to();
            Span::new(from.max(piece.span.start), to.min(piece.span.end))
        };
        self.pieces
            .iter()
            .map(shown)
            .filter(|span| span.start < span.end)
            .collect()
    }
}

impl Piece {
    fn new(span: Span, date: Date, zone: &TimeZone) -> Self {
        // An hour or so of a fold at midnight may show the date before: the clock is then negative.
        let offset = zone.to_offset(span.start.timestamp());
        let midnight = offset
            .to_timestamp(date.to_datetime(Time::midnight()))
            .map_or(span.start, Instant::from);
        Self { span, midnight }
    }
}

/// When a date begins: at 00:00, or at the first time that its clock shows if that is skipped.
fn midnight(date: Date, zone: &TimeZone) -> Option<Instant> {
    let civil = date.to_datetime(Time::midnight());
    let found = zone.to_ambiguous_timestamp(civil).compatible().ok()?;
    Some(found.into())
}
