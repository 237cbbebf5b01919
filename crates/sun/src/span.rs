//! Stretches of time, and sets of them.

use crate::Instant;

/// Seconds below which a stretch is taken for none: what the ends are known to.
const SLIVER: f64 = 1e-3;

/// From one instant to a later one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The first instant.
    pub start: Instant,
    /// The last.
    pub end: Instant,
}

impl Span {
    /// From two instants, in order.
    #[must_use]
    pub const fn new(start: Instant, end: Instant) -> Self {
        Self { start, end }
    }

    /// How long, in seconds; not negative unless the two were turned round.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.end - self.start
    }

    /// The middles of equal parts of it, of `step` seconds or a little less; and how long each part is.
    ///
    /// # Panics
    /// If `step` is not above 0.
    pub fn middles(&self, step: f64) -> (f64, impl Iterator<Item = Instant> + use<>) {
        assert!(step > 0.0, "a step takes time");
        let count = (self.seconds() / step).ceil().max(1.0);
        let each = self.seconds() / count;
        let start = self.start;
        let middle = move |k| start + (k as f64 + 0.5) * each;
        (each, (0..count as usize).map(middle))
    }

    /// The instants of both, if those are a millisecond or more.
    fn common(&self, other: &Self) -> Option<Self> {
        let both = Self::new(self.start.max(other.start), self.end.min(other.end));
        both.lasting()
    }

    fn lasting(self) -> Option<Self> {
        (self.seconds() >= SLIVER).then_some(self)
    }
}

/// Sets of stretches: sorted and disjoint lists.
impl Span {
    /// All of them as a set: those that overlap or touch become one, and none is shorter than a millisecond.
    #[must_use]
    pub fn union(mut spans: Vec<Self>) -> Vec<Self> {
        spans.sort_by_key(|span| span.start);
        let mut merged: Vec<Self> = Vec::with_capacity(spans.len());
        for span in spans {
            match merged.last_mut() {
                Some(last) if span.start <= last.end => last.end = last.end.max(span.end),
                _ => merged.push(span),
            }
        }
        merged.retain(|span| span.seconds() >= SLIVER);
        merged
    }

    /// What two sets share.
    #[must_use]
    pub fn intersection(a: &[Self], b: &[Self]) -> Vec<Self> {
        let mut shared = Vec::with_capacity(a.len().max(b.len()));
        // As in a difference.
        let mut first = 0;
        for span in a {
            first += b[first..].partition_point(|other| other.end <= span.start);
            let others = b[first..].iter();
            let others = others.take_while(|other| other.start < span.end);
            shared.extend(others.filter_map(|other| span.common(other)));
        }
        shared
    }

    /// What is in the set `a` but not in `b`.
    #[must_use]
    pub fn difference(a: &[Self], b: &[Self]) -> Vec<Self> {
        let mut left = Vec::with_capacity(a.len() + b.len());
        // Both are in order: what ends before a span of `a` begins matters to none after it.
        let mut first = 0;
        for span in a {
            let mut start = span.start;
            first += b[first..].partition_point(|hole| hole.end <= start);
            for hole in b[first..].iter().take_while(|hole| hole.start < span.end) {
                left.extend(Self::new(start, hole.start).lasting());
                start = hole.end;
            }
            left.extend(Self::new(start, span.end).lasting());
        }
        left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: f64, end: f64) -> Span {
        Span::new(Instant::from_seconds(start), Instant::from_seconds(end))
    }

    #[test]
    fn sets_of_spans() {
        let a = Span::union(vec![
            span(5.0, 7.0),
            span(0.0, 2.0),
            span(2.0, 3.0),
            span(9.0, 9.0),
        ]);
        assert_eq!(a, [span(0.0, 3.0), span(5.0, 7.0)]);
        let b = [span(-1.0, 1.0), span(2.0, 6.0)];
        assert_eq!(
            Span::intersection(&a, &b),
            [span(0.0, 1.0), span(2.0, 3.0), span(5.0, 6.0)]
        );
        assert_eq!(Span::difference(&a, &b), [span(1.0, 2.0), span(6.0, 7.0)]);
        assert_eq!(Span::difference(&b, &a), [span(-1.0, 0.0), span(3.0, 5.0)]);
        assert_eq!(Span::difference(&a, &a), []);
        assert_eq!(Span::difference(&a, &[]), a);
    }
}
