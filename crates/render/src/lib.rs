//! Pictures of a scene.
//!
//! [`render`] asks an integrator, chosen by [`IntegratorKind`], for the light (or whatever it
//! measures) along rays through every pixel and collects the answers on a [`Film`]. Integrators are
//! written on the ray programs of `ombra_pipeline`. The picture only depends on the scene, the
//! camera and the [`Settings`], to the last bit: not on the number of threads, and not on how the
//! work is cut into passes or crops.
//!
//! ```
//! use ombra_accel::{Geometry, Shapes, StructureKind};
//! use ombra_geometry::shape::Sphere;
//! use ombra_geometry::{Angle, Point3, Transform, Vector3};
//! use ombra_pipeline::Cpu;
//! use ombra_render::{Settings, Watch, render};
//! use ombra_scene::camera::{Camera, Perspective, Pose, Projection};
//! use ombra_scene::{Light, Material, Rgb, Scene, World};
//!
//! let ball = Sphere::new(Point3::ORIGIN, 1.0);
//! let mut scene = Scene::default();
//! let geometry = Geometry::Shapes(Shapes(vec![ball.into()]));
//! let white = Material::matt("white", Rgb::WHITE);
//! scene.add("ball", geometry, white, Transform::identity());
//! scene.lights.push(Light::Directional { direction: -Vector3::Z, intensity: Rgb::grey(0.5) });
//! let world = World::build(scene, StructureKind::default())?;
//!
//! let camera = Camera {
//!     pose: Pose::look_at(Point3::new(0.0, 0.0, 5.0), Point3::ORIGIN, Vector3::Y)?,
//!     projection: Projection::Perspective(Perspective::new(Angle::from_degrees(40.0))),
//! };
//! let settings = Settings { width: 33, height: 33, ..Settings::default() };
//! let rendering = render(&world, &camera, &settings, &Cpu::all_threads(), Watch::default())?;
//!
//! assert_eq!(rendering.film.average(16, 16), Some(Rgb::grey(0.5))); // it faces the light
//! assert_eq!(rendering.film.average(0, 0), Some(Rgb::BLACK)); // the background
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How to find things
//! [`film`]: what is collected. [`sampler`]: where rays go through a pixel. [`display`]: how numbers
//! that are no light are shown. `integrator`: one file each. `optics`: the laws of reflection and
//! refraction. [`raster`]: the other loop, without rays.

pub mod compare;
pub mod display;
pub mod film;
pub mod optics;
pub mod raster;
pub mod sampler;

pub mod explain;

mod exposure;
mod integrator;
mod render;
mod settings;
mod shading;
mod shots;
mod watch;

pub use film::{Crop, Film};
pub use integrator::IntegratorKind;
pub use render::{RenderError, Rendering, render};
pub use sampler::SamplerKind;
pub use settings::{MAX_DEPTH, MAX_PIXELS, MAX_SIDE, MAX_SPP, Settings};
pub use watch::{Progress, Watch};
