//! The comparative study of structures and of the ways to walk them.
//!
//! Every structure of [`StructureKind::ALL`](ombra::accel::StructureKind::ALL) gets the same rays of
//! four kinds in the same scenes. Their answers are compared first, bit for bit: times of different
//! answers mean nothing. What a ray costs is counted then, and last comes the clock, in rounds in
//! which all structures take turns, so that whatever else the machine does falls on all alike.
//!
//! [`study`] measures; [`Study`] holds the numbers and says them as a [table](Study::table) or as a
//! [page](Study::page) with plots.
//!
//! ```
//! use ombra_study::{Settings, Subject, Watch, study};
//!
//! let settings = Settings { size: [8, 8], rounds: 1, threads: vec![1], ..Settings::default() };
//! let subject = Subject::load("cornell", &settings)?;
//! let found = study(vec![subject], &settings, &Watch::default())?;
//! assert_eq!(found.scenes[0].structures.len(), settings.kinds.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod html;

mod asked;
mod contest;
mod family;
mod machine;
mod numbers;
mod page;
mod plot;
mod rays;
mod report;
mod run;
mod santos;
mod scenes;
mod settings;
mod spread;
mod subject;
mod table;
mod watch;

pub use machine::Machine;
pub use numbers::grouped;
pub use rays::Workload;
pub use report::{Build, Cost, Measured, RaySet, SceneReport, Speed, StructureReport, Study};
pub use run::{StudyError, study};
pub use santos::{Pair, Santos, Verdict};
pub use settings::{LARGEST_SIDE, Settings};
pub use spread::{Distribution, Spread};
pub use subject::{DEFAULT_SCENES, Subject};
pub use watch::{Progress, Watch};
