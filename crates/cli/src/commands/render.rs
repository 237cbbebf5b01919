//! `ombra render`: from a scene to a picture.

use std::io::{self, IsTerminal as _, Write as _};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use clap::Parser as _;
use ombra::accel::Traversable as _;
use ombra::formats::{ImageBuffer, ImageFormat, Metadata, write_image};
use ombra::geometry::Vector3;
use ombra::pipeline::Cpu;
use ombra::render::{Rendering, Settings, Watch};
use ombra::scene::World;
use ombra::{LoadOptions, Loaded};
use serde::Serialize;

use crate::args::{Cli, Command, Device, RenderArgs, Size, Up};
use crate::interrupt;
use crate::progress::{Display, rate};

const SIZE: Size = Size {
    width: 960,
    height: 540,
};
const SPP: u32 = 16;

/// Statistics of one picture: what `--json` prints.
#[derive(Serialize)]
struct Statistics<'a> {
    scene: &'a str,
    output: &'a Path,
    integrator: &'a str,
    accel: &'a str,
    width: u32,
    height: u32,
    spp: u32,
    seed: u64,
    threads: usize,
    /// Seconds of rendering alone.
    seconds: f64,
    rays: u64,
    rays_per_second: f64,
    load_seconds: f64,
    build_seconds: f64,
    /// Bytes of structures and primitives.
    bytes: usize,
    /// Bytes of the structures alone.
    structure_bytes: usize,
    primitives: usize,
    /// The share of samples that was done, 1 unless interrupted.
    done: f64,
    interrupted: bool,
}

/// What `ombra` does without arguments.
pub(crate) fn default_scene() -> anyhow::Result<ExitCode> {
    let scene = ombra::builtin::DEFAULT;
    let output = format!("{scene}.png");
    let Some(Command::Render(args)) =
        Cli::parse_from(["ombra", "render", scene, "--output", &output]).command
    else {
        bail!("rendering is not what `render` does");
    };
    let code = run(&args)?;
    if code == ExitCode::SUCCESS {
        let mut out = io::stderr().lock();
        writeln!(out, "\nNext, try:")?;
        writeln!(out, "  ombra render cornell -o cornell.png --spp 64")?;
        writeln!(
            out,
            "  ombra render model.obj -o model.png         # a model of your own: obj, ply, stl"
        )?;
        writeln!(
            out,
            "  ombra render teapot -o cost.png --integrator cost --accel kd-ropes"
        )?;
        writeln!(
            out,
            "  ombra scenes                                # what else is built in"
        )?;
        writeln!(out, "  ombra --help")?;
    }
    Ok(code)
}

pub(crate) fn run(args: &RenderArgs) -> anyhow::Result<ExitCode> {
    if args.device == Device::Gpu {
        bail!("this build of ombra cannot use a GPU; take --device cpu or --device auto");
    }
    // What would fail in the end fails at once.
    let format = ImageFormat::of(&args.output)?;
    let cpu = Cpu::with_threads(args.threads as usize).context("cannot start the threads")?;
    let stop = interrupt::watch()?;
    let talk = Talk { quiet: args.quiet };
    if let Some(alias) = args.accel.alias {
        talk.say(&alias.to_string());
    }

    let begun = Instant::now();
    let options = LoadOptions {
        up: args.up.map(up),
        triangle_test: args.triangle_test,
        ..LoadOptions::default()
    };
    let Loaded {
        scene,
        picture,
        findings,
        hash,
    } = cpu.install(|| ombra::load(&args.scene, &options))?;
    for finding in &findings {
        talk.say(&format!("{}: {finding}", args.scene));
    }
    let load = begun.elapsed();

    let begun = Instant::now();
    let world = cpu.install(|| World::build(scene, args.accel.kind))?;
    let build = begun.elapsed();

    let size = args
        .size
        .or(picture.size.map(|[width, height]| Size { width, height }))
        .unwrap_or(SIZE);
    let settings = Settings {
        width: size.width,
        height: size.height,
        spp: args.spp.or(picture.spp).unwrap_or(SPP),
        max_depth: args.max_depth,
        seed: args.seed,
        crop: args.crop,
        integrator: args.integrator,
        ..Settings::default()
    };
    let (rendering, seconds) = render(args, &world, &settings, &cpu, &stop)?;
    if rendering.film.done() == 0.0 {
        talk.say("interrupted before there was anything to keep; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    }
    write(args, format, &rendering, &settings, hash, seconds)?;

    let statistics = Statistics {
        scene: &args.scene,
        output: &args.output,
        integrator: settings.integrator.name(),
        accel: args.accel.kind.name(),
        width: rendering.film.width(),
        height: rendering.film.height(),
        spp: settings.spp,
        seed: settings.seed,
        threads: cpu.threads(),
        seconds: seconds.as_secs_f64(),
        rays: rendering.rays,
        rays_per_second: rendering.rays as f64 / seconds.as_secs_f64().max(1e-9),
        load_seconds: load.as_secs_f64(),
        build_seconds: build.as_secs_f64(),
        bytes: world.bytes(),
        structure_bytes: world.structure_bytes(),
        primitives: world.primitives(),
        done: rendering.film.done(),
        interrupted: rendering.stopped,
    };
    talk.say(&summary(&statistics));
    if args.json {
        writeln!(
            io::stdout(),
            "{}",
            serde_json::to_string_pretty(&statistics)?
        )?;
    }
    let code = if rendering.stopped {
        interrupt::EXIT_CODE
    } else {
        0
    };
    Ok(ExitCode::from(code))
}

fn render(
    args: &RenderArgs,
    world: &World,
    settings: &Settings,
    cpu: &Cpu,
    stop: &AtomicBool,
) -> anyhow::Result<(Rendering, Duration)> {
    let camera = ombra::camera(world, settings.aspect());
    let display = Display::new(!args.quiet && io::stderr().is_terminal());
    let progress = |progress| display.update(progress);
    let mut pass = |film: &_| display.show(film);
    let watch = Watch {
        stop: Some(stop),
        progress: Some(&progress),
        pass: Some(&mut pass),
    };
    let begun = Instant::now();
    let rendering = ombra::render::render(world, &camera, settings, cpu, watch);
    let seconds = begun.elapsed();
    display.finish();
    Ok((rendering?, seconds))
}

fn write(
    args: &RenderArgs,
    format: ImageFormat,
    rendering: &Rendering,
    settings: &Settings,
    scene_hash: String,
    seconds: Duration,
) -> anyhow::Result<()> {
    let floats = matches!(format, ImageFormat::Exr | ImageFormat::Pfm);
    let pixels = if floats {
        rendering.raw()
    } else {
        rendering.display()
    };
    let image = ImageBuffer::new(rendering.film.width(), rendering.film.height(), pixels)?;
    // Only EXR tells how it came about in full: the same picture is the same bytes in the others,
    // whatever the number of threads in the command and the seconds that it took.
    let in_full = format == ImageFormat::Exr;
    let command = || {
        let arguments: Vec<_> = std::env::args().skip(1).collect();
        format!("ombra {}", arguments.join(" "))
    };
    let metadata = Metadata {
        command: in_full.then(command),
        version: Some(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned()),
        scene_hash: Some(scene_hash),
        seed: Some(settings.seed),
        seconds: in_full.then_some(seconds.as_secs_f64()),
    };
    write_image(&args.output, &image, &metadata)?;
    Ok(())
}

fn summary(statistics: &Statistics<'_>) -> String {
    let Statistics {
        width,
        height,
        spp,
        output,
        ..
    } = statistics;
    let kept = if statistics.interrupted {
        format!(
            "interrupted at {:.0} %; kept what was done: ",
            statistics.done * 100.0
        )
    } else {
        String::new()
    };
    format!(
        "{kept}{} ({width}x{height}, {spp} spp, {} primitives in \"{}\" built in {:.2} s; {} rays in {:.2} s, {})",
        output.display(),
        statistics.primitives,
        statistics.accel,
        statistics.build_seconds,
        statistics.rays,
        statistics.seconds,
        rate(statistics.rays, Duration::from_secs_f64(statistics.seconds)),
    )
}

const fn up(axis: Up) -> Vector3 {
    match axis {
        Up::X => Vector3::X,
        Up::Y => Vector3::Y,
        Up::Z => Vector3::Z,
    }
}

/// Says things on standard error, unless asked not to.
struct Talk {
    quiet: bool,
}

impl Talk {
    fn say(&self, text: &str) {
        if !self.quiet {
            // Nobody is left to tell if this fails.
            let _ = writeln!(io::stderr(), "{text}");
        }
    }
}
