#![expect(
    unsafe_code,
    reason = "the wrapped C++ tree may be read from several threads, which its wrapper does not say"
)]
//! tinybvh by its Rust wrapper: BVH8_CPU over a build with spatial splits. The wrapper asks for the
//! closest hit only, so shadow rays cost here what they need not in C++.

use std::time::Instant;

use ombra_geometry::{GeometryId, Hit, InstanceId, PrimitiveId, Ray};
use tinybvh_rs::{INFINITE, Intersector, bvh, bvh8_cpu, mbvh};

use super::Peer;
use super::engine::{Built, Engine, Engines, Input, Way};

/// The one that the wrapper can trace on a processor.
pub(super) fn engines(mesh: &Input) -> Engines {
    let (mesh, tree) = (mesh.clone(), None);
    vec![Box::new(Tinybvh { mesh, tree })]
}

struct Tree(bvh8_cpu::BVH);

// SAFETY: a tree that is built is only read; tracing writes to the ray alone.
unsafe impl Send for Tree {}
// SAFETY: as above.
unsafe impl Sync for Tree {}

struct Tinybvh {
    mesh: Input,
    tree: Option<Tree>,
}

impl Tinybvh {
    #[inline]
    fn ask(&self, ray: &Ray) -> Option<tinybvh_rs::Intersection> {
        let tree = &self.tree.as_ref()?.0;
        let d = [ray.direction.x, ray.direction.y, ray.direction.z];
        let mut query = tinybvh_rs::Ray {
            origin: [ray.origin.x, ray.origin.y, ray.origin.z],
            dir: d,
            r_d: d.map(|x| 1.0 / x),
            ..Default::default()
        };
        let far = ray.t_max.min(INFINITE);
        query.hit.t = far;
        tree.intersect(&mut query);
        (query.hit.t < far).then_some(query.hit)
    }
}

impl Engine for Tinybvh {
    fn name(&self) -> &str {
        "tinybvh BVH8_CPU high"
    }

    fn peer(&self) -> Option<Peer> {
        Some(Peer::Tinybvh)
    }

    fn ways(&self) -> &'static [Way] {
        &[Way::Single]
    }

    /// What it built from is never freed, see [`build`](Self::build).
    fn most_builds(&self) -> usize {
        1
    }

    /// On one thread, whatever `threads` says.
    fn build(&mut self, _threads: usize) -> anyhow::Result<Built> {
        self.tree = None;
        let mesh = &self.mesh;
        let corners = (0..mesh.triangles().len()).flat_map(|i| mesh.corners(i));
        let vertices: Vec<[f32; 4]> = corners.map(|p| [p.x, p.y, p.z, 0.0]).collect();
        let begin = Instant::now();
        // The wide tree keeps pointers into what it was made of, whatever the wrapper promises.
        let vertices: &'static [[f32; 4]] = vertices.leak();
        let mut binary = bvh::BVH::new_hq(vertices.into()).map_err(refused)?;
        binary.split_leaves(4);
        binary.compact();
        let binary: &'static bvh::BVH<'_> = Box::leak(Box::new(binary));
        let wide: &'static mbvh::BVH<'_> = Box::leak(Box::new(mbvh::BVH::new(binary)));
        self.tree = Some(Tree(bvh8_cpu::BVH::new(wide).map_err(refused)?));
        Ok(Built {
            seconds: begin.elapsed().as_secs_f64(),
            ..Built::default()
        })
    }

    fn intersect(&self, _way: Way, rays: &[Ray], _coherent: bool, hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.ask(ray).map(|found| Hit {
                t: found.t,
                u: found.u,
                v: found.v,
                primitive: PrimitiveId(found.prim),
                geometry: GeometryId(0),
                instance: InstanceId(0),
            });
        }
    }

    fn occluded(&self, _way: Way, rays: &[Ray], occluded: &mut [bool]) {
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = self.ask(ray).is_some();
        }
    }
}

/// The wrapper's errors are none of the standard's.
fn refused(error: tinybvh_rs::Error) -> anyhow::Error {
    anyhow::anyhow!("tinybvh: {error}")
}
