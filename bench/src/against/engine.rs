//! What all tracers are measured through.

use std::fmt;
use std::sync::Arc;

use ombra_geometry::{Hit, Ray, TriangleMesh};

use super::Peer;

/// A tracer with a structure over the triangles of one mesh.
pub(super) trait Engine: Send + Sync {
    /// For people and records: the tracer, and how it builds.
    fn name(&self) -> &str;

    /// Whose it is; nothing for ombra's own.
    fn peer(&self) -> Option<Peer>;

    /// How it can be asked.
    fn ways(&self) -> &'static [Way];

    /// Builds its structure, in place of the one before, on so many threads. What it makes of the
    /// mesh first, such as vertices in an order of its own, is not on the clock.
    ///
    /// # Errors
    /// When it cannot.
    fn build(&mut self, threads: usize) -> anyhow::Result<Built>;

    /// How often it may be built at a number of threads.
    fn most_builds(&self) -> usize {
        usize::MAX
    }

    /// The closest hit of each ray. `coherent` says that neighbours go the same way, to those who
    /// want to be told.
    fn intersect(&self, way: Way, rays: &[Ray], coherent: bool, hits: &mut [Option<Hit>]);

    /// Whether there is any hit.
    fn occluded(&self, way: Way, rays: &[Ray], occluded: &mut [bool]);
}

/// Makes the engines of one tracer over a mesh.
pub(super) type Engines = Vec<Box<dyn Engine>>;

/// The input of all engines.
pub(super) type Input = Arc<TriangleMesh>;

/// How a tracer is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// One ray a call.
    Single,
    /// Eight rays a call.
    Packets8,
    /// Sixteen rays a call.
    Packets16,
    /// As many rays a call as a thread takes at a time.
    Many,
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Single => "single",
            Self::Packets8 => "packets of 8",
            Self::Packets16 => "packets of 16",
            Self::Many => "many",
        })
    }
}

/// What came of a build.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Built {
    /// On the clock.
    pub(super) seconds: f64,
    /// Bytes beside the mesh, where known: nodes, and triangles that were copied.
    pub(super) own_bytes: Option<u64>,
    /// Bytes of the mesh as it is held for tracing, where known.
    pub(super) mesh_bytes: Option<u64>,
    /// The most that it asked for while it was built, where it tells.
    pub(super) peak_bytes: Option<u64>,
}
