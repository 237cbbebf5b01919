//! `ombra render`: from a scene to a picture.

use std::borrow::Cow;
use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use clap::Parser as _;
use ombra::accel::Traversable as _;
use ombra::formats::scene::Picture;
use ombra::formats::{ImageBuffer, ImageFormat, Metadata, OutputFile, write_image};
use ombra::geometry::Vector3;
use ombra::pipeline::Cpu;
use ombra::render::raster::notice;
use ombra::render::{IntegratorKind, Rendering, Settings, Watch};
use ombra::scene::World;
use ombra::{LoadOptions, Loaded};
use serde::Serialize;

use super::{Talk, command};
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
    output: Cow<'a, str>,
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
        // Cargo sets this for what it runs: the binary is not on the path then.
        let by_cargo = std::env::var_os("CARGO").is_some();
        let ombra = if by_cargo {
            "cargo run --release --"
        } else {
            "ombra"
        };
        let mut out = io::stderr().lock();
        writeln!(out, "\nNext, try:")?;
        writeln!(out, "  {ombra} render cornell -o cornell.png --spp 64")?;
        writeln!(
            out,
            "  {ombra} render model.obj -o model.png    # a model of yours: obj, ply, stl, glb"
        )?;
        writeln!(
            out,
            "  {ombra} render teapot -o cost.png --integrator cost --accel kd-ropes"
        )?;
        writeln!(
            out,
            "  {ombra} scenes                           # what else is built in"
        )?;
        writeln!(out, "  {ombra} --help")?;
    }
    Ok(code)
}

pub(crate) fn run(args: &RenderArgs) -> anyhow::Result<ExitCode> {
    if args.device == Device::Gpu {
        bail!("this build of ombra cannot use a GPU; take --device cpu or --device auto");
    }
    let talk = Talk { quiet: args.quiet };
    if let Some(alias) = args.accel.alias {
        talk.say(&alias.to_string());
    }
    // What would fail in the end fails at once. The file is begun again when there is a picture, so
    // that nothing lies about if this is killed before.
    let format = OutputFile::create(&args.output)?.format();
    let cpu = Cpu::with_threads(args.threads as usize).context("cannot start the threads")?;
    let stop = interrupt::watch(args.quiet)?;

    let begun = Instant::now();
    let Loaded {
        scene,
        picture,
        findings,
        hash,
    } = cpu.install(|| load(args))?;
    for finding in &findings {
        talk.say(&format!("{}: {finding}", args.scene));
    }
    if scene.objects.is_empty() {
        talk.say(&format!(
            "{}: no objects; there is nothing to see",
            args.scene
        ));
    }
    if args.up.is_some() && scene.camera.is_some() {
        talk.say("--up has no effect: the scene has a camera of its own");
    }
    let load_time = begun.elapsed();
    let settings = settings(args, picture);
    settings.validate()?;
    if stop.load(Ordering::Relaxed) {
        return Ok(nothing_kept(&talk));
    }

    let begun = Instant::now();
    let world = cpu.install(|| World::build(scene, args.accel.kind))?;
    let build_time = begun.elapsed();

    let (rendering, seconds) = render(args, &world, &settings, &cpu, &stop)?;
    if rendering.film.done() == 0.0 {
        return Ok(nothing_kept(&talk));
    }
    write(args, format, &rendering, &settings, hash, seconds)?;

    let statistics = Statistics {
        scene: &args.scene,
        output: args.output.to_string_lossy(),
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
        load_seconds: load_time.as_secs_f64(),
        build_seconds: build_time.as_secs_f64(),
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
    if settings.integrator == IntegratorKind::Raster
        && let Some(notice) = notice(&camera)
    {
        let talk = Talk { quiet: args.quiet };
        talk.say(&format!("{}: {notice}", args.scene));
    }
    let display = Display::unless(args.quiet);
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

pub(super) fn load(args: &RenderArgs) -> anyhow::Result<Loaded> {
    let options = LoadOptions {
        up: args.up.map(up),
        triangle_test: args.triangle_test,
        ..LoadOptions::default()
    };
    Ok(ombra::load(&args.scene, &options)?)
}

pub(super) fn settings(args: &RenderArgs, picture: Picture) -> Settings {
    let scenes = picture.settings(Settings {
        width: SIZE.width,
        height: SIZE.height,
        spp: SPP,
        ..Settings::default()
    });
    let Size { width, height } = args.size.unwrap_or(Size {
        width: scenes.width,
        height: scenes.height,
    });
    Settings {
        width,
        height,
        spp: args.spp.unwrap_or(scenes.spp),
        max_depth: args.max_depth.unwrap_or(scenes.max_depth),
        seed: args.seed,
        crop: args.crop,
        integrator: args.integrator,
        ..scenes
    }
}

fn nothing_kept(talk: &Talk) -> ExitCode {
    talk.say("interrupted before there was anything to keep; nothing written");
    ExitCode::from(interrupt::EXIT_CODE)
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
    if statistics.rays == 0 && statistics.integrator == IntegratorKind::Raster.name() {
        return format!(
            "{kept}{output} ({width}x{height}, {spp} spp, {} rasterized in {:.2} s, without rays)",
            counted(statistics.primitives, "primitive"),
            statistics.seconds,
        );
    }
    format!(
        "{kept}{} ({width}x{height}, {spp} spp, {} in \"{}\" built in {:.2} s; {} rays in {:.2} s, {})",
        output,
        counted(statistics.primitives, "primitive"),
        statistics.accel,
        statistics.build_seconds,
        statistics.rays,
        statistics.seconds,
        rate(statistics.rays, Duration::from_secs_f64(statistics.seconds)),
    )
}

fn counted(count: usize, word: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {word}{ending}")
}

const fn up(axis: Up) -> Vector3 {
    match axis {
        Up::X => Vector3::X,
        Up::Y => Vector3::Y,
        Up::Z => Vector3::Z,
    }
}
