//! Files in and out: bytes to descriptions, and pictures to bytes. Nothing is traced here.
//!
//! In come scene files ([`scene::read_scene`]), models, as triangle meshes with Whitted's materials
//! ([`read_model`]: OBJ with MTL, PLY, STL), glTF ([`read_gltf`]), cities ([`city::read_city`]:
//! GeoJSON, CityJSON), points and areas ([`city::read_points`], [`city::read_area`]), surface and terrain models
//! ([`elevation::read_elevation`]: GeoTIFF), and pictures ([`read_texture`], [`read_image`]); out go pictures
//! ([`OutputFile`], [`write_image`]: PNG, EXR, PFM, PPM), maps ([`raster`]), places ([`places`]) and
//! their stretches of shadow ([`spells`], which come in again). [`inspect`] says
//! what a file holds.
//! What is in memory is read by [`read_model_bytes`], [`read_texture_bytes`], [`read_image_bytes`] and
//! [`scene::parse_scene`], which open no file at all.
//!
//! ```no_run
//! use ombra_formats::{Limits, read_model};
//!
//! let model = read_model("bunny.obj", &Limits::default())?;
//! for finding in &model.findings {
//!     eprintln!("note: {finding}");
//! }
//! println!("{} triangles in {:?}", model.triangles(), model.bounds());
//! # Ok::<(), ombra_formats::FormatError>(())
//! ```
//!
//! # Broken files
//! A reader never panics, never allocates for what a header promises, and opens no file outside the
//! model's own folder. What it cannot read is a [`FormatError`] of one line that names the file, the
//! line or byte, what is wrong there and what would be right; what it can pass over is a
//! [`Finding`].

pub mod city;
pub mod contour;
pub mod elevation;
pub mod frames;
pub mod minray;
pub mod places;
pub mod raster;
pub mod scene;
pub mod sha256;
pub mod spells;

mod columns;
mod error;
mod finding;
mod glb;
mod gltf;
mod image;
mod info;
mod input;
mod limits;
mod mesh;
mod number;
mod source;
mod whole;
mod whole_folder;

pub use error::{Fault, FormatError, IndexBase, Place};
pub use finding::Finding;
pub use glb::{GlbMaterial, GlbMesh, GlbModel, GlbTexture};
pub use gltf::{GltfFile, GltfInfo, parse_gltf, read_gltf};
pub use image::{
    Channel, ImageBuffer, ImageFormat, ImageInfo, Metadata, OutputFile, read_image,
    read_image_bytes, read_texture, read_texture_bytes, write_image,
};
pub use info::{FileInfo, MaterialInfo, ModelInfo, SceneInfo, inspect};
pub use input::Assets;
pub use limits::Limits;
pub use mesh::{Model, ModelFormat, Part, read_model, read_model_bytes, with_normals};
pub use whole::{can_write_whole, write_whole};
