#![expect(unsafe_code, reason = "the functions of a C library are called")]
//! Embree, by Intel: Wald et al., "Embree: A Kernel Framework for Efficient CPU Ray Tracing", TOG
//! 33(4), 2014.

mod interface;
mod library;
mod packets;
mod shadow;

use std::ffi::{CString, c_int, c_void};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicIsize, Ordering};
use std::time::Instant;

use anyhow::ensure;
use ombra_geometry::{GeometryId, Hit, InstanceId, PrimitiveId, Ray, TriangleMesh};

use self::interface::{Arguments, COHERENT, Device, INVALID, Interface, RtcHit, RtcRay, RtcRayHit};
use super::Peer;
use super::engine::{Built, Engine, Engines, Input, Way};

pub(crate) use self::shadow::ShadowScene;

/// `RTC_DEVICE_PROPERTY_VERSION`.
const VERSION: c_int = 0;
/// The first version with the layouts that are declared here, and the first that may have others.
const KNOWN: std::ops::Range<isize> = 40_400..50_000;

/// A loaded Embree.
#[derive(Clone, Debug)]
pub(crate) struct Embree {
    interface: Arc<Interface>,
    /// Such as "4.4.0".
    pub(crate) version: String,
}

impl Embree {
    /// Finds it and loads it.
    ///
    /// # Errors
    /// When it is not there, or is not a version that is known here.
    pub(crate) fn load(named: Option<&Path>) -> anyhow::Result<Self> {
        library::check_machine()?;
        let path = library::find(named)?;
        let interface = Arc::new(Interface::load(&path)?);
        let device = OpenDevice::new(&interface, 1)?;
        // SAFETY: the device is there.
        let version = unsafe { (interface.device_property)(device.device, VERSION) };
        drop(device);
        let [major, minor, patch] = [version / 10_000, version / 100 % 100, version % 100];
        let version_words = format!("{major}.{minor}.{patch}");
        ensure!(
            KNOWN.contains(&version),
            "{} is Embree {version_words}; 4.4 or a later 4 is needed",
            path.display()
        );
        Ok(Self {
            interface,
            version: version_words,
        })
    }

    /// The default build, and the one with spatial splits.
    pub(super) fn engines(&self, mesh: &Input) -> Engines {
        let buffers = Arc::new(Buffers::of(mesh));
        let engine = |name, quality, ways| -> Box<dyn Engine> {
            Box::new(Contestant {
                name,
                quality,
                ways,
                interface: self.interface.clone(),
                buffers: buffers.clone(),
                built: None,
            })
        };
        let all: &[Way] = &[Way::Single, Way::Packets8, Way::Packets16];
        let some: &[Way] = &[Way::Single, Way::Packets16];
        // RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH.
        vec![engine("embree", 1, all), engine("embree high", 2, some)]
    }
}

/// What Embree traces, in memory that it shares.
#[derive(Debug)]
struct Buffers {
    vertices: Vec<f32>,
    vertex_count: usize,
    triangles: Vec<[u32; 3]>,
}

impl Buffers {
    fn of(mesh: &TriangleMesh) -> Self {
        // Embree may read a vector of four at the last vertex.
        let vertices = mesh.positions().iter().flat_map(|p| [p.x, p.y, p.z]);
        Self {
            vertices: vertices.chain([0.0]).collect(),
            vertex_count: mesh.positions().len(),
            triangles: mesh.triangles().to_vec(),
        }
    }
}

/// Bytes that a device holds, and the most that it held.
#[derive(Debug, Default)]
struct Memory {
    now: AtomicIsize,
    peak: AtomicIsize,
}

/// Called by Embree from any of its threads.
unsafe extern "C" fn count_memory(memory: *mut c_void, bytes: isize, _after: bool) -> bool {
    // SAFETY: the memory of the device, which outlives it.
    let memory = unsafe { &*memory.cast::<Memory>() };
    let now = memory.now.fetch_add(bytes, Ordering::Relaxed) + bytes;
    memory.peak.fetch_max(now, Ordering::Relaxed);
    true
}

/// A device until it is dropped.
#[derive(Debug)]
struct OpenDevice {
    interface: Arc<Interface>,
    device: Device,
    /// At an address of its own, which the device knows.
    memory: Box<Memory>,
}

impl OpenDevice {
    fn new(interface: &Arc<Interface>, threads: usize) -> anyhow::Result<Self> {
        let wishes = format!("threads={threads},user_threads=0,set_affinity=0");
        let wishes = CString::new(wishes)?;
        let memory = Box::new(Memory::default());
        // SAFETY: a string that ends in zero, which is read before the call returns.
        let device = unsafe { (interface.new_device)(wishes.as_ptr()) };
        ensure!(!device.is_null(), "Embree gives no device");
        let address: *const Memory = &raw const *memory;
        // SAFETY: the device is there; the memory lives until after it is released.
        unsafe {
            (interface.monitor_memory)(device, count_memory, address.cast_mut().cast());
        }
        Ok(Self {
            interface: interface.clone(),
            device,
            memory,
        })
    }
}

impl Drop for OpenDevice {
    fn drop(&mut self) {
        // SAFETY: it is there, and nobody has it after this.
        unsafe { (self.interface.release_device)(self.device) };
    }
}

/// A scene that is committed, with its device.
#[derive(Debug)]
struct OpenScene {
    scene: interface::Scene,
    device: OpenDevice,
    /// The scene reads them as long as it lives.
    _buffers: Arc<Buffers>,
}

// SAFETY: Embree's scenes may be traced from any number of threads once they are committed (manual,
// "Thread Safety"), and are released from the one that drops them.
unsafe impl Send for OpenScene {}
// SAFETY: as above.
unsafe impl Sync for OpenScene {}

impl Drop for OpenScene {
    fn drop(&mut self) {
        // SAFETY: it is there, and nobody has it after this.
        unsafe { (self.device.interface.release_scene)(self.scene) };
    }
}

struct Contestant {
    name: &'static str,
    quality: c_int,
    ways: &'static [Way],
    interface: Arc<Interface>,
    buffers: Arc<Buffers>,
    built: Option<OpenScene>,
}

impl Contestant {
    fn scene(&self) -> interface::Scene {
        self.built.as_ref().expect("what is traced was built").scene
    }

    /// Makes a scene of the buffers and commits it.
    fn commit(&self, device: Device) -> interface::Scene {
        // RTC_GEOMETRY_TYPE_TRIANGLE; RTC_BUFFER_TYPE_VERTEX with RTC_FORMAT_FLOAT3 and
        // RTC_BUFFER_TYPE_INDEX with RTC_FORMAT_UINT3, in slot 0.
        const TRIANGLES: c_int = 0;
        const VERTEX: (c_int, c_int) = (1, 0x9003);
        const INDEX: (c_int, c_int) = (0, 0x5003);
        let (f, buffers, quality) = (&self.interface, &self.buffers, self.quality);
        let (vertices, count) = (buffers.vertices.as_ptr(), buffers.vertex_count);
        let (triangles, number) = (buffers.triangles.as_ptr(), buffers.triangles.len());
        // SAFETY: the handles come from the calls before; the buffers have these counts of twelve
        // bytes, and are kept as long as the scene.
        unsafe {
            let scene = (f.new_scene)(device);
            (f.set_scene_quality)(scene, quality);
            let mesh = (f.new_geometry)(device, TRIANGLES);
            (f.set_geometry_quality)(mesh, quality);
            (f.share_buffer)(mesh, VERTEX.0, 0, VERTEX.1, vertices.cast(), 0, 12, count);
            (f.share_buffer)(mesh, INDEX.0, 0, INDEX.1, triangles.cast(), 0, 12, number);
            (f.commit_geometry)(mesh);
            (f.attach_geometry)(scene, mesh);
            (f.release_geometry)(mesh);
            (f.commit_scene)(scene);
            scene
        }
    }
}

impl Engine for Contestant {
    fn name(&self) -> &str {
        self.name
    }

    fn peer(&self) -> Option<Peer> {
        Some(Peer::Embree)
    }

    fn ways(&self) -> &'static [Way] {
        self.ways
    }

    fn build(&mut self, threads: usize) -> anyhow::Result<Built> {
        self.built = None;
        let device = OpenDevice::new(&self.interface, threads)?;
        let begin = Instant::now();
        let scene = self.commit(device.device);
        let seconds = begin.elapsed().as_secs_f64();
        // SAFETY: the device is there.
        let error = unsafe { (self.interface.device_error)(device.device) };
        let bytes = |count: &AtomicIsize| u64::try_from(count.load(Ordering::Relaxed)).ok();
        let (own_bytes, peak_bytes) = (bytes(&device.memory.now), bytes(&device.memory.peak));
        self.built = Some(OpenScene {
            scene,
            device,
            _buffers: self.buffers.clone(),
        });
        ensure!(error == 0, "Embree's error {error} while it builds");
        let mesh = size_of_val(&*self.buffers.vertices) + size_of_val(&*self.buffers.triangles);
        Ok(Built {
            seconds,
            own_bytes,
            mesh_bytes: Some(mesh as u64),
            peak_bytes,
        })
    }

    fn intersect(&self, way: Way, rays: &[Ray], coherent: bool, hits: &mut [Option<Hit>]) {
        let (scene, arguments) = (self.scene(), arguments(coherent));
        match way {
            Way::Packets8 => {
                packets::intersect(scene, rays, hits, arguments, self.interface.intersect8);
            }
            Way::Packets16 => {
                packets::intersect(scene, rays, hits, arguments, self.interface.intersect16);
            }
            Way::Single | Way::Many => {
                let mut query = RtcRayHit {
                    ray: NO_RAY,
                    hit: NO_HIT,
                };
                for (ray, hit) in rays.iter().zip(hits) {
                    ask(&mut query.ray, ray);
                    query.hit.geometry = INVALID;
                    query.hit.instance = INVALID;
                    query.hit.instance_primitive = INVALID;
                    // SAFETY: the scene is committed, the query of the layout that it wants.
                    unsafe { (self.interface.intersect1)(scene, &raw mut query, arguments) };
                    let (t, found) = (query.ray.far, &query.hit);
                    *hit = (found.geometry != INVALID)
                        .then(|| own_hit(t, found.u, found.v, found.primitive));
                }
            }
        }
    }

    fn occluded(&self, way: Way, rays: &[Ray], occluded: &mut [bool]) {
        let (scene, arguments) = (self.scene(), arguments(false));
        match way {
            Way::Packets8 => {
                packets::occluded(scene, rays, occluded, arguments, self.interface.occluded8);
            }
            Way::Packets16 => {
                packets::occluded(scene, rays, occluded, arguments, self.interface.occluded16);
            }
            Way::Single | Way::Many => {
                let mut query = NO_RAY;
                for (ray, occluded) in rays.iter().zip(occluded) {
                    ask(&mut query, ray);
                    // SAFETY: as above.
                    unsafe { (self.interface.occluded1)(scene, &raw mut query, arguments) };
                    // What is blocked ends at minus infinity.
                    *occluded = query.far < 0.0;
                }
            }
        }
    }
}

/// Nothing says that rays are incoherent, as is the default.
fn arguments(coherent: bool) -> *const Arguments {
    if coherent {
        &raw const COHERENT
    } else {
        std::ptr::null()
    }
}

const NO_HIT: RtcHit = RtcHit {
    normal: [0.0; 3],
    u: 0.0,
    v: 0.0,
    primitive: INVALID,
    geometry: INVALID,
    instance: INVALID,
    instance_primitive: INVALID,
};

const NO_RAY: RtcRay = RtcRay {
    origin: [0.0; 3],
    near: 0.0,
    direction: [0.0; 3],
    time: 0.0,
    far: 0.0,
    mask: u32::MAX,
    id: 0,
    flags: 0,
};

/// Writes what differs from ray to ray.
#[inline]
fn ask(query: &mut RtcRay, ray: &Ray) {
    query.origin = [ray.origin.x, ray.origin.y, ray.origin.z];
    query.near = ray.t_min;
    query.direction = [ray.direction.x, ray.direction.y, ray.direction.z];
    query.far = ray.t_max;
}

#[inline]
fn own_hit(t: f32, u: f32, v: f32, primitive: u32) -> Hit {
    Hit {
        t,
        u,
        v,
        primitive: PrimitiveId(primitive),
        geometry: GeometryId(0),
        instance: InstanceId(0),
    }
}
