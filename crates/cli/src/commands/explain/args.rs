//! What may be typed after `ombra explain`.

use std::path::PathBuf;

use clap::Args;
use ombra::accel::StructureKind;
use ombra::geometry::triangle::TriangleTest;
use ombra::render::{IntegratorKind, MAX_DEPTH, MAX_SPP};

use crate::args::{Accel, Size, Up, accel, named, size};

#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// A scene file (.toml), a model (.obj, .ply, .stl, .gltf, .glb, also with .gz) or a built-in scene's name
    pub(crate) scene: String,

    /// Which pixel: column and row, from the upper left corner, which is 0,0. Only --diff can do without
    #[arg(long, value_name = "x,y", value_parser = pixel, required_unless_present = "diff")]
    pub(crate) pixel: Option<[u32; 2]>,

    /// This sample of the pixel alone, from 0
    #[arg(long, value_name = "K")]
    pub(crate) sample: Option<u32>,

    /// How rays are turned into a picture
    #[arg(long, default_value_t, value_parser = named(IntegratorKind::ALL, IntegratorKind::name, IntegratorKind::line))]
    pub(crate) integrator: IntegratorKind,

    /// Width and height of the picture in pixels [default: what the scene file says, else 960x540]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<Size>,

    /// Samples a pixel; 1 goes through the centre of the pixel
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SPP)))]
    pub(crate) spp: u32,

    /// How often light may be reflected or transmitted [default: what the scene file says, else 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_DEPTH)))]
    pub(crate) max_depth: Option<u32>,

    /// Another seed gives other random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,

    /// The acceleration structure; `ombra structures` lists them
    #[arg(long, value_name = "NAME", default_value = StructureKind::default().name(), value_parser = accel)]
    pub(crate) accel: Accel,

    /// How rays are tested against triangles
    #[arg(long, value_name = "NAME", default_value_t, value_parser = named(&TriangleTest::ALL, TriangleTest::name, TriangleTest::line))]
    pub(crate) triangle_test: TriangleTest,

    /// Which axis of a model points up [default: z for .stl, y otherwise]
    #[arg(long, value_enum)]
    pub(crate) up: Option<Up>,

    /// The whole tree as JSON
    #[arg(long)]
    pub(crate) json: bool,

    /// Draws the rays, in plan and in section
    #[arg(long, value_name = "FILE", conflicts_with = "diff")]
    pub(crate) svg: Option<PathBuf>,

    /// Writes the scene with its rays as a model (glTF, binary)
    #[arg(long, value_name = "FILE", conflicts_with = "diff")]
    pub(crate) glb: Option<PathBuf>,

    /// Finds the first ray where two renders part. Each is `this` (what the other options say), what
    /// differs from it (`accel=kd-ropes`, `seed=7,spp=4`; keys: accel, integrator, max-depth, seed, spp,
    /// triangle-test), or a file that --json wrote
    #[arg(long, num_args = 2, value_names = ["A", "B"])]
    pub(crate) diff: Option<Vec<String>>,

    /// No talk
    #[arg(long)]
    pub(crate) quiet: bool,
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    const WANTED: &str =
        "two whole numbers from 0 with a comma between them, column and row, such as 240,135";
    let (x, y) = text.split_once(',').ok_or(WANTED)?;
    let number = |part: &str| part.trim().parse().map_err(|_| WANTED);
    Ok([number(x)?, number(y)?])
}

#[cfg(test)]
mod tests {
    use super::pixel;

    #[test]
    fn a_pixel_is_a_column_and_a_row() {
        assert_eq!(pixel("0, 7"), Ok([0, 7]));
        for wrong in ["", "1", "1,", "1,2,3", "-1,2", "1.5,2", "99999999999,0"] {
            assert!(pixel(wrong).is_err(), "{wrong}");
        }
    }
}
