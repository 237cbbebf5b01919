#![expect(unsafe_code, reason = "the functions of a C library are called")]
//! Many rays a call.

use ombra_geometry::{Hit, Ray};

use super::interface::{ALL_VALID, Arguments, INVALID, RtcHits, RtcRayHits, RtcRays, Scene};
use super::own_hit;

/// One of the functions for packets.
type Call<What> = unsafe extern "C" fn(*const i32, Scene, *mut What, *const Arguments);

/// The rays of a packet; where there are too few, the last one once more.
#[inline]
fn load<const N: usize>(packet: &mut RtcRays<N>, rays: &[Ray]) {
    for lane in 0..N {
        let ray = &rays[lane.min(rays.len() - 1)];
        let (origin, direction) = (ray.origin, ray.direction);
        packet.origin[0][lane] = origin.x;
        packet.origin[1][lane] = origin.y;
        packet.origin[2][lane] = origin.z;
        packet.near[lane] = ray.t_min;
        packet.direction[0][lane] = direction.x;
        packet.direction[1][lane] = direction.y;
        packet.direction[2][lane] = direction.z;
        packet.far[lane] = ray.t_max;
    }
}

fn empty<const N: usize>() -> RtcRays<N> {
    RtcRays {
        origin: [[0.0; N]; 3],
        near: [0.0; N],
        direction: [[0.0; N]; 3],
        time: [0.0; N],
        far: [0.0; N],
        mask: [u32::MAX; N],
        id: [0; N],
        flags: [0; N],
    }
}

pub(super) fn intersect<const N: usize>(
    scene: Scene,
    rays: &[Ray],
    hits: &mut [Option<Hit>],
    arguments: *const Arguments,
    call: Call<RtcRayHits<N>>,
) {
    let mut packet = RtcRayHits {
        ray: empty::<N>(),
        hit: RtcHits {
            normal: [[0.0; N]; 3],
            u: [0.0; N],
            v: [0.0; N],
            primitive: [INVALID; N],
            geometry: [INVALID; N],
            instance: [INVALID; N],
            instance_primitive: [INVALID; N],
        },
    };
    for (rays, hits) in rays.chunks(N).zip(hits.chunks_mut(N)) {
        load(&mut packet.ray, rays);
        packet.hit.geometry = [INVALID; N];
        packet.hit.instance = [INVALID; N];
        packet.hit.instance_primitive = [INVALID; N];
        // SAFETY: the scene is committed; the packet has the layout and alignment that the function
        // of this width wants, and so has the list of which rays count.
        unsafe { call(ALL_VALID.0.as_ptr(), scene, &raw mut packet, arguments) };
        let (ray, found) = (&packet.ray, &packet.hit);
        for (lane, hit) in hits.iter_mut().enumerate() {
            *hit = (found.geometry[lane] != INVALID).then(|| {
                let (u, v) = (found.u[lane], found.v[lane]);
                own_hit(ray.far[lane], u, v, found.primitive[lane])
            });
        }
    }
}

pub(super) fn occluded<const N: usize>(
    scene: Scene,
    rays: &[Ray],
    occluded: &mut [bool],
    arguments: *const Arguments,
    call: Call<RtcRays<N>>,
) {
    let mut packet = empty::<N>();
    for (rays, occluded) in rays.chunks(N).zip(occluded.chunks_mut(N)) {
        load(&mut packet, rays);
        // SAFETY: as above.
        unsafe { call(ALL_VALID.0.as_ptr(), scene, &raw mut packet, arguments) };
        for (lane, occluded) in occluded.iter_mut().enumerate() {
            // What is blocked ends at minus infinity.
            *occluded = packet.far[lane] < 0.0;
        }
    }
}
