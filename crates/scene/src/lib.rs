//! What is there to be seen: cameras, materials, textures, lights, and objects that have a geometry
//! and a place.
//!
//! A [`Scene`] is a description. [`World::build`] puts an acceleration structure over it; a hit in
//! that world becomes an [`Interaction`] once, in a closest-hit program.

pub mod camera;
pub mod light;

mod background;
mod colour;
mod interaction;
mod material;
mod presence;
mod scene;
mod texture;
mod world;

pub use background::{Background, Cutoff};
pub use camera::Camera;
pub use colour::Rgb;
pub use interaction::Interaction;
pub use light::Light;
pub use material::{Cutout, Material, MaterialId};
pub use scene::{Object, Scene, SceneError};
pub use texture::{Filter, Image, PictureTexture, Texture, UvTransform, Wrap};
pub use world::World;
