//! What follows from stretches of shadow, without looking at a city again.

use ombra_sun::{Instant, Span};

use super::stretch::Stretch;

/// Stretches of time that lie no further apart than this, in seconds, are one: files hold milliseconds.
const TOUCHING: f64 = 0.002;

/// A stretch of time that is asked about, and by how much its seconds count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted {
    /// From when to when.
    pub span: Span,
    /// By how much; 1 counts seconds as they are.
    pub weight: f64,
}

impl Counted {
    /// As it is.
    #[must_use]
    pub const fn plainly(span: Span) -> Self {
        Self { span, weight: 1.0 }
    }
}

/// One place's shadow and sun within the time that is asked about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Seconds in shadow, by their weights.
    pub shadow: f64,
    /// Seconds in the sun, by their weights.
    pub sun: f64,
    /// When the sun first shines on the place, and last; none if it never does.
    pub first_sun: Option<Instant>,
    /// See [`first_sun`](Self::first_sun).
    pub last_sun: Option<Instant>,
    /// The longest time in the sun without a break, in seconds as they are. Where the time that is asked about has a gap, there is
    /// a break.
    pub longest_sun: f64,
    /// How often it is in shadow: what several buildings cast one after another counts once.
    pub spells: usize,
}

impl Summary {
    /// Of a place's stretches, in order; `counted` do not overlap and are in order.
    #[must_use]
    pub fn new(stretches: &[Stretch], counted: &[Counted]) -> Self {
        let mut summary = Self::default();
        // The time in the sun, or in shadow, that goes on.
        let mut run: Option<(bool, Instant, Instant)> = None;
        let mut add = |is_sun: bool, from: Instant, to: Instant, weight: f64| {
            let seconds = (to - from) * weight;
            if is_sun {
                summary.sun += seconds;
                summary.first_sun.get_or_insert(from);
                summary.last_sun = Some(to);
            } else {
                summary.shadow += seconds;
            }
            let begin = match run {
                Some((was_sun, begin, end)) if was_sun == is_sun && from - end <= TOUCHING => begin,
                _ => {
                    summary.spells += usize::from(!is_sun);
                    from
                }
            };
            if is_sun {
                summary.longest_sun = summary.longest_sun.max(to - begin);
            }
            run = Some((is_sun, begin, to));
        };
        each_within(stretches, counted, |counted, own| {
            let Span { start, end } = counted.span;
            let mut at = start;
            for stretch in own {
                let (from, to) = (stretch.from.max(at), stretch.to.min(end));
                if from - at > TOUCHING {
                    add(true, at, from, counted.weight);
                    at = from;
                }
                if at < to {
                    add(false, at, to, counted.weight);
                    at = to;
                }
            }
            if end - at > TOUCHING {
                add(true, at, end, counted.weight);
            }
        });
        summary
    }
}

/// How long one building takes the sun from a place, within the time that is asked about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// See [`Stretch::owner`].
    pub owner: u32,
    /// Seconds, by their weights, in which it is the first that the ray toward the sun meets.
    pub seconds: f64,
    /// And in which no other building stands behind it: what the place would gain without it.
    pub alone: f64,
}

impl Share {
    /// Of a place's stretches, in order: one for each building, the longest first.
    #[must_use]
    pub fn all(stretches: &[Stretch], counted: &[Counted]) -> Vec<Self> {
        let mut shares: Vec<Self> = Vec::new();
        each_within(stretches, counted, |counted, own| {
            for stretch in own {
                let from = stretch.from.max(counted.span.start);
                let to = stretch.to.min(counted.span.end);
                let seconds = (to - from).max(0.0) * counted.weight;
                if seconds <= 0.0 {
                    continue;
                }
                let known = shares.iter().position(|share| share.owner == stretch.owner);
                let place = known.unwrap_or_else(|| {
                    shares.push(Self {
                        owner: stretch.owner,
                        ..Self::default()
                    });
                    shares.len() - 1
                });
                shares[place].seconds += seconds;
                if stretch.is_alone {
                    shares[place].alone += seconds;
                }
            }
        });
        let longest = |a: &Self, b: &Self| b.seconds.total_cmp(&a.seconds);
        shares.sort_by(|a, b| longest(a, b).then(a.owner.cmp(&b.owner)));
        shares
    }
}

/// Shows each stretch of time that is asked about with the stretches of shadow that reach into it.
fn each_within(
    stretches: &[Stretch],
    counted: &[Counted],
    mut show: impl FnMut(&Counted, &[Stretch]),
) {
    let mut first = 0;
    for counted in counted {
        let Span { start, end } = counted.span;
        first += stretches[first..].partition_point(|stretch| stretch.to <= start);
        let count = stretches[first..].partition_point(|stretch| stretch.from < end);
        show(counted, &stretches[first..first + count]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(minutes: f64) -> Instant {
        Instant::from_seconds(60.0 * minutes)
    }

    fn span(from: f64, to: f64) -> Span {
        Span::new(at(from), at(to))
    }

    fn stretch(from: f64, to: f64, owner: u32, is_alone: bool) -> Stretch {
        Stretch {
            from: at(from),
            to: at(to),
            owner,
            is_alone,
        }
    }

    /// Sun up from minute 0 to 600: two buildings from 60 to 120, one of them again from 300 to 310.
    fn place() -> [Stretch; 4] {
        [
            stretch(60.0, 80.0, 7, true),
            stretch(80.0, 90.0, 7, false),
            stretch(90.0, 120.0, 3, true),
            stretch(300.0, 310.0, 7, true),
        ]
    }

    #[test]
    fn a_day_adds_up() {
        let summary = Summary::new(&place(), &[Counted::plainly(span(0.0, 600.0))]);
        let expected = Summary {
            shadow: 70.0 * 60.0,
            sun: 530.0 * 60.0,
            first_sun: Some(at(0.0)),
            last_sun: Some(at(600.0)),
            longest_sun: 290.0 * 60.0,
            spells: 2,
        };
        assert_eq!(summary, expected);
    }

    #[test]
    fn hours_cut_stretches_and_weights_count() {
        let counted = [
            Counted {
                span: span(70.0, 100.0),
                weight: 2.0,
            },
            Counted {
                span: span(100.0, 130.0),
                weight: 1.0,
            },
            Counted::plainly(span(305.0, 320.0)),
        ];
        let summary = Summary::new(&place(), &counted);
        assert_eq!(summary.shadow, 60.0 * (2.0 * 30.0 + 20.0 + 5.0));
        assert_eq!(summary.sun, 60.0 * (10.0 + 10.0));
        // What goes on from one window to the next is one.
        assert_eq!(summary.spells, 2);
        assert_eq!(summary.longest_sun, 600.0);
        assert_eq!(summary.first_sun, Some(at(120.0)));
        let shares = Share::all(&place(), &counted);
        let seven = Share {
            owner: 7,
            seconds: 60.0 * (2.0 * 20.0 + 5.0),
            alone: 60.0 * (2.0 * 10.0 + 5.0),
        };
        let three = Share {
            owner: 3,
            seconds: 60.0 * (2.0 * 10.0 + 20.0),
            alone: 60.0 * (2.0 * 10.0 + 20.0),
        };
        assert_eq!(shares, [seven, three]);
    }

    #[test]
    fn nothing_is_asked_and_nothing_is_dark() {
        assert_eq!(Summary::new(&place(), &[]), Summary::default());
        assert!(Share::all(&place(), &[]).is_empty());
        let summary = Summary::new(&[], &[Counted::plainly(span(0.0, 10.0))]);
        assert_eq!((summary.sun, summary.spells), (600.0, 0));
        assert_eq!(summary.longest_sun, 600.0);
        let dark = [stretch(-5.0, 20.0, 1, true)];
        let summary = Summary::new(&dark, &[Counted::plainly(span(0.0, 10.0))]);
        assert_eq!((summary.sun, summary.shadow), (0.0, 600.0));
        assert_eq!((summary.first_sun, summary.last_sun), (None, None));
    }
}
