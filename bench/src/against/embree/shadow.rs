#![expect(unsafe_code, reason = "the functions of a C library are called")]
//! Shadow time by rays toward the sun: what a planner's sampler asks, as quickly as Embree can be asked.
//!
//! Nothing is converted on the clock: directions lie ready as each way of asking wants them, and what
//! stays the same from ray to ray is written once.

use std::sync::Arc;

use ombra_geometry::{Point3, TriangleMesh};

use super::interface::{AllValid, COHERENT, Interface, RtcRay, RtcRays};
use super::{Buffers, Contestant, Embree, NO_RAY, OpenDevice, OpenScene};
use crate::shadows::Samples;

/// Rays a call.
const LANES: usize = 16;

/// A city in the build of high quality.
pub(crate) struct ShadowScene {
    scene: OpenScene,
    interface: Arc<Interface>,
}

impl Embree {
    /// Builds over a city, with one thread.
    ///
    /// # Errors
    /// When Embree cannot.
    pub(crate) fn shadow_scene(&self, mesh: &TriangleMesh) -> anyhow::Result<ShadowScene> {
        let builder = Contestant {
            name: "embree high",
            // RTC_BUILD_QUALITY_HIGH.
            quality: 2,
            ways: &[],
            interface: self.interface.clone(),
            buffers: Arc::new(Buffers::of(mesh)),
            built: None,
        };
        let device = OpenDevice::new(&self.interface, 1)?;
        let scene = builder.commit(device.device);
        // SAFETY: the device is there.
        let error = unsafe { (self.interface.device_error)(device.device) };
        let scene = OpenScene {
            scene,
            device,
            _buffers: builder.buffers.clone(),
        };
        anyhow::ensure!(error == 0, "Embree's error {error} while it builds");
        Ok(ShadowScene {
            scene,
            interface: self.interface.clone(),
        })
    }
}

impl ShadowScene {
    /// How many seconds each place lies in shadow, by `rtcOccluded1`: minute after minute of a place.
    pub(crate) fn single(&self, places: &[Point3], samples: &Samples) -> Vec<f64> {
        let mut query: RtcRay = NO_RAY;
        let mut seconds = Vec::with_capacity(places.len());
        for place in places {
            query.origin = place.to_array();
            seconds.push(samples.sum(|directions| {
                let mut blocked = 0;
                for &direction in directions {
                    query.direction = direction;
                    query.far = f32::INFINITY;
                    // SAFETY: the scene is committed, the query of the layout that it wants.
                    unsafe {
                        (self.interface.occluded1)(
                            self.scene.scene,
                            &raw mut query,
                            std::ptr::null(),
                        );
                    }
                    // What is blocked ends at minus infinity.
                    blocked += u32::from(query.far < 0.0);
                }
                blocked
            }));
        }
        seconds
    }

    /// The same by `rtcOccluded16`, told that rays are coherent: sixteen places that come one after another
    /// toward the sun of one minute.
    pub(crate) fn packets_of_places(&self, places: &[Point3], samples: &Samples) -> Vec<f64> {
        let mut packet = no_rays();
        let mut seconds = vec![0.0; places.len()];
        for (places, seconds) in places.chunks(LANES).zip(seconds.chunks_mut(LANES)) {
            for lane in 0..LANES {
                let place = places[lane.min(places.len() - 1)].to_array();
                for (axis, x) in packet.origin.iter_mut().zip(place) {
                    axis[lane] = x;
                }
            }
            let valid = valid(places.len());
            samples.each(|directions, each| {
                let mut blocked = [0_u32; LANES];
                for direction in directions {
                    packet.direction = direction.map(|x| [x; LANES]);
                    packet.far = [f32::INFINITY; LANES];
                    self.ask(&valid, &mut packet);
                    for (blocked, far) in blocked.iter_mut().zip(packet.far) {
                        *blocked += u32::from(far < 0.0);
                    }
                }
                for (seconds, blocked) in seconds.iter_mut().zip(blocked) {
                    *seconds += each * f64::from(blocked);
                }
            });
        }
        seconds
    }

    /// The same by `rtcOccluded16`, told that rays are coherent: sixteen minutes of one place.
    pub(crate) fn packets_of_minutes(&self, places: &[Point3], samples: &Samples) -> Vec<f64> {
        let mut packet = no_rays();
        let mut seconds = Vec::with_capacity(places.len());
        for place in places {
            packet.origin = place.to_array().map(|x| [x; LANES]);
            let mut sum = 0.0;
            samples.each_packed(|directions, count, each| {
                packet.direction = *directions;
                packet.far = [f32::INFINITY; LANES];
                self.ask(&valid(count), &mut packet);
                let blocked = packet.far.iter().filter(|&&far| far < 0.0).count();
                sum += each * blocked as f64;
            });
            seconds.push(sum);
        }
        seconds
    }

    #[inline]
    fn ask(&self, valid: &AllValid, packet: &mut RtcRays<LANES>) {
        // SAFETY: the scene is committed; the packet has the layout and alignment that the function
        // wants, and so has the list of which rays count.
        unsafe {
            (self.interface.occluded16)(
                valid.0.as_ptr(),
                self.scene.scene,
                packet,
                &raw const COHERENT,
            );
        }
    }
}

/// The first `count` rays count. Those that do not keep their far end.
#[inline]
fn valid(count: usize) -> AllValid {
    AllValid(std::array::from_fn(
        |lane| if lane < count { -1 } else { 0 },
    ))
}

fn no_rays() -> RtcRays<LANES> {
    RtcRays {
        origin: [[0.0; LANES]; 3],
        near: [0.0; LANES],
        direction: [[0.0; LANES]; 3],
        time: [0.0; LANES],
        far: [0.0; LANES],
        mask: [u32::MAX; LANES],
        id: [0; LANES],
        flags: [0; LANES],
    }
}
