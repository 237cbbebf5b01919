//! `ombra minray verify`: anybody's picture, by the contest's rules.

use std::fmt::{self, Display};
use std::io::{self, Write as _};
use std::process::ExitCode;

use anyhow::bail;
use ombra::formats::Limits;
use ombra::formats::minray::{ContestPicture, read_contest_picture};
use serde::Serialize;

use super::{contest, picture};
use crate::args::MinrayVerifyArgs;
use crate::interrupt;

/// How far a component may be off by the contest's rules, of 255.
const TOLERANCE: f32 = 10.0;

/// How many of the pixels that are furthest off are shown.
const SHOWN: usize = 8;

pub(super) fn run(args: &MinrayVerifyArgs) -> anyhow::Result<ExitCode> {
    let found = read_contest_picture(&args.file, &Limits::default())?;
    let contest = contest(&args.scene)?;
    let side = contest.size;
    if (found.width(), found.height()) != (side, side) {
        bail!(
            "{}: the picture is {}x{}, but that of scene {} is {side}x{side}; --scene chooses the scene",
            args.file.display(),
            found.width(),
            found.height(),
            args.scene,
        );
    }
    let Some(expected) = picture(&contest)? else {
        return Ok(ExitCode::from(interrupt::EXIT_CODE));
    };
    let score = Score::of(&args.scene, &expected, &found);
    let mut out = io::stdout().lock();
    if args.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&score)?)?;
    } else {
        write!(out, "{score}")?;
    }
    Ok(if score.accepted {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// How a picture fares: what `--json` prints.
#[derive(Serialize)]
struct Score<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    /// Whether no component is further off than the contest allows.
    accepted: bool,
    /// How far a component may be off, of 255.
    tolerance: f32,
    /// How many pixels have a component that is further off.
    pixels_off: usize,
    largest_difference: f32,
    /// Over all components.
    mean_difference: f64,
    /// The pixels that differ most, the worst first; none that are alike.
    worst: Vec<Off>,
}

/// A pixel that differs.
#[derive(Serialize)]
struct Off {
    /// From the left, from 0.
    x: u32,
    /// From the top, from 0.
    y: u32,
    expected: [f32; 3],
    found: [f32; 3],
    /// Of the component that differs most.
    difference: f32,
}

impl<'a> Score<'a> {
    /// Of two pictures of the same size.
    fn of(scene: &'a str, expected: &ContestPicture, found: &ContestPicture) -> Self {
        let (width, height) = (found.width(), found.height());
        let components = expected.pixels().iter().zip(found.pixels());
        let sum: f64 = components
            .clone()
            .flat_map(|(a, b)| differences(a, b).map(f64::from))
            .sum();
        let mut off: Vec<Off> = (0..)
            .zip(components)
            .map(|(index, (expected, found)): (u32, _)| Off {
                x: index % width,
                y: index / width,
                expected: *expected,
                found: *found,
                difference: differences(expected, found).into_iter().fold(0.0, f32::max),
            })
            .filter(|pixel| pixel.difference > 0.0)
            .collect();
        // A stable sort: of equals the first in the picture comes first.
        off.sort_by(|a, b| b.difference.total_cmp(&a.difference));
        let pixels_off = off.partition_point(|pixel| pixel.difference > TOLERANCE);
        let largest_difference = off.first().map_or(0.0, |pixel| pixel.difference);
        off.truncate(SHOWN);
        Self {
            scene,
            width,
            height,
            accepted: pixels_off == 0,
            tolerance: TOLERANCE,
            pixels_off,
            largest_difference,
            mean_difference: sum / (3.0 * f64::from(width) * f64::from(height)),
            worst: off,
        }
    }
}

fn differences(a: &[f32; 3], b: &[f32; 3]) -> [f32; 3] {
    [0, 1, 2].map(|i| (a[i] - b[i]).abs())
}

impl Display for Score<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            scene,
            width,
            height,
            pixels_off,
            ..
        } = self;
        let pixels = u64::from(*width) * u64::from(*height);
        if self.accepted {
            writeln!(
                f,
                "accepted: scene {scene}, all {pixels} pixels within ±{TOLERANCE}"
            )?;
        } else {
            writeln!(
                f,
                "rejected: scene {scene}, {pixels_off} of {pixels} pixels are more than ±{TOLERANCE} off"
            )?;
        }
        writeln!(
            f,
            "largest difference {}, mean difference {:.3} (of 255)",
            self.largest_difference, self.mean_difference
        )?;
        if !self.worst.is_empty() {
            writeln!(
                f,
                "\n    x    y  expected         found            difference"
            )?;
        }
        for off in &self.worst {
            writeln!(
                f,
                "{:5}{:5}  {}{}{}",
                off.x,
                off.y,
                components(&off.expected),
                components(&off.found),
                off.difference
            )?;
        }
        Ok(())
    }
}

fn components(pixel: &[f32; 3]) -> String {
    let [r, g, b] = pixel;
    format!("{:<17}", format!("{r} {g} {b}"))
}
