//! What came out, in numbers.

use std::path::Path;

use ombra::city::City;
use serde::Serialize;

use super::super::args::ShadowsArgs;
use super::super::output::files;
use super::super::when::When;
use super::{Effort, Minutes};

/// A change of fewer minutes is rounding: a wall that grows is cut where it was not, a millisecond beside.
const LEAST: f32 = 1e-3;

/// What `--json` prints.
#[derive(Serialize)]
pub(super) struct Statistics<'a> {
    city: &'a str,
    output: Option<&'a Path>,
    png: Option<&'a Path>,
    method: &'static str,
    when: &'a str,
    time_zone: &'a str,
    days: usize,
    /// Hours in which the sun counts.
    sun_hours: f64,
    buildings_before: usize,
    buildings_after: usize,
    /// In no building, before and after: of these are the means.
    places: usize,
    before_mean: f64,
    after_mean: f64,
    net_mean: f64,
    /// Places with more and with less shadow than before, and the most of it in minutes.
    gain: usize,
    lose: usize,
    gain_most: f64,
    lose_most: f64,
    /// Places that lie in a building after and not before, and the other way round.
    built_over: usize,
    set_free: usize,
    /// Places that were measured again.
    measured_again: usize,
    measured: usize,
    /// Of all places before, and of the change.
    full_seconds: f64,
    again_seconds: f64,
}

impl<'a> Statistics<'a> {
    pub(super) fn new(
        args: &'a ShadowsArgs,
        [before, after]: [&City; 2],
        when: &'a When,
        minutes: &Minutes,
        effort: &Effort,
    ) -> Self {
        let both = || {
            let pairs = minutes.before.iter().zip(&minutes.after);
            pairs.filter(|(before, after)| !before.is_nan() && !after.is_nan())
        };
        let places = both().count();
        let mean = |sum: f64| {
            if places == 0 {
                0.0
            } else {
                sum / places as f64
            }
        };
        let sums = both().fold([0.0, 0.0], |[a, b], (before, after)| {
            [a + f64::from(*before), b + f64::from(*after)]
        });
        let count = |of: &dyn Fn(f32) -> bool| minutes.net.iter().filter(|&&net| of(net)).count();
        let known = minutes.net.iter().filter(|net| !net.is_nan());
        let [least, most] = known.fold([0.0_f32; 2], |[least, most], &net| {
            [least.min(net), most.max(net)]
        });
        let turned = |from: &[f32], to: &[f32]| {
            let pairs = from.iter().zip(to);
            pairs
                .filter(|(from, to)| !from.is_nan() && to.is_nan())
                .count()
        };
        Self {
            city: &args.city,
            output: args.output.as_deref(),
            png: args.png.as_deref(),
            method: args.method.name(),
            when: &when.text,
            time_zone: &when.zone,
            days: when.days,
            sun_hours: when.hours(),
            buildings_before: before.buildings.len(),
            buildings_after: after.buildings.len(),
            places,
            before_mean: mean(sums[0]),
            after_mean: mean(sums[1]),
            net_mean: mean(sums[1] - sums[0]),
            gain: count(&|net| net > LEAST),
            lose: count(&|net| net < -LEAST),
            gain_most: f64::from(most),
            lose_most: f64::from(0.0 - least),
            built_over: turned(&minutes.before, &minutes.after),
            set_free: turned(&minutes.after, &minutes.before),
            measured_again: effort.again,
            measured: effort.places,
            full_seconds: effort.full_seconds,
            again_seconds: effort.again_seconds,
        }
    }

    /// For people.
    pub(super) fn line(&self) -> String {
        let files = files([self.output, self.png]);
        format!(
            "{files}{} places gain shadow, {:.1} minutes at most; {} lose some, {:.1} at most; net {:+.3} minutes on \
             average; {} of {} places measured again in {:.2} s (all: {:.2} s)",
            self.gain,
            self.gain_most,
            self.lose,
            self.lose_most,
            self.net_mean,
            self.measured_again,
            self.measured,
            self.again_seconds,
            self.full_seconds,
        )
    }
}
