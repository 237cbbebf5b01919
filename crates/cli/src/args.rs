//! What may be typed, as types: parser, help and error messages follow from these.

use std::path::PathBuf;

use crate::commands::bench::BenchArgs;
use crate::commands::explain::ExplainArgs;
use crate::commands::shadows::ShadowsCommand;
use crate::commands::study::StudyArgs;
use clap::{Args, Parser, Subcommand, ValueEnum};
use ombra::accel::{StructureAlias, StructureKind, UnknownStructure};
use ombra::formats::ImageFormat;
use ombra::geometry::triangle::TriangleTest;
use ombra::render::{Crop, IntegratorKind, MAX_DEPTH, MAX_SIDE, MAX_SPP};

/// The path of a picture, with the ending of a format.
fn picture(text: &str) -> Result<PathBuf, String> {
    match ImageFormat::of(text) {
        Ok(_) => Ok(PathBuf::from(text)),
        Err(_) => Err(format!(
            "a file that ends in {} is wanted",
            ImageFormat::KNOWN
        )),
    }
}

/// A ray tracing engine.
///
/// Without a command, the built-in scene `whitted` is rendered to whitted.png.
#[derive(Debug, Parser)]
#[command(name = "ombra", version, disable_help_subcommand = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene or a model to a picture
    Render(Box<RenderArgs>),
    /// Rasterize and ray trace a scene, and compare the two loops
    Compare(Box<CompareArgs>),
    /// How many minutes each place of a city lies in shadow
    Shadows(ShadowsCommand),
    /// Compare all acceleration structures: building, memory, steps, speed
    Study(Box<StudyArgs>),
    /// The minimal ray tracing contest of 1987: its scenes, its format, its rules
    #[command(subcommand)]
    Minray(MinrayCommand),
    /// Tell how a pixel came about: all of its rays
    Explain(Box<ExplainArgs>),
    /// Measure: ombra's parts against one another, or ombra against other ray tracers
    Bench(Box<BenchArgs>),
    /// Say what a file holds: a model, a scene, a picture
    Info(InfoArgs),
    /// List the built-in scenes
    Scenes(ListArgs),
    /// List the acceleration structures that --accel knows
    Structures(ListArgs),
}

#[derive(Debug, Args)]
pub(crate) struct RenderArgs {
    /// A scene file (.toml), a model (.obj, .ply, .stl, .gltf, .glb, also with .gz) or a built-in scene's name
    pub(crate) scene: String,

    /// Where to write the picture; the ending chooses the format: png, exr, pfm, ppm
    #[arg(short, long, value_name = "OUT", value_parser = picture)]
    pub(crate) output: PathBuf,

    /// How to turn rays into a picture
    #[arg(long, default_value_t, value_parser = named(IntegratorKind::ALL, IntegratorKind::name, IntegratorKind::line))]
    pub(crate) integrator: IntegratorKind,

    /// Width and height in pixels [default: what the scene file says, else 960x540]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<Size>,

    /// Samples a pixel; 1 goes through the centre of the pixel [default: what the scene file says, else 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SPP)))]
    pub(crate) spp: Option<u32>,

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

    /// Threads to use; 0 means all
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1024))]
    pub(crate) threads: u32,

    /// Where to run; `auto` takes a GPU if this build can use one
    #[arg(long, value_enum, default_value_t = Device::Auto)]
    pub(crate) device: Device,

    /// Render these pixels only: left, top, right, bottom; right and bottom are not included
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = crop)]
    pub(crate) crop: Option<Crop>,

    /// Which axis of a model points up [default: z for .stl, y otherwise]
    #[arg(long, value_enum)]
    pub(crate) up: Option<Up>,

    /// No progress bar, no talk
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Statistics on standard output, as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// A scene file (.toml), a model (.obj, .ply, .stl, .gltf, .glb, also with .gz) or a built-in scene's name
    pub(crate) scene: String,

    /// The folder for the pictures and the page; made if it is not there [default: SCENE-compared]
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,

    /// Width and height in pixels [default: what the scene file says, else 960x540]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub(crate) size: Option<Size>,

    /// Samples a pixel; 1 goes through the centre of the pixel [default: what the scene file says, else 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SPP)))]
    pub(crate) spp: Option<u32>,

    /// How often light may be reflected or transmitted [default: what the scene file says, else 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_DEPTH)))]
    pub(crate) max_depth: Option<u32>,

    /// Another seed gives other random numbers
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,

    /// The acceleration structure of the rays; `ombra structures` lists them
    #[arg(long, value_name = "NAME", default_value = StructureKind::default().name(), value_parser = accel)]
    pub(crate) accel: Accel,

    /// How rays are tested against triangles
    #[arg(long, value_name = "NAME", default_value_t, value_parser = named(&TriangleTest::ALL, TriangleTest::name, TriangleTest::line))]
    pub(crate) triangle_test: TriangleTest,

    /// Threads to use; 0 means all
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1024))]
    pub(crate) threads: u32,

    /// Compare these pixels only: left, top, right, bottom; right and bottom are not included
    #[arg(long, value_name = "x0,y0,x1,y1", value_parser = crop)]
    pub(crate) crop: Option<Crop>,

    /// Which axis of a model points up [default: z for .stl, y otherwise]
    #[arg(long, value_enum)]
    pub(crate) up: Option<Up>,

    /// No progress bar, no talk
    #[arg(long)]
    pub(crate) quiet: bool,

    /// The numbers on standard output as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

impl CompareArgs {
    /// The same, as one would ask for a picture.
    pub(crate) fn as_render(&self) -> RenderArgs {
        RenderArgs {
            scene: self.scene.clone(),
            output: PathBuf::new(),
            integrator: IntegratorKind::default(),
            size: self.size,
            spp: self.spp,
            max_depth: self.max_depth,
            seed: self.seed,
            accel: self.accel,
            triangle_test: self.triangle_test,
            threads: self.threads,
            device: Device::Cpu,
            crop: self.crop,
            up: self.up,
            quiet: self.quiet,
            json: self.json,
        }
    }
}

/// The first scene of the contest.
pub(crate) const FIRST_OF_CONTEST: &str = "test1";

#[derive(Debug, Subcommand)]
pub(crate) enum MinrayCommand {
    /// Render a scene of the contest and write the picture in its format
    Render(MinrayRenderArgs),
    /// Score a picture in the contest's format, from any program, by the contest's rules
    Verify(MinrayVerifyArgs),
}

#[derive(Debug, Args)]
pub(crate) struct MinrayRenderArgs {
    /// A scene of the contest: a ray.h, or test1, test2, test3
    #[arg(default_value = FIRST_OF_CONTEST)]
    pub(crate) scene: String,

    /// Where to write the picture [default: standard output]
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct MinrayVerifyArgs {
    /// The picture: "xsize ysize", then "r g b" for each pixel
    pub(crate) file: PathBuf,

    /// The scene that it shows: a ray.h, or test1, test2, test3
    #[arg(long, value_name = "SCENE", default_value = FIRST_OF_CONTEST)]
    pub(crate) scene: String,

    /// As JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct InfoArgs {
    /// The file
    pub(crate) file: PathBuf,

    /// As JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ListArgs {
    /// As JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Pixels across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// A structure and, if it was called by another name, which.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accel {
    pub(crate) kind: StructureKind,
    pub(crate) alias: Option<StructureAlias>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Device {
    Cpu,
    Gpu,
    Auto,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Up {
    X,
    Y,
    Z,
}

/// Parses the name of one of a closed set, so that help and errors list all of them.
pub(crate) fn named<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
    line: fn(T) -> &'static str,
) -> impl clap::builder::TypedValueParser<Value = T> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let values = all
        .iter()
        .map(|&one| PossibleValue::new(name(one)).help(line(one)));
    PossibleValuesParser::new(values).map(move |typed| {
        let of_that_name = all.iter().copied().find(|&one| name(one) == typed);
        of_that_name.expect("the parser accepts names of the set only")
    })
}

pub(crate) fn accel(text: &str) -> Result<Accel, UnknownStructure> {
    Ok(Accel {
        kind: text.parse()?,
        alias: StructureAlias::of(text),
    })
}

pub(crate) fn size(text: &str) -> Result<Size, String> {
    const WANTED: &str =
        "two whole numbers from 1 to 65536 with an x between them, such as 960x540";
    const { assert!(MAX_SIDE == 65536) };
    let (width, height) = text.split_once(['x', 'X']).ok_or(WANTED)?;
    let number = |part: &str| {
        part.trim()
            .parse::<u32>()
            .ok()
            .filter(|n| (1..=MAX_SIDE).contains(n))
            .ok_or(WANTED)
    };
    Ok(Size {
        width: number(width)?,
        height: number(height)?,
    })
}

fn crop(text: &str) -> Result<Crop, String> {
    const WANTED: &str = "four whole numbers left,top,right,bottom with left < right and \
                          top < bottom, such as 100,50,300,200";
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x0, y0, x1, y1]) if x0 < x1 && y0 < y1 => Ok(Crop { x0, y0, x1, y1 }),
        _ => Err(WANTED.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_parser_is_sound() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes_are_two_numbers_above_zero() {
        assert_eq!(
            size("960x540"),
            Ok(Size {
                width: 960,
                height: 540
            })
        );
        for wrong in [
            "",
            "960",
            "960x",
            "0x10",
            "-1x10",
            "1x2x3",
            "99999999999x1",
            "65537x1",
        ] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_crop_has_pixels() {
        assert_eq!(
            crop("1,2,3,4"),
            Ok(Crop {
                x0: 1,
                y0: 2,
                x1: 3,
                y1: 4
            })
        );
        for wrong in ["", "1,2,3", "1,2,1,4", "3,2,1,4", "a,b,c,d", "1,2,3,4,5"] {
            assert!(crop(wrong).is_err(), "{wrong}");
        }
    }
}
