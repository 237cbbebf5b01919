#![expect(
    unsafe_code,
    reason = "a C library is loaded while the program runs, so its interface is declared by hand"
)]
//! What of Embree's C interface is called here, as its manual and headers of 4.4 say.

use std::ffi::{c_char, c_int, c_uint, c_void};
use std::path::Path;

use anyhow::Context;
use libloading::Library;

/// `RTCRay`.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcRay {
    pub(super) origin: [f32; 3],
    pub(super) near: f32,
    pub(super) direction: [f32; 3],
    pub(super) time: f32,
    pub(super) far: f32,
    pub(super) mask: u32,
    pub(super) id: u32,
    pub(super) flags: u32,
}

/// `RTCHit`, with one level of instances. Since 4.4 it also says which one of an array of instances.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcHit {
    pub(super) normal: [f32; 3],
    pub(super) u: f32,
    pub(super) v: f32,
    pub(super) primitive: u32,
    pub(super) geometry: u32,
    pub(super) instance: u32,
    pub(super) instance_primitive: u32,
}

/// `RTCRayHit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcRayHit {
    pub(super) ray: RtcRay,
    pub(super) hit: RtcHit,
}

/// `RTCRay8`, `RTCRay16`.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcRays<const N: usize> {
    pub(super) origin: [[f32; N]; 3],
    pub(super) near: [f32; N],
    pub(super) direction: [[f32; N]; 3],
    pub(super) time: [f32; N],
    pub(super) far: [f32; N],
    pub(super) mask: [u32; N],
    pub(super) id: [u32; N],
    pub(super) flags: [u32; N],
}

/// `RTCHit8`, `RTCHit16`.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcHits<const N: usize> {
    pub(super) normal: [[f32; N]; 3],
    pub(super) u: [f32; N],
    pub(super) v: [f32; N],
    pub(super) primitive: [u32; N],
    pub(super) geometry: [u32; N],
    pub(super) instance: [u32; N],
    pub(super) instance_primitive: [u32; N],
}

/// `RTCRayHit8`, `RTCRayHit16`.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub(super) struct RtcRayHits<const N: usize> {
    pub(super) ray: RtcRays<N>,
    pub(super) hit: RtcHits<N>,
}

/// `RTC_INVALID_GEOMETRY_ID`.
pub(super) const INVALID: u32 = u32::MAX;

/// `RTCIntersectArguments` and `RTCOccludedArguments`, which are alike.
#[repr(C)]
#[derive(Debug)]
pub(super) struct Arguments {
    flags: c_uint,
    feature_mask: c_uint,
    context: *mut c_void,
    filter: *mut c_void,
    intersect: *mut c_void,
    min_width_distance_factor: f32,
}

// SAFETY: the pointers are null, and Embree only reads.
unsafe impl Sync for Arguments {}

/// `RTC_RAY_QUERY_FLAG_COHERENT`, everything else as it is without arguments.
pub(super) static COHERENT: Arguments = Arguments {
    flags: 1 << 16,
    feature_mask: c_uint::MAX,
    context: std::ptr::null_mut(),
    filter: std::ptr::null_mut(),
    intersect: std::ptr::null_mut(),
    min_width_distance_factor: 0.0,
};

/// All rays of a packet count; the address is a multiple of 64.
#[repr(C, align(64))]
#[derive(Debug)]
pub(super) struct AllValid(pub(super) [c_int; 16]);

/// See [`AllValid`].
pub(super) static ALL_VALID: AllValid = AllValid([-1; 16]);

/// Handles: pointers to what only Embree knows.
pub(super) type Device = *mut c_void;
/// See [`Device`].
pub(super) type Scene = *mut c_void;
/// See [`Device`].
pub(super) type Geometry = *mut c_void;
/// Told how many bytes come or go.
pub(super) type MemoryMonitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;
type Asks<What> = unsafe extern "C" fn(Scene, *mut What, *const Arguments);
type AsksMany<What> = unsafe extern "C" fn(*const c_int, Scene, *mut What, *const Arguments);

/// Declares the functions and loads them by their names.
macro_rules! interface {
    ($($field:ident = $name:literal: $type:ty;)*) => {
        /// The functions, as long as the program runs.
        #[derive(Debug)]
        pub(super) struct Interface {
            $(pub(super) $field: $type,)*
        }

        impl Interface {
            /// Loads the library; it stays loaded, since it has threads of its own.
            ///
            /// # Errors
            /// When it cannot be loaded or lacks a function.
            pub(super) fn load(path: &Path) -> anyhow::Result<Self> {
                let shown = path.display();
                // SAFETY: loading runs the initialisers of the library that the user named, which
                // are trusted as the program itself is.
                let library = unsafe { Library::new(path) }
                    .with_context(|| format!("cannot load {shown}"))?;
                let library: &'static Library = Box::leak(Box::new(library));
                Ok(Self {
                    // SAFETY: the types are those of the headers of 4.4; another version is refused
                    // before any other function is called.
                    $($field: *unsafe { library.get::<$type>($name) }
                        .with_context(|| format!("{shown} is not Embree 4"))?,)*
                })
            }
        }
    };
}

interface! {
    new_device = "rtcNewDevice": unsafe extern "C" fn(*const c_char) -> Device;
    release_device = "rtcReleaseDevice": unsafe extern "C" fn(Device);
    device_property = "rtcGetDeviceProperty": unsafe extern "C" fn(Device, c_int) -> isize;
    device_error = "rtcGetDeviceError": unsafe extern "C" fn(Device) -> c_int;
    monitor_memory = "rtcSetDeviceMemoryMonitorFunction":
        unsafe extern "C" fn(Device, MemoryMonitor, *mut c_void);
    new_scene = "rtcNewScene": unsafe extern "C" fn(Device) -> Scene;
    release_scene = "rtcReleaseScene": unsafe extern "C" fn(Scene);
    set_scene_quality = "rtcSetSceneBuildQuality": unsafe extern "C" fn(Scene, c_int);
    commit_scene = "rtcCommitScene": unsafe extern "C" fn(Scene);
    new_geometry = "rtcNewGeometry": unsafe extern "C" fn(Device, c_int) -> Geometry;
    release_geometry = "rtcReleaseGeometry": unsafe extern "C" fn(Geometry);
    set_geometry_quality = "rtcSetGeometryBuildQuality": unsafe extern "C" fn(Geometry, c_int);
    share_buffer = "rtcSetSharedGeometryBuffer": unsafe extern "C" fn(
        Geometry, c_int, c_uint, c_int, *const c_void, usize, usize, usize,
    );
    commit_geometry = "rtcCommitGeometry": unsafe extern "C" fn(Geometry);
    attach_geometry = "rtcAttachGeometry": unsafe extern "C" fn(Scene, Geometry) -> c_uint;
    intersect1 = "rtcIntersect1": Asks<RtcRayHit>;
    occluded1 = "rtcOccluded1": Asks<RtcRay>;
    intersect8 = "rtcIntersect8": AsksMany<RtcRayHits<8>>;
    occluded8 = "rtcOccluded8": AsksMany<RtcRays<8>>;
    intersect16 = "rtcIntersect16": AsksMany<RtcRayHits<16>>;
    occluded16 = "rtcOccluded16": AsksMany<RtcRays<16>>;
}

const _: () = {
    // The sizes that the C compiler gives them.
    assert!(size_of::<RtcRay>() == 48 && size_of::<RtcHit>() == 48);
    assert!(size_of::<RtcRayHit>() == 96);
    assert!(size_of::<RtcRays<8>>() == 8 * 48 && size_of::<RtcRays<16>>() == 16 * 48);
    assert!(size_of::<RtcHits<16>>() == 16 * 36);
    // Eight rays of 48 bytes end where 64 divides, and so do their hits, with padding behind them.
    assert!(size_of::<RtcRayHits<8>>() == 8 * 48 + 320);
    assert!(size_of::<RtcRayHits<16>>() == 16 * 84);
};
