//! What a comparison found, as numbers and in words.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

use ombra::pipeline::Cpu;
use ombra::render::Settings;
use ombra::render::compare::{ColourAgreement, Comparison, Operations};
use ombra::render::raster::TOLERANCE;
pub(super) use ombra_study::grouped;
use serde::Serialize;

use crate::args::CompareArgs;

/// All numbers: what `--json` prints.
#[derive(Serialize)]
pub(super) struct Report<'a> {
    pub(super) scene: &'a str,
    pub(super) folder: String,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) spp: u32,
    pub(super) seed: u64,
    pub(super) accel: &'static str,
    threads: usize,
    /// How far triangles may be from curved shapes, in pixels, unless that takes too many.
    tessellation_tolerance_pixels: f64,
    pub(super) visibility: Visibility,
    /// Raster against rays with the same local shading.
    pub(super) shading: Colour,
    /// Raster against the whole of Whitted's method.
    pub(super) rays_add: Colour,
    pub(super) seconds: Seconds,
    /// Rays of Whitted's method, of all kinds.
    pub(super) whitted_rays: u64,
    pub(super) resolutions: Vec<Row>,
    pub(super) primitives: Vec<Row>,
}

#[derive(Serialize)]
pub(super) struct Visibility {
    pub(super) pixels: u64,
    pub(super) covered: u64,
    pub(super) same_primitive: u64,
    pub(super) same_object: u64,
    pub(super) share: f64,
    pub(super) differing_on_edges: u64,
    pub(super) differing_elsewhere: u64,
    edges: u64,
    unexplained: Vec<[u32; 2]>,
}

#[derive(Serialize)]
pub(super) struct Colour {
    pixels: u64,
    pub(super) equal: u64,
    pub(super) within_one: u64,
    /// In steps of 1/255.
    pub(super) mean: f64,
    pub(super) largest: u8,
}

#[derive(Serialize)]
pub(super) struct Seconds {
    pub(super) raster: f64,
    pub(super) local: f64,
    pub(super) whitted: f64,
}

/// What both loops cost once.
#[derive(Serialize)]
pub(super) struct Row {
    /// What it was counted on, in words.
    pub(super) what: String,
    width: u32,
    height: u32,
    pub(super) pixels: u64,
    pub(super) primitives: u64,
    pub(super) drawn: u64,
    pub(super) all_coverage_tests: u64,
    pub(super) coverage_tests: u64,
    pub(super) covered: u64,
    nearest: u64,
    pub(super) all_intersection_tests: u64,
    pub(super) intersection_tests: u64,
    pub(super) nodes_visited: u64,
}

impl<'a> Report<'a> {
    pub(super) fn new(
        args: &'a CompareArgs,
        settings: &Settings,
        cpu: &Cpu,
        folder: &Path,
        comparison: &Comparison,
    ) -> Self {
        let extent = settings.extent();
        let seen = &comparison.visibility;
        let seconds = |time: Duration| time.as_secs_f64();
        let rows = comparison.resolutions.iter();
        let grown = comparison.primitives.iter();
        Self {
            scene: &args.scene,
            folder: folder.display().to_string(),
            width: extent.width(),
            height: extent.height(),
            spp: settings.spp,
            seed: settings.seed,
            accel: args.accel.kind.name(),
            threads: cpu.threads(),
            tessellation_tolerance_pixels: TOLERANCE,
            visibility: Visibility {
                pixels: seen.pixels,
                covered: seen.covered,
                same_primitive: seen.same_primitive,
                same_object: seen.same_object,
                share: seen.share(),
                differing_on_edges: seen.differing_on_edges,
                differing_elsewhere: seen.differing_elsewhere,
                edges: seen.edges,
                unexplained: seen.unexplained.clone(),
            },
            shading: Colour::of(&comparison.shading),
            rays_add: Colour::of(&comparison.rays_add),
            seconds: Seconds {
                raster: seconds(comparison.raster.time),
                local: seconds(comparison.local.time),
                whitted: seconds(comparison.whitted.time),
            },
            whitted_rays: comparison.whitted.rendering.rays,
            resolutions: rows
                .map(|row| Row::of(format!("{}x{}", row.size[0], row.size[1]), row))
                .collect(),
            primitives: grown
                .map(|grown| Row::of(grown.scene.clone(), &grown.operations))
                .collect(),
        }
    }

    /// For people, as lines of text.
    pub(super) fn words(&self) -> String {
        let Self {
            visibility: seen,
            shading,
            rays_add,
            seconds,
            ..
        } = self;
        let differing = seen.pixels - seen.same_primitive;
        let mut text = format!(
            "{} at {}x{}, {} spp; rays by {}\n\n",
            self.scene, self.width, self.height, self.spp, self.accel
        );
        let mut line = |what: &str, said: String| {
            let _ = writeln!(text, "{what:<34}{said}");
        };
        line(
            "the same primitive is seen in",
            format!("{} of pixels", percent(seen.same_primitive, seen.pixels)),
        );
        line(
            "the same object in",
            format!("{} of pixels", percent(seen.same_object, seen.pixels)),
        );
        line(
            "another primitive in",
            format!(
                "{} pixels: {} on edges, {} elsewhere",
                grouped(differing),
                grouped(seen.differing_on_edges),
                grouped(seen.differing_elsewhere)
            ),
        );
        line("raster against local shading", shading.words());
        line("raster against whitted", rays_add.words());
        line(
            "seconds",
            format!(
                "raster {:.3}, rays with local shading {:.3}, whitted {:.3}",
                seconds.raster, seconds.local, seconds.whitted
            ),
        );
        text += "\nTests at one sample a pixel, the more pixels:\n";
        table(&mut text, &self.resolutions);
        text += "\nThe more triangles (curved shapes are triangles for both here):\n";
        table(&mut text, &self.primitives);
        text
    }
}

impl Colour {
    fn of(agreement: &ColourAgreement) -> Self {
        let ColourAgreement {
            pixels,
            equal,
            within_one,
            mean,
            largest,
        } = *agreement;
        Self {
            pixels,
            equal,
            within_one,
            mean,
            largest,
        }
    }

    pub(super) fn words(&self) -> String {
        format!(
            "{} of pixels within 1/255; mean {:.3}, largest {} of 255",
            percent(self.within_one, self.pixels),
            self.mean,
            self.largest
        )
    }
}

impl Row {
    fn of(what: String, operations: &Operations) -> Self {
        Self {
            what,
            width: operations.size[0],
            height: operations.size[1],
            pixels: operations.pixels,
            primitives: operations.primitives,
            drawn: operations.drawn,
            all_coverage_tests: operations.all_coverage_tests(),
            coverage_tests: operations.raster.coverage_tests,
            covered: operations.raster.covered,
            nearest: operations.raster.nearest,
            all_intersection_tests: operations.all_intersection_tests(),
            intersection_tests: operations.rays.tests_made,
            nodes_visited: operations.rays.nodes_visited,
        }
    }

    /// The columns of a table after `what`: a title and a number each.
    pub(super) const fn columns(&self) -> [(&'static str, u64); 9] {
        [
            ("pixels", self.pixels),
            ("drawn", self.drawn),
            ("drawn x pixels", self.all_coverage_tests),
            ("coverage tests", self.coverage_tests),
            ("covered", self.covered),
            ("primitives", self.primitives),
            ("primitives x pixels", self.all_intersection_tests),
            ("intersection tests", self.intersection_tests),
            ("nodes visited", self.nodes_visited),
        ]
    }
}

/// Appends rows under their titles, numbers to the right.
fn table(text: &mut String, rows: &[Row]) {
    let Some(first) = rows.first() else {
        return;
    };
    let titles = first.columns().map(|(title, _)| title);
    let cells: Vec<_> = rows
        .iter()
        .map(|row| row.columns().map(|(_, number)| grouped(number)))
        .collect();
    let mut line = |what: &str, cells: &[String]| {
        let _ = write!(text, "{what:<24}");
        for (i, cell) in cells.iter().enumerate() {
            let widest = rows.iter().map(|row| grouped(row.columns()[i].1).len());
            let width = widest.fold(titles[i].len(), usize::max);
            let _ = write!(text, "  {cell:>width$}");
        }
        text.push('\n');
    };
    line("", &titles.map(str::to_owned));
    for (row, cells) in rows.iter().zip(&cells) {
        line(&row.what, cells);
    }
}

/// A share as a percentage that is 100 only where nothing is missing.
pub(super) fn percent(part: u64, whole: u64) -> String {
    if part == whole {
        return "100 %".to_owned();
    }
    let percent = part as f64 / whole as f64 * 100.0;
    format!("{:.3} %", percent.min(99.999))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_is_said_only_of_all() {
        assert_eq!(percent(5, 5), "100 %");
        assert_eq!(percent(9_999_999, 10_000_000), "99.999 %");
        assert_eq!(percent(1, 3), "33.333 %");
        assert_eq!(percent(0, 0), "100 %");
    }
}
