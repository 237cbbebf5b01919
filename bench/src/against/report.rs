//! What was found, for programs. [`Report::tables`] is for people.

use serde::Serialize;

use super::{AnswerRecord, BuildRecord, SpeedRecord};
use crate::machine::Machine;

/// A tracer that took part.
#[derive(Clone, Debug, Serialize)]
pub struct PeerRecord {
    /// Its name.
    pub name: &'static str,
    /// Its version.
    pub version: String,
}

/// All that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// On what.
    pub machine: Machine,
    /// Against whom.
    pub peers: Vec<PeerRecord>,
    /// How many pixels wide and high the picture of the primary rays is.
    pub side: u32,
    /// Whether seconds on one thread are those that the thread ran; otherwise the wall's.
    pub thread_clock: bool,
    /// Speeds.
    pub records: Vec<SpeedRecord>,
    /// Builds, and bytes.
    pub builds: Vec<BuildRecord>,
    /// Who is right.
    pub answers: Vec<AnswerRecord>,
    /// Scenes that were left out, and why.
    pub skipped: Vec<String>,
}
