//! What building costs.

use serde::Serialize;

use super::engine::{Built, Engines};
use super::memory::PeakWatch;
use super::processor::Pinned;
use crate::contest::Spread;

/// Seconds after which an engine is built no further, rounds or not.
const LONG_ENOUGH: f64 = 10.0;

/// The most rounds: builds spread less than rays.
const MOST_ROUNDS: usize = 5;

/// What an engine's build costs.
#[derive(Clone, Debug, Serialize)]
pub struct BuildRecord {
    /// Which scene.
    pub scene: String,
    /// Of how many triangles.
    pub triangles: usize,
    /// Who builds, and how.
    pub engine: String,
    /// On how many threads.
    pub threads: usize,
    /// How many builds were on the clock.
    pub builds: usize,
    /// Seconds a build.
    pub seconds: Spread,
    /// Millions of triangles a second, in the median build.
    pub mtriangles: f64,
    /// How many times the triangles a second of the first engine.
    pub ratio: f64,
    /// Bytes beside the mesh, where the engine tells.
    pub own_bytes: Option<u64>,
    /// Bytes of the mesh: shared corners and indices.
    pub mesh_bytes: Option<u64>,
    /// The most that it asked for while building, as it tells itself.
    pub peak_bytes_told: Option<u64>,
    /// By how much the program grew at the worst time of a build, the result included, as the system
    /// tells; it is too little where memory of an earlier build was used again.
    pub peak_bytes_seen: Option<u64>,
}

/// Builds everybody in turns, on so many threads; the last builds stay.
///
/// # Errors
/// When somebody cannot build.
pub(super) fn compare(
    scene: &str,
    triangles: usize,
    engines: &mut Engines,
    threads: usize,
    rounds: usize,
) -> anyhow::Result<Vec<BuildRecord>> {
    let mut seconds: Vec<Vec<f64>> = vec![Vec::new(); engines.len()];
    let mut built = vec![Built::default(); engines.len()];
    let mut seen: Vec<Option<u64>> = vec![None; engines.len()];
    let pinned = (threads == 1).then(Pinned::on_one_core);
    for round in 0..rounds.clamp(1, MOST_ROUNDS) {
        for (who, engine) in engines.iter_mut().enumerate() {
            let spent: f64 = seconds[who].iter().sum();
            if round > 0 && (spent > LONG_ENOUGH || round >= engine.most_builds()) {
                continue;
            }
            let watch = PeakWatch::start();
            built[who] = engine.build(threads)?;
            seen[who] = seen[who].max(watch.peak());
            seconds[who].push(built[who].seconds);
        }
    }
    drop(pinned);
    let spreads: Vec<_> = seconds.iter().filter_map(|own| Spread::of(own)).collect();
    let record = |who: usize| BuildRecord {
        scene: scene.to_owned(),
        triangles,
        engine: engines[who].name().to_owned(),
        threads,
        builds: seconds[who].len(),
        seconds: spreads[who],
        mtriangles: triangles as f64 / spreads[who].median / 1e6,
        ratio: spreads[0].median / spreads[who].median,
        own_bytes: built[who].own_bytes,
        mesh_bytes: built[who].mesh_bytes,
        peak_bytes_told: built[who].peak_bytes,
        peak_bytes_seen: seen[who],
    };
    Ok((0..engines.len()).map(record).collect())
}
