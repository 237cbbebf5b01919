//! A structure out of a file: how much less is that than to build it?
//!
//! The answer of a contestant is the structure that it makes, ready to be traced and known to be
//! whole; two are equal if they say the same to some rays.
#![expect(
    unsafe_code,
    reason = "one contestant maps a file that nobody else knows"
)]

use std::fmt;

use anyhow::Context as _;
use ombra_accel::{Accel, Mesh, StructureKind, Traversable, TriangleTree};
use ombra_geometry::{Aabb, Hit, Ray, Vector3};
use ombra_pipeline::Cpu;

use crate::contest::{Contestant, Spread, compare, times};
use crate::random::Random;
use crate::record::Record;
use crate::{Bench, Settings, meshes};

/// Loading over building.
pub const BENCH: Bench = Bench {
    name: "load",
    line: "each structure that can be a file, over a city: loaded, or mapped, over built",
    run,
};

/// Those that can be a file.
const KINDS: [StructureKind; 3] = [
    StructureKind::Bvh8,
    StructureKind::Bvh8Fast,
    StructureKind::Bvh8High,
];

/// How many rays structures are compared by.
const RAYS: usize = 4096;

/// What a contestant makes.
struct Made(Box<dyn Traversable>);

impl Made {
    fn hits(&self) -> Vec<Option<Hit>> {
        let rays = rays(&self.0.bounds());
        let mut hits = vec![None; rays.len()];
        self.0.intersect_many(&rays, &mut hits);
        hits
    }
}

impl PartialEq for Made {
    fn eq(&self, other: &Self) -> bool {
        self.hits() == other.hits()
    }
}

impl fmt::Debug for Made {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Made").field(&self.0.bounds()).finish()
    }
}

/// From anywhere in a box to anywhere in it.
fn rays(bounds: &Aabb) -> Vec<Ray> {
    let mut random = Random::new(3);
    let mut point = || {
        let size = bounds.max - bounds.min;
        let [x, y, z] = size.to_array().map(|size| size * random.unit());
        bounds.min + Vector3::new(x, y, z)
    };
    let ray = |_| {
        let (from, to) = (point(), point());
        Ray::new(from, to - from)
    };
    (0..RAYS).map(ray).collect()
}

fn run(settings: &Settings) -> anyhow::Result<Vec<Record>> {
    let mesh = Mesh::new(meshes::city(2 * settings.detail.max(1))?);
    let folder = tempfile::tempdir().context("a folder for the file")?;
    let mut records = Vec::new();
    for kind in KINDS {
        let path = folder.path().join(kind.name());
        Accel::build(mesh.clone(), kind).save(&path)?;
        let contestants = vec![
            Contestant::new("build", || Made(Box::new(Accel::build(mesh.clone(), kind)))),
            Contestant::new("load", || {
                let tree = TriangleTree::load(&path).expect("what was saved is whole");
                Made(Box::new(tree))
            }),
            Contestant::new("map", || {
                // SAFETY: the file is in a folder of its own.
                let tree = unsafe { TriangleTree::map(&path) };
                Made(Box::new(tree.expect("what was saved is whole")))
            }),
        ];
        for &threads in &settings.threads {
            let cpu = Cpu::with_threads(threads)?;
            cpu.install(|| compare(&contestants))?;
            let times = cpu.install(|| times(&contestants, settings.rounds));
            let least = |seconds: &[f64]| Spread::of(seconds).map(|spread| spread.least);
            for (contestant, seconds) in contestants.iter().zip(&times) {
                let pair = least(seconds).zip(least(&times[0]));
                records.push(Record {
                    ratio_of_least: pair.map(|(own, base)| own / base),
                    bench: BENCH.name,
                    job: format!("city, {kind}"),
                    contestant: contestant.name,
                    threads: cpu.threads(),
                    rays: RAYS as u64,
                    rounds: settings.rounds,
                    seconds: Spread::of(seconds),
                    ratio: Spread::of_ratios(seconds, &times[0]),
                });
            }
        }
    }
    Ok(records)
}
