//! `ombra explain`: all rays of a pixel, as text, as JSON, as a drawing, as a model.

mod args;
mod diff;
mod document;
mod drawing;
mod json;
mod model;
mod number;
mod part;
mod path;
mod reading;
mod side;
mod solid;
mod text;

use std::cell::RefCell;
use std::io::{self, BufWriter, Write as _};
use std::process::ExitCode;

use ombra::formats::{can_write_whole, write_whole};
use ombra::geometry::Vector3;
use ombra::pipeline::Cpu;
use ombra::render::Settings;
use ombra::render::explain::{ExplainError, Explainer, SampleTree};
use ombra::scene::{Camera, Scene, World};
use ombra::{LoadOptions, Loaded};

use crate::args::{Size, Up};
pub(crate) use args::ExplainArgs;
use document::{FORMAT, Heading, Sample};
use drawing::Drawing;
use number::numbers;
use side::Choice;
use text::counted;

const SIZE: Size = Size {
    width: 960,
    height: 540,
};

/// A drawing or a model shows the rays of samples until there are so many.
const MAX_KEPT: usize = 100_000;

pub(crate) fn run(args: &ExplainArgs) -> anyhow::Result<ExitCode> {
    if let Some(sides) = &args.diff {
        return diff::run(args, sides);
    }
    let Some(pixel) = args.pixel else {
        wrong_usage("--pixel x,y says which pixel")
    };
    // Before the work, so that none is in vain.
    for path in [&args.svg, &args.glb].into_iter().flatten() {
        can_write_whole(path)?;
    }
    let stage = Stage::load(args, &Choice::of(args))?;
    stage.talk(args);
    let heading = stage.heading(args, pixel);
    let cpu = Cpu::all_threads();
    let (world, settings) = (&stage.world, &stage.settings);
    let mut explainer = usage_or_failure(Explainer::new(world, &stage.camera, settings, pixel))?;
    let indices = match args.sample {
        None => 0..settings.spp,
        Some(sample) if sample < settings.spp => sample..sample + 1,
        Some(sample) => {
            let spp = settings.spp;
            wrong_usage(&ExplainError::NoSuchSample { sample, spp }.to_string())
        }
    };
    let explainer = RefCell::new(&mut explainer);
    let drawn = args.svg.is_some() || args.glb.is_some();
    let kept: RefCell<Kept> = RefCell::default();
    let mut indices = indices;
    let mut explained = || -> anyhow::Result<Option<Sample>> {
        let Some(index) = indices.next() else {
            return Ok(None);
        };
        let tree = explainer.borrow_mut().sample(index, &cpu)?;
        if drawn {
            kept.borrow_mut().keep(&tree);
        }
        Ok(Some(Sample::of(&tree, world.scene())))
    };
    // Before anything is written: what cannot be explained leaves no half of a text.
    let mut first = explained()?;
    let next = || match first.take() {
        None => explained(),
        first => Ok(first),
    };
    let colour = || numbers(explainer.borrow().colour().to_array());
    let mut out = BufWriter::new(io::stdout().lock());
    if args.json {
        let written = json::Written {
            heading: &heading,
            samples: json::Samples(RefCell::new(next)),
            colour: &colour,
        };
        serde_json::to_writer_pretty(&mut out, &written).map_err(json_error)?;
        writeln!(out)?;
    } else {
        let mut next = next;
        let mut text = text::Text::begin(&mut out, &heading)?;
        while let Some(sample) = next()? {
            text.sample(&sample)?;
        }
        text.end(colour(), args.sample.is_none())?;
    }
    out.flush()?;
    let kept = kept.borrow();
    if let Some(notice) = kept.notice().filter(|_| !args.quiet) {
        // Nobody is left to tell if this fails.
        let _ = writeln!(io::stderr(), "not drawn: {notice}");
    }
    if let Some(path) = &args.svg {
        let drawing = Drawing {
            heading: &heading,
            scene: stage.scene(),
            kept: &kept,
        };
        write_whole(path, drawing.svg().as_bytes())?;
    }
    if let Some(path) = &args.glb {
        model::model(stage.scene(), &kept.samples).write(path)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The samples that a drawing or a model shows.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    samples: Vec<SampleTree>,
    /// The rays of these.
    rays: usize,
    /// How many more samples there are, and their rays.
    left_out: (usize, usize),
}

impl Kept {
    fn keep(&mut self, tree: &SampleTree) {
        let rays = tree.rays.len();
        if self.rays < MAX_KEPT {
            self.rays += rays;
            self.samples.push(tree.clone());
        } else {
            self.left_out.0 += 1;
            self.left_out.1 += rays;
        }
    }

    /// What was left out because there is too much of it; none if nothing was.
    fn notice(&self) -> Option<String> {
        let (samples, rays) = self.left_out;
        let (samples, rays) = (counted(samples, "sample"), counted(rays, "ray"));
        (self.left_out.0 > 0).then(|| format!("the last {samples} with {rays}"))
    }
}

/// An error of writing is told from one of explaining, so that a reader like `head` may go away.
fn json_error(error: serde_json::Error) -> anyhow::Error {
    if error.is_io() {
        io::Error::from(error).into()
    } else {
        error.into()
    }
}

/// A scene with a structure over it, and how to look at it.
pub(crate) struct Stage {
    pub(crate) world: World,
    pub(crate) camera: Camera,
    pub(crate) settings: Settings,
    hash: String,
    findings: Vec<String>,
}

impl Stage {
    pub(crate) fn load(args: &ExplainArgs, choice: &Choice) -> anyhow::Result<Self> {
        let options = LoadOptions {
            up: args.up.map(up),
            triangle_test: choice.triangle_test,
            ..LoadOptions::default()
        };
        let Loaded {
            scene,
            picture,
            findings,
            hash,
        } = ombra::load(&args.scene, &options)?;
        let scenes = picture.settings(Settings {
            width: SIZE.width,
            height: SIZE.height,
            ..Settings::default()
        });
        let Size { width, height } = args.size.unwrap_or(Size {
            width: scenes.width,
            height: scenes.height,
        });
        let settings = Settings {
            width,
            height,
            spp: choice.spp,
            max_depth: choice.max_depth.unwrap_or(scenes.max_depth),
            seed: choice.seed,
            integrator: choice.integrator,
            ..scenes
        };
        let world = World::build(scene, choice.accel)?;
        let camera = ombra::camera(&world, settings.aspect());
        Ok(Self {
            world,
            camera,
            settings,
            hash,
            findings,
        })
    }

    pub(crate) fn scene(&self) -> &Scene {
        self.world.scene()
    }

    /// Says what there is to say about the scene, on standard error.
    fn talk(&self, args: &ExplainArgs) {
        if args.quiet {
            return;
        }
        let alias = args.accel.alias.map(|alias| alias.to_string());
        let findings = self.findings.iter();
        let findings = findings.map(|finding| format!("{}: {finding}", args.scene));
        for line in alias.into_iter().chain(findings) {
            // Nobody is left to tell if this fails.
            let _ = writeln!(io::stderr(), "{line}");
        }
    }

    fn heading(&self, args: &ExplainArgs, pixel: [u32; 2]) -> Heading {
        let Settings {
            width,
            height,
            spp,
            max_depth,
            seed,
            integrator,
            ..
        } = self.settings;
        Heading {
            format: FORMAT,
            ombra: env!("CARGO_PKG_VERSION").to_owned(),
            scene: args.scene.clone(),
            scene_hash: self.hash.clone(),
            integrator: integrator.name().to_owned(),
            accel: args.accel.kind.name().to_owned(),
            triangle_test: args.triangle_test.name().to_owned(),
            width,
            height,
            spp,
            max_depth,
            seed,
            pixel,
        }
    }
}

/// Ends with exit code 2 and the usage of this command, as for any other word that cannot be
/// understood.
pub(crate) fn wrong_usage(message: &str) -> ! {
    crate::commands::wrong_usage("explain", message)
}

/// A pixel or a sample that is not there is wrong usage; everything else is a failure.
pub(crate) fn usage_or_failure<T>(result: Result<T, ExplainError>) -> anyhow::Result<T> {
    match result {
        Err(error @ (ExplainError::PixelOutside { .. } | ExplainError::NoSuchSample { .. })) => {
            wrong_usage(&error.to_string())
        }
        other => Ok(other?),
    }
}

const fn up(axis: Up) -> Vector3 {
    match axis {
        Up::X => Vector3::X,
        Up::Y => Vector3::Y,
        Up::Z => Vector3::Z,
    }
}
