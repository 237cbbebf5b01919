//! Contestants that do the same job, in turns.

use std::fmt::Debug;
use std::time::Instant;

use anyhow::ensure;

/// One way to do a job. All contestants of a job give equal answers.
pub struct Contestant<'a, Answer> {
    /// For people and records.
    pub name: &'static str,
    /// Does the job, on the threads it is called from.
    pub run: Box<dyn Fn() -> Answer + Sync + 'a>,
}

impl<'a, Answer> Contestant<'a, Answer> {
    /// By name.
    pub fn new(name: &'static str, run: impl Fn() -> Answer + Sync + 'a) -> Self {
        let run = Box::new(run);
        Self { name, run }
    }
}

impl<Answer> Debug for Contestant<'_, Answer> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Contestant").field(&self.name).finish()
    }
}

/// Runs every contestant once and compares their answers with the first one's, which is returned.
///
/// # Errors
/// When one differs, or there is no contestant.
pub fn compare<Answer: PartialEq>(
    contestants: &[Contestant<'_, Answer>],
) -> anyhow::Result<Answer> {
    let Some((first, others)) = contestants.split_first() else {
        anyhow::bail!("there is no contestant");
    };
    let expected = (first.run)();
    for other in others {
        ensure!(
            (other.run)() == expected,
            "\"{}\" does not give the answer of \"{}\"",
            other.name,
            first.name
        );
    }
    Ok(expected)
}

/// Takes the times of all contestants in seconds: for each a list, one entry a round. Each round
/// begins with another contestant, so that none always comes first.
#[must_use]
pub fn times<Answer>(contestants: &[Contestant<'_, Answer>], rounds: usize) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::with_capacity(rounds); contestants.len()];
    for round in 0..rounds {
        for turn in 0..contestants.len() {
            let who = (round + turn) % contestants.len();
            let begin = Instant::now();
            let answer = (contestants[who].run)();
            times[who].push(begin.elapsed().as_secs_f64());
            drop(std::hint::black_box(answer));
        }
    }
    times
}

/// The middle of some numbers and how far they spread.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Spread {
    /// As many are below as above.
    pub median: f64,
    /// A quarter is below.
    pub lower_quartile: f64,
    /// A quarter is above.
    pub upper_quartile: f64,
    /// The smallest.
    pub least: f64,
}

impl Spread {
    /// Of some numbers; `None` if there are none.
    #[must_use]
    pub fn of(numbers: &[f64]) -> Option<Self> {
        let mut sorted = numbers.to_vec();
        sorted.sort_by(f64::total_cmp);
        // Between neighbours where the place is not a whole number.
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let (low, high) = (place.floor() as usize, place.ceil() as usize);
            sorted[low] + (sorted[high] - sorted[low]) * (place - place.floor())
        };
        (!sorted.is_empty()).then(|| Self {
            median: at(0.5),
            lower_quartile: at(0.25),
            upper_quartile: at(0.75),
            least: sorted[0],
        })
    }

    /// Of the quotients of two lists, round by round.
    #[must_use]
    pub fn of_ratios(numbers: &[f64], base: &[f64]) -> Option<Self> {
        let ratios: Vec<_> = numbers.iter().zip(base).map(|(n, b)| n / b).collect();
        Self::of(&ratios)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contestant_with_another_answer_is_named() {
        let contest = [Contestant::new("one", || 1), Contestant::new("two", || 2)];
        let error = compare(&contest).unwrap_err().to_string();
        assert_eq!(error, "\"two\" does not give the answer of \"one\"");
        assert_eq!(compare(&contest[..1]).unwrap(), 1);
        assert!(compare::<u8>(&[]).is_err());
    }

    #[test]
    fn everybody_runs_once_a_round() {
        let contest = [Contestant::new("a", || ()), Contestant::new("b", || ())];
        assert!(times(&contest, 5).iter().all(|times| times.len() == 5));
    }

    #[test]
    fn the_spread_of_nothing_one_and_many() {
        assert_eq!(Spread::of(&[]), None);
        assert_eq!(Spread::of(&[7.0]).unwrap().median, 7.0);
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((spread.median, spread.least), (2.5, 1.0));
        assert_eq!((spread.lower_quartile, spread.upper_quartile), (1.75, 3.25));
    }
}
