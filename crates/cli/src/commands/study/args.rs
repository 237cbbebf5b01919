//! What may be typed after `ombra study`.

use std::path::{Path, PathBuf};

use clap::Args;
use ombra::geometry::triangle::TriangleTest;
use ombra_study::{LARGEST_SIDE, Settings};

use crate::args::{self, Accel, accel, named};

#[derive(Debug, Args)]
pub(crate) struct StudyArgs {
    /// Scenes: study:hills, study:city, study:stadium, a built-in one's name, a scene file or a model [default:
    /// these three, teapot and card]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,

    /// Where to write a page with plots (.html), or the plot of memory against speed alone (.svg)
    #[arg(short, long, value_name = "OUT", value_parser = output)]
    pub(crate) output: Option<PathBuf>,

    /// The structures, separated by commas; `ombra structures` lists them [default: all]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = accel)]
    pub(crate) accel: Vec<Accel>,

    /// Side of the square picture of primary rays in pixels, or WxH; there are as many rays of each other kind
    /// [default: 160]
    #[arg(long, value_name = "N", value_parser = size)]
    pub(crate) size: Option<[u32; 2]>,

    /// How many times each job is on the clock; 0 compares answers and counts steps only [default: 5]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub(crate) rounds: Option<u32>,

    /// On how many threads, separated by commas, one after the other; 0 means all
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_values_t = [1, 0], value_parser = clap::value_parser!(u32).range(0..=1024))]
    pub(crate) threads: Vec<u32>,

    /// Another seed gives other rays
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,

    /// How rays are tested against triangles
    #[arg(long, value_name = "NAME", default_value_t, value_parser = named(&TriangleTest::ALL, TriangleTest::name, TriangleTest::line))]
    pub(crate) triangle_test: TriangleTest,

    /// Small scenes, few rays, two rounds: done in seconds, to see whether all is well; --size and --rounds still count
    #[arg(long)]
    pub(crate) smoke: bool,

    /// No progress bar, no talk
    #[arg(long)]
    pub(crate) quiet: bool,

    /// The numbers on standard output as JSON, in place of the table
    #[arg(long)]
    pub(crate) json: bool,
}

impl StudyArgs {
    pub(super) fn settings(&self) -> Settings {
        let base = if self.smoke {
            Settings::smoke()
        } else {
            Settings::default()
        };
        let mut kinds = Vec::new();
        for accel in &self.accel {
            if !kinds.contains(&accel.kind) {
                kinds.push(accel.kind);
            }
        }
        Settings {
            kinds: if kinds.is_empty() { base.kinds } else { kinds },
            size: self.size.unwrap_or(base.size),
            rounds: self.rounds.map_or(base.rounds, |rounds| rounds as usize),
            threads: self.threads.iter().map(|&n| n as usize).collect(),
            seed: self.seed,
            triangle_test: self.triangle_test,
            detail: base.detail,
        }
    }
}

/// "N" stands for "NxN".
fn size(text: &str) -> Result<[u32; 2], String> {
    const WANTED: &str = "a whole number from 1 to 2048, or two with an x between them";
    const { assert!(LARGEST_SIDE == 2048) };
    let square = format!("{text}x{text}");
    let both = if text.contains(['x', 'X']) {
        text
    } else {
        &square
    };
    let size = args::size(both).map_err(|_| WANTED)?;
    let sides = [size.width, size.height];
    match sides.iter().all(|&side| side <= LARGEST_SIDE) {
        true => Ok(sides),
        false => Err(WANTED.to_owned()),
    }
}

/// What is written where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Page,
    Drawing,
}

impl Format {
    pub(super) fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        match () {
            () if ending.eq_ignore_ascii_case("html") => Some(Self::Page),
            () if ending.eq_ignore_ascii_case("svg") => Some(Self::Drawing),
            () => None,
        }
    }
}

fn output(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match Format::of(&path) {
        Some(_) => Ok(path),
        None => Err("a file that ends in .html or .svg is wanted".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_is_one_number_or_two() {
        assert_eq!(size("64"), Ok([64, 64]));
        assert_eq!(size("64x48"), Ok([64, 48]));
        for wrong in ["", "0", "2049", "64x", "64x4096", "-1", "a"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_ending_chooses_what_is_written() {
        assert_eq!(Format::of(Path::new("a/b.HTML")), Some(Format::Page));
        assert_eq!(Format::of(Path::new("b.svg")), Some(Format::Drawing));
        assert!(output("b.png").is_err() && output("html").is_err());
    }
}
