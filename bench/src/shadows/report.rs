//! What was found, for programs. [`Report::tables`] is for people.

use serde::Serialize;

use super::what_if::WhatIfRecord;
use crate::contest::Spread;
use crate::machine::Machine;

/// All that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// On what.
    pub machine: Machine,
    /// Whose rays: "Embree 4.4.0, build of high quality", or ombra's own.
    pub rays: String,
    /// Why there is no Embree, and how to get it.
    pub missing: Option<String>,
    /// How many rounds were on the clock.
    pub rounds: usize,
    /// Whether seconds on one thread are those that the thread ran; otherwise the wall's.
    pub thread_clock: bool,
    /// The cities.
    pub cities: Vec<CityRecord>,
    /// Exact shadow time against one ray a minute.
    pub jobs: Vec<JobRecord>,
    /// Exact shadow time by instruction sets and threads.
    pub own: Vec<OwnRecord>,
    /// One tower that is other than it was, against all measured anew.
    pub what_if: Vec<WhatIfRecord>,
}

/// A city.
#[derive(Clone, Debug, Serialize)]
pub struct CityRecord {
    /// Its name or its file.
    pub city: String,
    /// How many buildings it has.
    pub buildings: usize,
    /// How many polygons cast shadow.
    pub polygons: usize,
    /// Seconds on the wall, all threads: from polygons to what exact shadow time is found with.
    pub build_seconds: f64,
}

/// A period at some places.
#[derive(Clone, Debug, Serialize)]
pub struct JobRecord {
    /// "shadows".
    pub bench: &'static str,
    /// Which city.
    pub city: String,
    /// Where and when.
    pub job: String,
    /// How many places.
    pub places: usize,
    /// How many rays a place: one a minute.
    pub rays: usize,
    /// Exact shadow time first, then the rays.
    pub times: Vec<Timed>,
    /// How many times as quick as single rays.
    pub over_single: Option<Ratio>,
    /// How many times as quick as the best of packets.
    pub over_packets: Option<Ratio>,
    /// Seconds in shadow by the exact way, the mean of all places.
    pub mean_seconds: f64,
    /// By how many seconds one ray a minute differs from it.
    pub sampling: Difference,
    /// By how many seconds packets differ from single rays; nothing without packets.
    pub packets: Option<Difference>,
}

/// A contestant's time.
#[derive(Clone, Debug, Serialize)]
pub struct Timed {
    /// Who.
    pub contestant: String,
    /// Microseconds a place; nothing if no round was on the clock.
    pub micros: Option<Spread>,
}

/// How many times as quick.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ratio {
    /// Of the medians of all rounds.
    pub of_medians: f64,
    /// Of the best rounds.
    pub of_best: f64,
}

/// How far two answers lie apart, seconds of shadow.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Difference {
    /// The mean of all places.
    pub mean: f64,
    /// The most at any place.
    pub most: f64,
}

/// Exact shadow time in one of several ways.
#[derive(Clone, Debug, Serialize)]
pub struct OwnRecord {
    /// Which city.
    pub city: String,
    /// Where and when.
    pub job: String,
    /// "avx2", "2 threads".
    pub way: String,
    /// Microseconds a place: on one thread those that it ran, by threads the wall's.
    pub micros: Option<Spread>,
    /// How many times as quick as the first of its kind.
    pub speed: Option<Ratio>,
}

impl Ratio {
    /// How many times as quick the second is.
    pub(super) fn of(slow: Option<Spread>, quick: Option<Spread>) -> Option<Self> {
        let (slow, quick) = (slow?, quick?);
        Some(Self {
            of_medians: slow.median / quick.median,
            of_best: slow.least / quick.least,
        })
    }
}

impl Difference {
    pub(super) fn of(a: &[f64], b: &[f64]) -> Self {
        let all = || a.iter().zip(b).map(|(a, b)| (a - b).abs());
        Self {
            mean: all().sum::<f64>() / a.len().max(1) as f64,
            most: all().fold(0.0, f64::max),
        }
    }
}
