//! How much of many places lies in shadow at a time, and from when to when any of them does.

use ombra_sun::{Instant, Span};

use crate::spells::{Stretch, Stretches};

/// New shadow that lasts no longer than this at a place, in seconds, is none: that is how well the ends of stretches are known.
const LEAST: f64 = 0.1;

/// When a place lies in shadow, whoever throws it.
#[must_use]
pub fn shadow(stretches: &[Stretch]) -> Vec<Span> {
    let spans = stretches.iter().map(|own| Span::new(own.from, own.to));
    Span::union(spans.collect())
}

/// When each place lies in shadow after a change of the city, and did not before. What stretches are good to (a tenth of a
/// second) is no new shadow.
///
/// # Panics
/// If the two are not of the same places.
#[must_use]
pub fn new_shadow(before: &Stretches, after: &Stretches) -> Vec<Vec<Span>> {
    assert_eq!(before.len(), after.len(), "the same places");
    let pairs = before.iter().zip(after.iter());
    let of_place =
        |(before, after): (&[Stretch], &[Stretch])| gained(&shadow(before), &shadow(after));
    pairs.map(of_place).collect()
}

/// When something holds after a change that did not before, without what rounding of the ends of stretches leaves. Both are in order.
#[must_use]
pub fn gained(before: &[Span], after: &[Span]) -> Vec<Span> {
    let mut new = Span::difference(after, before);
    new.retain(|span| span.seconds() > LEAST);
    new
}

/// How many of some places something holds for, over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coverage {
    /// From each of these instants on, until the next one: of so many places. It begins above 0 and ends with 0.
    steps: Vec<(Instant, usize)>,
}

/// The most of a [`Coverage`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Of so many places.
    pub places: usize,
    /// The first time for which that holds.
    pub when: Span,
}

impl Coverage {
    /// Of the times at which it holds for each place.
    #[must_use]
    pub fn of<'a>(places: impl IntoIterator<Item = &'a [Span]>) -> Self {
        let mut events: Vec<(Instant, isize)> = (places.into_iter().flatten())
            .flat_map(|span| [(span.start, 1), (span.end, -1)])
            .collect();
        events.sort_by(|a, b| a.0.seconds().total_cmp(&b.0.seconds()));
        let mut steps: Vec<(Instant, usize)> = Vec::new();
        let mut count = 0_isize;
        for at_once in events.chunk_by(|a, b| a.0 == b.0) {
            count += at_once.iter().map(|event| event.1).sum::<isize>();
            let now = count.unsigned_abs();
            if steps.last().map_or(0, |last| last.1) != now {
                steps.push((at_once[0].0, now));
            }
        }
        Self { steps }
    }

    /// The parts of time with the same number of places each, in order; those with none are left out.
    pub fn parts(&self) -> impl Iterator<Item = (Span, usize)> + '_ {
        let pairs = self.steps.windows(2);
        let parts = pairs.map(|pair| (Span::new(pair[0].0, pair[1].0), pair[0].1));
        parts.filter(|part| part.1 > 0)
    }

    /// When it holds for at least so many places. Parts that are no further apart than `gap` seconds are one.
    #[must_use]
    pub fn periods(&self, least: usize, gap: f64) -> Vec<Span> {
        let mut periods: Vec<Span> = Vec::new();
        for (span, _) in self.parts().filter(|part| part.1 >= least) {
            match periods.last_mut() {
                Some(last) if span.start - last.end <= gap => last.end = span.end,
                _ => periods.push(span),
            }
        }
        periods
    }

    /// The most places for which it holds at once; `None` if it never does.
    #[must_use]
    pub fn most(&self) -> Option<Peak> {
        let first = |best: Option<Peak>, (when, places)| match best {
            Some(best) if best.places >= places => Some(best),
            _ => Some(Peak { places, when }),
        };
        self.parts().fold(None, first)
    }

    /// Summed over places and time: seconds of single places.
    #[must_use]
    pub fn place_seconds(&self) -> f64 {
        let sum = |(span, places): (Span, usize)| span.seconds() * places as f64;
        self.parts().map(sum).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: f64, end: f64) -> Span {
        Span::new(Instant::from_seconds(start), Instant::from_seconds(end))
    }

    fn stretch(from: f64, to: f64, owner: u32) -> Stretch {
        Stretch {
            from: Instant::from_seconds(from),
            to: Instant::from_seconds(to),
            owner,
            is_alone: true,
        }
    }

    #[test]
    fn coverage_counts_what_holds_at_once() {
        let places = [
            vec![span(0.0, 10.0)],
            vec![span(5.0, 20.0), span(50.0, 60.0)],
            vec![],
            vec![span(20.0, 30.0)],
        ];
        let coverage = Coverage::of(places.iter().map(Vec::as_slice));
        let parts: Vec<_> = coverage.parts().collect();
        let expected = [
            (span(0.0, 5.0), 1),
            (span(5.0, 10.0), 2),
            (span(10.0, 30.0), 1),
            (span(50.0, 60.0), 1),
        ];
        assert_eq!(parts, expected);
        let most = Peak {
            places: 2,
            when: span(5.0, 10.0),
        };
        assert_eq!(coverage.most(), Some(most));
        assert_eq!(
            coverage.periods(1, 0.0),
            [span(0.0, 30.0), span(50.0, 60.0)]
        );
        assert_eq!(coverage.periods(1, 20.0), [span(0.0, 60.0)]);
        assert_eq!(coverage.periods(2, 0.0), [span(5.0, 10.0)]);
        assert_eq!(coverage.place_seconds(), 45.0);
    }

    #[test]
    fn nothing_covers_nothing() {
        let coverage = Coverage::of([&[][..], &[]]);
        assert_eq!(coverage, Coverage::default());
        assert_eq!(coverage.most(), None);
        assert!(coverage.periods(0, 1e9).is_empty());
        assert_eq!(coverage.place_seconds(), 0.0);
    }

    #[test]
    fn all_the_same_is_one_part() {
        let same = [span(3.0, 7.0)];
        let coverage = Coverage::of([&same[..]; 5]);
        assert_eq!(coverage.parts().collect::<Vec<_>>(), [(same[0], 5)]);
    }

    #[test]
    fn what_rounding_leaves_is_not_gained() {
        let before = [span(10.0, 20.0), span(30.0, 40.0)];
        let after = [span(9.95, 20.05), span(28.0, 40.09), span(50.0, 50.09)];
        assert_eq!(gained(&before, &after), [span(28.0, 30.0)]);
        assert!(gained(&before, &before).is_empty());
        assert!(gained(&before, &[]).is_empty());
        assert_eq!(gained(&[], &before), before);
    }

    #[test]
    fn new_shadow_is_what_was_not_there_before() {
        let (mut before, mut after) = (Stretches::default(), Stretches::default());
        // Of two buildings that follow one another; the new one stands before, between and behind them.
        before.push([stretch(10.0, 20.0, 0), stretch(20.0, 30.0, 1)]);
        after.push([stretch(5.0, 25.0, 2), stretch(25.0, 40.0, 1)]);
        // What rounding leaves is none.
        before.push([stretch(10.0, 20.0, 0)]);
        after.push([stretch(9.95, 20.05, 2)]);
        before.push([]);
        after.push([stretch(1.0, 2.0, 2)]);
        let new = new_shadow(&before, &after);
        assert_eq!(new[0], [span(5.0, 10.0), span(30.0, 40.0)]);
        assert!(new[1].is_empty());
        assert_eq!(new[2], [span(1.0, 2.0)]);
    }
}
