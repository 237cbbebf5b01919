//! ombra is a ray tracing engine: one engine with three doors. It renders pictures, it runs your own
//! ray programs in the shape of OptiX, and it answers ray queries.
//!
//! This crate is the one door for Rust users; each part is a crate of its own underneath.
//!
//! ```
//! use ombra::pipeline::Cpu;
//! use ombra::render::{Settings, Watch, render};
//! use ombra::scene::World;
//!
//! let loaded = ombra::load("whitted", &ombra::LoadOptions::default())?;
//! let world = World::build(loaded.scene, ombra::accel::StructureKind::default())?;
//! let settings = Settings { width: 64, height: 36, spp: 1, ..Settings::default() };
//! let camera = ombra::camera(&world, settings.aspect());
//! let picture = render(&world, &camera, &settings, &Cpu::all_threads(), Watch::default())?;
//! assert_eq!(picture.display().len(), 64 * 36);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Or one ray against a mesh: see [`accel`]. Or programs of your own: see [`pipeline`].

pub mod builtin;

mod defaults;
mod load;

pub use defaults::camera;
pub use load::{LoadError, LoadOptions, Loaded, load};
pub use ombra_accel as accel;
pub use ombra_accrual as accrual;
pub use ombra_city as city;
pub use ombra_formats as formats;
pub use ombra_geometry as geometry;
pub use ombra_pipeline as pipeline;
pub use ombra_render as render;
pub use ombra_scene as scene;
pub use ombra_sun as sun;
