//! `ombra compare`: the two loops side by side.

mod page;
mod report;

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::Ordering;

use anyhow::Context as _;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use ombra::formats::{ImageBuffer, Metadata, write_image, write_whole};
use ombra::pipeline::Cpu;
use ombra::render::compare::{Comparison, compare, eight_bits};
use ombra::render::raster::notice;
use ombra::render::{Film, Watch};
use ombra::scene::{Rgb, World};

use super::Talk;
use super::render::{load, settings};
use crate::args::CompareArgs;
use crate::interrupt;
use crate::progress::Display;
use report::Report;

/// The files that are written, in order.
const PICTURES: [&str; 3] = ["raster.png", "whitted.png", "difference.png"];
const PAGE: &str = "index.html";

pub(crate) fn run(args: &CompareArgs) -> anyhow::Result<ExitCode> {
    let talk = Talk { quiet: args.quiet };
    if let Some(alias) = args.accel.alias {
        talk.say(&alias.to_string());
    }
    let wanted = args.as_render();
    let cpu = Cpu::with_threads(args.threads as usize).context("cannot start the threads")?;
    let stop = interrupt::watch(args.quiet)?;
    let loaded = cpu.install(|| load(&wanted))?;
    for finding in &loaded.findings {
        talk.say(&format!("{}: {finding}", args.scene));
    }
    if loaded.scene.objects.is_empty() {
        talk.say(&format!(
            "{}: no objects; there is nothing to see",
            args.scene
        ));
    }
    let settings = settings(&wanted, loaded.picture);
    settings.validate()?;
    let hash = loaded.hash;
    let world = cpu.install(|| World::build(loaded.scene, args.accel.kind))?;
    let camera = ombra::camera(&world, settings.aspect());
    if let Some(notice) = notice(&camera) {
        talk.say(&format!("{}: {notice}", args.scene));
    }
    let folder = Folder::make(folder_of(args))?;
    let display = Display::unless(args.quiet);
    let progress = |progress| display.update(progress);
    let watch = Watch {
        stop: Some(&stop),
        progress: Some(&progress),
        pass: None,
    };
    let compared = compare(&world, &camera, &settings, args.accel.kind, &cpu, &watch);
    display.finish();
    let compared = compared.with_context(|| args.scene.clone())?;
    let Some(comparison) = compared.filter(|_| !stop.load(Ordering::Relaxed)) else {
        talk.say("interrupted; nothing written");
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    let report = Report::new(args, &settings, &cpu, &folder.path, &comparison);
    write(&folder.path, &comparison, &report, hash)?;
    folder.keep();
    let text = if args.json {
        serde_json::to_string_pretty(&report)? + "\n"
    } else {
        report.words()
    };
    io::stdout().write_all(text.as_bytes())?;
    talk.say(&format!(
        "{} in {}",
        [&PICTURES[..], &[PAGE]].concat().join(", "),
        report.folder
    ));
    Ok(ExitCode::SUCCESS)
}

/// What was asked for or, by default, the name of the scene without folder and ending, and
/// "-compared".
fn folder_of(args: &CompareArgs) -> PathBuf {
    args.output.clone().unwrap_or_else(|| {
        let stem = Path::new(&args.scene).file_stem();
        let stem = stem.map_or("scene".into(), |stem| stem.to_string_lossy());
        PathBuf::from(format!("{stem}-compared"))
    })
}

/// The folder to write into: made before the work is done, so that a wrong place is known at once,
/// and taken away again if nothing comes of it.
struct Folder {
    path: PathBuf,
    made: bool,
}

impl Folder {
    fn make(path: PathBuf) -> anyhow::Result<Self> {
        let made = !path.is_dir();
        if made {
            fs::create_dir(&path).with_context(|| {
                format!(
                    "{}: the folder for the results cannot be made",
                    path.display()
                )
            })?;
        }
        Ok(Self { path, made })
    }

    fn keep(mut self) {
        self.made = false;
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.made {
            // Only an empty folder goes; if it is not, something in it is worth more than order.
            let _ = fs::remove_dir(&self.path);
        }
    }
}

fn write(
    folder: &Path,
    comparison: &Comparison,
    report: &Report<'_>,
    hash: String,
) -> anyhow::Result<()> {
    let raster = &comparison.raster.rendering.film;
    let whitted = &comparison.whitted.rendering.film;
    let metadata = Metadata {
        command: None,
        version: Some(concat!("ombra ", env!("CARGO_PKG_VERSION")).to_owned()),
        scene_hash: Some(hash),
        seed: Some(report.seed),
        seconds: None,
    };
    let pictures = [
        raster.display(),
        whitted.display(),
        difference(raster, whitted),
    ];
    let mut urls = Vec::with_capacity(pictures.len());
    for (name, pixels) in PICTURES.iter().zip(pictures) {
        let path = folder.join(name);
        let image = ImageBuffer::new(raster.width(), raster.height(), pixels)?;
        write_image(&path, &image, &metadata)?;
        let bytes = fs::read(&path).with_context(|| path.display().to_string())?;
        urls.push(format!("data:image/png;base64,{}", STANDARD.encode(bytes)));
    }
    let [raster, whitted, difference] = [&urls[0], &urls[1], &urls[2]].map(String::as_str);
    let page = page::html(report, raster, whitted, difference);
    write_whole(folder.join(PAGE), page.as_bytes())?;
    Ok(())
}

/// How far two pictures are apart as they are shown, channel by channel: an eight-bit file of it holds
/// the differences of theirs.
fn difference(one: &Film, other: &Film) -> Vec<Rgb> {
    let (one, other) = (eight_bits(one), eight_bits(other));
    let apart = |(a, b): (&[u8; 3], &[u8; 3])| {
        let steps = [0, 1, 2].map(|k| f32::from(a[k].abs_diff(b[k])) / 255.0);
        Rgb::from_srgb(steps)
    };
    one.iter().zip(&other).map(apart).collect()
}
