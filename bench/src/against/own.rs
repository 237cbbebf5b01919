//! ombra itself.

use std::time::Instant;

use ombra_accel::{Accel, Mesh, StructureKind, Traversable};
use ombra_geometry::{Hit, Ray};
use rayon::ThreadPoolBuilder;

use super::Peer;
use super::engine::{Built, Engine, Engines, Input, Way};

/// One engine a structure.
pub(super) fn engines(mesh: &Input, kinds: &[StructureKind]) -> Engines {
    let engine = |kind: &StructureKind| -> Box<dyn Engine> {
        Box::new(Own {
            name: format!("ombra {kind}"),
            kind: *kind,
            mesh: mesh.clone(),
            accel: None,
        })
    };
    kinds.iter().map(engine).collect()
}

struct Own {
    name: String,
    kind: StructureKind,
    mesh: Input,
    accel: Option<Accel<Mesh>>,
}

impl Own {
    fn accel(&self) -> &Accel<Mesh> {
        self.accel.as_ref().expect("what is traced was built")
    }
}

impl Engine for Own {
    fn name(&self) -> &str {
        &self.name
    }

    fn peer(&self) -> Option<Peer> {
        None
    }

    fn ways(&self) -> &'static [Way] {
        &[Way::Single, Way::Many]
    }

    fn build(&mut self, threads: usize) -> anyhow::Result<Built> {
        self.accel = None;
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let mesh = Mesh::new(self.mesh.clone());
        let (accel, seconds) = pool.install(|| {
            let begin = Instant::now();
            let accel = Accel::build(mesh, self.kind);
            (accel, begin.elapsed().as_secs_f64())
        });
        let own_bytes = accel.structure_bytes() as u64;
        let all = accel.bytes() as u64;
        self.accel = Some(accel);
        Ok(Built {
            seconds,
            own_bytes: Some(own_bytes),
            mesh_bytes: Some(all - own_bytes),
            peak_bytes: None,
        })
    }

    fn intersect(&self, way: Way, rays: &[Ray], _coherent: bool, hits: &mut [Option<Hit>]) {
        let accel = self.accel();
        if way == Way::Many {
            return accel.intersect_many(rays, hits);
        }
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = accel.intersect(ray);
        }
    }

    fn occluded(&self, way: Way, rays: &[Ray], occluded: &mut [bool]) {
        let accel = self.accel();
        if way == Way::Many {
            return accel.occluded_many(rays, occluded);
        }
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = accel.occluded(ray);
        }
    }
}
