//! ombra against other tracers: rays a second, builds, bytes, and who is right.
//!
//! All of them trace the same rays in one process. First everybody's answers are compared with the
//! first one's, and where anybody differs every triangle is tested in double precision to see who is
//! right. Then the times are taken, in turns.
//!
//! A peer is one file that implements `Engine`, and a variant of [`Peer`].

mod answers;
mod build;
pub(crate) mod embree;
mod engine;
pub(crate) mod float_mode;
mod judge;
mod memory;
#[cfg(feature = "obvhs")]
mod obvhs;
mod own;
pub(crate) mod processor;
mod rays;
mod report;
mod speed;
mod tables;
#[cfg(all(feature = "tinybvh", target_feature = "avx2"))]
mod tinybvh;
mod trace;

use std::path::PathBuf;

use anyhow::{Context, bail};
use ombra_accel::StructureKind;

use self::engine::{Engines, Input};
use self::trace::{Contestant, Places, Threads};
use crate::machine::Machine;
use crate::meshes::{self, Found, MeshScene, Size};

pub use self::answers::AnswerRecord;
pub use self::build::BuildRecord;
pub use self::report::{PeerRecord, Report};
pub use self::speed::SpeedRecord;

/// Whom ombra can be held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Peer {
    /// Itself: no other tracer, only structures against the first of them.
    Ombra,
    /// Embree 4, from its shared library.
    Embree,
    /// tinybvh, if built in.
    Tinybvh,
    /// obvhs, if built in.
    Obvhs,
}

impl Peer {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Ombra, Self::Embree, Self::Tinybvh, Self::Obvhs];

    /// The name that a person types.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ombra => "ombra",
            Self::Embree => "embree",
            Self::Tinybvh => "tinybvh",
            Self::Obvhs => "obvhs",
        }
    }

    /// What it is, in one line.
    #[must_use]
    pub const fn line(self) -> &'static str {
        match self {
            Self::Ombra => "no other tracer: its structures among themselves",
            Self::Embree => "Embree 4.4, from its shared library",
            Self::Tinybvh => "tinybvh's BVH8_CPU; needs a build with the feature tinybvh",
            Self::Obvhs => "obvhs' CWBVH and BVH2; needs a build with the feature obvhs",
        }
    }
}

/// What to measure, and how much.
#[derive(Clone, Debug)]
pub struct Options {
    /// Whom.
    pub peers: Vec<Peer>,
    /// Which structures of ombra take part.
    pub accels: Vec<StructureKind>,
    /// Built-in scenes of this bench, and files.
    pub scenes: Vec<String>,
    /// How many pixels wide and high the picture of the primary rays is.
    pub side: u32,
    /// How many times each contestant runs on the clock. 0 compares answers only.
    pub rounds: usize,
    /// With how many threads, one after the other; 0 is all that the machine has.
    pub threads: Vec<usize>,
    /// How much of generated scenes is made.
    pub size: Size,
    /// Embree's library or its folder, if it is not where it is looked for.
    pub embree: Option<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            peers: vec![Peer::Embree],
            accels: vec![StructureKind::default()],
            scenes: meshes::BUILT_IN.map(str::to_owned).to_vec(),
            side: 1024,
            rounds: 9,
            threads: vec![1, 0],
            size: Size::Full,
            embree: None,
        }
    }
}

impl Options {
    /// So small that a test does not wait for it.
    #[must_use]
    pub fn smoke() -> Self {
        Self {
            scenes: vec!["interior".to_owned(), "city".to_owned()],
            side: 32,
            rounds: 1,
            size: Size::Tiny,
            ..Self::default()
        }
    }
}

/// The peers that are there, ready to be given meshes.
struct Peers {
    embree: Option<embree::Embree>,
    records: Vec<PeerRecord>,
    chosen: Vec<Peer>,
}

impl Peers {
    fn load(options: &Options) -> anyhow::Result<Self> {
        let mut peers = Self {
            embree: None,
            records: Vec::new(),
            chosen: options.peers.clone(),
        };
        for &peer in &options.peers {
            let version = match peer {
                Peer::Ombra => continue,
                Peer::Embree => {
                    let embree = embree::Embree::load(options.embree.as_deref())?;
                    let version = embree.version.clone();
                    peers.embree = Some(embree);
                    version
                }
                Peer::Tinybvh => tinybvh_version()?.to_owned(),
                Peer::Obvhs => obvhs_version()?.to_owned(),
            };
            let name = peer.name();
            peers.records.push(PeerRecord { name, version });
        }
        Ok(peers)
    }

    /// All engines over a mesh: Embree first, if it is there, since everybody is measured by the
    /// first, then other peers, then ombra.
    fn engines(&self, mesh: &Input, options: &Options) -> Engines {
        let mut engines = Engines::new();
        if let Some(embree) = &self.embree {
            engines.extend(embree.engines(mesh));
        }
        for peer in &self.chosen {
            match peer {
                Peer::Ombra | Peer::Embree => {}
                #[cfg(all(feature = "tinybvh", target_feature = "avx2"))]
                Peer::Tinybvh => engines.extend(tinybvh::engines(mesh)),
                #[cfg(feature = "obvhs")]
                Peer::Obvhs => engines.extend(obvhs::engines(mesh)),
                #[allow(
                    unreachable_patterns,
                    reason = "who is not built in was refused before"
                )]
                Peer::Tinybvh | Peer::Obvhs => {}
            }
        }
        engines.extend(own::engines(mesh, &options.accels));
        engines
    }
}

fn tinybvh_version() -> anyhow::Result<&'static str> {
    if !cfg!(feature = "tinybvh") {
        bail!("tinybvh is not built in: build with `--features tinybvh`");
    }
    if !cfg!(target_feature = "avx2") {
        bail!(
            "tinybvh-rs answers rays only where the whole program is compiled for AVX2: build with \
             RUSTFLAGS=\"-C target-feature=+avx2,+fma\""
        );
    }
    Ok("0.1.0-beta.3 by tinybvh-rs")
}

fn obvhs_version() -> anyhow::Result<&'static str> {
    if !cfg!(feature = "obvhs") {
        bail!("obvhs is not built in: build with `--features obvhs`");
    }
    Ok("0.4.0")
}

/// Measures. `talk` hears how far it is, a line at a time.
///
/// # Errors
/// When a peer is not there, a scene cannot be loaded, or a build fails.
pub fn run(options: &Options, talk: &mut dyn FnMut(&str)) -> anyhow::Result<Report> {
    let peers = Peers::load(options)?;
    let mut report = Report {
        machine: Machine::this(),
        peers: peers.records.clone(),
        side: options.side,
        thread_clock: processor::HAS_THREAD_CLOCK,
        records: Vec::new(),
        builds: Vec::new(),
        answers: Vec::new(),
        skipped: Vec::new(),
    };
    for name in &options.scenes {
        match meshes::load(name, options.size)? {
            Found::Skipped(line) => {
                talk(&line);
                report.skipped.push(line);
            }
            Found::Scene(scene) => measure(&scene, &peers, options, &mut report, talk)
                .with_context(|| format!("scene {name}"))?,
        }
    }
    Ok(report)
}

/// All of one scene.
fn measure(
    scene: &MeshScene,
    peers: &Peers,
    options: &Options,
    report: &mut Report,
    talk: &mut dyn FnMut(&str),
) -> anyhow::Result<()> {
    let triangles = scene.mesh.triangles().len();
    talk(&format!("{}: {triangles} triangles", scene.name));
    let workloads = rays::make(scene, options.side);
    let mut engines = peers.engines(&scene.mesh, options);
    for &count in &options.threads {
        let threads = Threads::new(count)?.count;
        talk(&format!("  builds, threads: {threads}"));
        let (name, rounds) = (&scene.name, options.rounds);
        let builds = build::compare(name, triangles, &mut engines, threads, rounds)?;
        report.builds.extend(builds);
    }
    let ways = engines.iter().flat_map(|engine| {
        let engine: &dyn engine::Engine = &**engine;
        engine
            .ways()
            .iter()
            .map(move |&way| Contestant { engine, way })
    });
    let contestants: Vec<_> = ways.collect();
    let most = workloads.iter().map(|work| work.rays.len()).max();
    let mut places = Places::new(most.unwrap_or(0));
    let all_threads = Threads::new(0)?;
    for work in &workloads {
        talk(&format!("  {}: {} rays", work.name, work.rays.len()));
        report.answers.extend(answers::compare(
            &scene.name,
            &scene.mesh,
            work,
            &contestants,
            &all_threads,
            &mut places,
        ));
        for &count in &options.threads {
            let threads = Threads::new(count)?;
            let times = threads.times(&contestants, work, options.rounds, &mut places);
            report.records.extend(speed::records(
                &scene.name,
                triangles,
                work,
                &contestants,
                threads.count,
                &times,
            ));
        }
    }
    Ok(())
}
