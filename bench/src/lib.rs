//! What ombra costs, measured.
//!
//! A bench is a job that several contestants do in one process. Their answers are compared first,
//! bit for bit, so that a bench is a test as well; then their times are taken in turns, so that
//! whatever else the machine does falls on all of them alike.
//!
//! [`against`] holds ombra against other tracers, [`shadows`] its exact shadow time against one ray a
//! minute; the rest compares its own parts.
//!
//! To add a contestant, write one function that does the job and name it in the list of its bench.
//! To add a bench, write a module with a [`Bench`] and name it in [`BENCHES`].

pub mod against;
pub mod contest;
pub mod load;
pub mod machine;
pub mod meshes;
pub mod place;
pub mod random;
pub mod record;
pub mod records;
pub mod scenes;
pub mod shadows;
pub mod whitted;

use ombra_accel::StructureKind;

use record::Record;

/// A bench by name.
#[derive(Clone, Copy, Debug)]
pub struct Bench {
    /// The name that a person types.
    pub name: &'static str,
    /// What it compares, in one line.
    pub line: &'static str,
    /// Compares the answers of its contestants, then takes their times.
    pub run: fn(&Settings) -> anyhow::Result<Vec<Record>>,
}

/// Every bench.
pub const BENCHES: &[Bench] = &[whitted::BENCH, load::BENCH];

/// How much a bench does.
#[derive(Clone, Debug)]
pub struct Settings {
    /// How many times each contestant runs on the clock. 0 compares the answers only.
    pub rounds: usize,
    /// With how many threads, one after the other; 0 is all that the machine has.
    pub threads: Vec<usize>,
    /// How many pixels wide and high pictures are.
    pub pixels: u32,
    /// How fine generated geometry is: hills have twice the square of this many triangles, a city
    /// has twice as many houses a side.
    pub detail: u32,
    /// The structure that rays are traced against.
    pub accel: StructureKind,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rounds: 9,
            threads: vec![1, 0],
            pixels: 256,
            detail: 200,
            accel: StructureKind::default(),
        }
    }
}

impl Settings {
    /// So small that it is done at once, and no clock: for tests.
    #[must_use]
    pub fn tiny() -> Self {
        Self {
            rounds: 0,
            threads: vec![1, 3],
            pixels: 24,
            detail: 8,
            ..Self::default()
        }
    }
}
