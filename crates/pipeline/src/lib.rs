//! Ray programs in the shape of OptiX, in Rust.
//!
//! You write small programs: what rays to start ([`RayGeneration`]), and for each ray type what a
//! hit or a miss means ([`RayProgram`]). A [`Cpu`] launches them over a buffer of one, two or three
//! dimensions. Programs are generic: the compiler sees who calls whom. Only the any-hit program is
//! called through a pointer, once a hit, so that structures are compiled once and not once a
//! program.
//!
//! | OptiX | here |
//! |---|---|
//! | context | the type that implements [`Pipeline`]: the data that programs share |
//! | ray type, payload (`rtPayload`, per-ray data) | [`RayType`] and its `Payload` |
//! | entry point, ray generation program | [`RayGeneration`] and its `Entry`, [`RayGeneration::generate`] |
//! | exception program | [`RayGeneration::exception`] |
//! | closest hit, any hit, miss program | the methods of [`RayProgram`] |
//! | intersection program, bounding box program | [`Intersection`], placed by [`Custom`] |
//! | top object | [`Pipeline::world`] |
//! | acceleration `"Lbvh"`, traverser `"Bvh"` | [`StructureKind`](ombra_accel::StructureKind), parsed from a name; these two names are names there, too |
//! | `rtTrace` | [`Context::trace`]; many at once: [`RayGeneration::generate_many`] |
//! | `rtIgnoreIntersection`, `rtTerminateRay` | [`AnyHit::Ignore`], [`AnyHit::Terminate`] |
//! | `rtReportIntersection` | the `report` of [`Intersection::intersect`] |
//! | `rtThrow`, `rtGetExceptionCode` | `return Err(`[`Exception::user`]`(..))`, `match` on [`Exception`] |
//! | `rtLaunchIndex` | [`Context::launch_index`] |
//! | maximum trace depth, stack size | [`Pipeline::max_trace_depth`], [`Exception::StackOverflow`] |
//! | buffer, launch | a slice, [`Cpu::launch`] |
//!
//! The rules, with the lecture's program beside ours, are on one page: `docs/programs.md`.
//!
//! ```
//! use ombra_accel::{Accel, AnyHit, Shapes, StructureKind};
//! use ombra_geometry::{Hit, Point3, Ray, Vector3, shape::Sphere};
//! use ombra_pipeline::{Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType};
//!
//! /// Is the sky above each place free?
//! struct SkyView {
//!     places: Vec<Point3>,
//!     world: Accel<Shapes>,
//! }
//!
//! enum Shadow {}
//! impl RayType for Shadow {
//!     type Payload = bool;
//!     const NAME: &'static str = "shadow";
//! }
//!
//! impl Pipeline for SkyView {
//!     type World = Accel<Shapes>;
//!     fn world(&self) -> &Accel<Shapes> {
//!         &self.world
//!     }
//! }
//!
//! impl RayProgram<Shadow> for SkyView {
//!     fn any_hit(&self, _ray: &Ray, _hit: &Hit, blocked: &mut bool) -> AnyHit {
//!         *blocked = true;
//!         AnyHit::Terminate
//!     }
//! }
//!
//! impl RayGeneration for SkyView {
//!     type Output = bool;
//!     fn generate(&self, cx: &mut Context<'_, Self>, output: &mut bool) -> Result<(), Exception> {
//!         let place = *cx.element(&self.places, cx.launch_index()[0] as usize)?;
//!         cx.trace::<Shadow>(&Ray::new(place, Vector3::Z), output)
//!     }
//! }
//!
//! let ball = Sphere::new(Point3::new(0.0, 0.0, 5.0), 1.0);
//! let program = SkyView {
//!     places: vec![Point3::ORIGIN, Point3::new(3.0, 0.0, 0.0)],
//!     world: Accel::build(Shapes(vec![ball.into()]), StructureKind::default()),
//! };
//! let mut blocked = [false; 2];
//! Cpu::all_threads().launch(&program, [2, 1, 1], &mut blocked, &Control::default())?;
//! assert_eq!(blocked, [true, false]);
//! # Ok::<(), ombra_pipeline::LaunchError>(())
//! ```

mod batch;
mod context;
mod control;
mod cpu;
mod exception;
mod intersection;
mod program;

pub use batch::Batch;
pub use context::Context;
pub use control::{Control, Done};
pub use cpu::{Cpu, LaunchReport};
pub use exception::{Exception, LaunchError, LaunchException};
pub use intersection::{Custom, Intersection};
pub use ombra_accel::AnyHit;
pub use program::{Pipeline, RayGeneration, RayProgram, RayType};
