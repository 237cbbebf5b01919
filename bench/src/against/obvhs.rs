//! obvhs, in Rust: PLOC and re-insertion, walked as eight-wide compressed nodes or as binary ones.

use std::time::{Duration, Instant};

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray as ObvhsRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use ombra_geometry::{GeometryId, Hit, InstanceId, Point3, PrimitiveId, Ray, Vector3};
use rayon::ThreadPoolBuilder;

use super::Peer;
use super::engine::{Built, Engine, Engines, Input, Way};

/// The presets that the crate's author compares with.
pub(super) fn engines(mesh: &Input) -> Engines {
    let engine = |name, wide, parameters: fn() -> BvhBuildParams| -> Box<dyn Engine> {
        Box::new(Obvhs {
            name,
            wide,
            parameters,
            mesh: mesh.clone(),
            nodes: Nodes::None,
            triangles: Vec::new(),
            primitives: Vec::new(),
        })
    };
    vec![
        engine("obvhs CWBVH medium", true, BvhBuildParams::medium_build),
        engine(
            "obvhs CWBVH very slow",
            true,
            BvhBuildParams::very_slow_build,
        ),
        engine(
            "obvhs BVH2 very slow",
            false,
            BvhBuildParams::very_slow_build,
        ),
    ]
}

enum Nodes {
    None,
    Wide(CwBvh),
    Binary(Bvh2),
}

struct Obvhs {
    name: &'static str,
    wide: bool,
    parameters: fn() -> BvhBuildParams,
    mesh: Input,
    nodes: Nodes,
    /// In the order of the leaves, as the crate's examples have them.
    triangles: Vec<RtTriangle>,
    primitives: Vec<u32>,
}

fn point(p: Point3) -> Vec3A {
    Vec3A::new(p.x, p.y, p.z)
}

#[inline]
fn query(ray: &Ray) -> ObvhsRay {
    let Vector3 { x, y, z } = ray.direction;
    ObvhsRay::new(point(ray.origin), Vec3A::new(x, y, z), ray.t_min, ray.t_max)
}

impl Engine for Obvhs {
    fn name(&self) -> &str {
        self.name
    }

    fn peer(&self) -> Option<Peer> {
        Some(Peer::Obvhs)
    }

    fn ways(&self) -> &'static [Way] {
        &[Way::Single]
    }

    fn build(&mut self, threads: usize) -> anyhow::Result<Built> {
        self.nodes = Nodes::None;
        let count = self.mesh.triangles().len();
        let corners = (0..count).map(|i| self.mesh.corners(i).map(point));
        let input: Vec<Triangle> = corners
            .map(|[v0, v1, v2]| Triangle { v0, v1, v2 })
            .collect();
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let (wide, parameters) = (self.wide, (self.parameters)());
        let begin = Instant::now();
        let mut core = Duration::ZERO;
        let (nodes, primitives, node_bytes) = pool.install(|| {
            if wide {
                let built = build_cwbvh_from_tris(&input, parameters, &mut core);
                let bytes = size_of_val(&*built.nodes);
                let primitives = built.primitive_indices.clone();
                (Nodes::Wide(built), primitives, bytes)
            } else {
                let built = build_bvh2_from_tris(&input, parameters, &mut core);
                let bytes = size_of_val(&*built.nodes);
                let primitives = built.primitive_indices.clone();
                (Nodes::Binary(built), primitives, bytes)
            }
        });
        let ordered = primitives.iter().map(|&i| (&input[i as usize]).into());
        self.triangles = ordered.collect();
        let seconds = begin.elapsed().as_secs_f64();
        let own = node_bytes + size_of_val(&*self.triangles) + size_of_val(&*primitives);
        (self.nodes, self.primitives) = (nodes, primitives);
        Ok(Built {
            seconds,
            own_bytes: Some(own as u64),
            // The triangles are copies; the mesh is not needed.
            mesh_bytes: Some(0),
            peak_bytes: None,
        })
    }

    fn intersect(&self, _way: Way, rays: &[Ray], _coherent: bool, hits: &mut [Option<Hit>]) {
        let test = |ray: &ObvhsRay, i: usize| self.triangles[i].intersect(ray);
        for (ray, hit) in rays.iter().zip(hits) {
            let mut found = RayHit::none();
            let is_hit = match &self.nodes {
                Nodes::Wide(nodes) => nodes.ray_traverse(query(ray), &mut found, test),
                Nodes::Binary(nodes) => nodes.ray_traverse(query(ray), &mut found, test),
                Nodes::None => false,
            };
            *hit = is_hit.then(|| Hit {
                t: found.t,
                // It does not say where on the triangle.
                u: 0.0,
                v: 0.0,
                primitive: PrimitiveId(self.primitives[found.primitive_id as usize]),
                geometry: GeometryId(0),
                instance: InstanceId(0),
            });
        }
    }

    fn occluded(&self, _way: Way, rays: &[Ray], occluded: &mut [bool]) {
        let test = |ray: &ObvhsRay, i: usize| self.triangles[i].intersect(ray);
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = match &self.nodes {
                Nodes::Wide(nodes) => !nodes.ray_traverse_miss(query(ray), test),
                Nodes::Binary(nodes) => !nodes.ray_traverse_miss(query(ray), test),
                Nodes::None => false,
            };
        }
    }
}
