//! What further outputs may be asked for.

use std::path::{Path, PathBuf};

use clap::Args;
use ombra::formats::can_write_whole;
use ombra::formats::frames::FrameWriter;
use ombra::formats::raster::TileSet;
use ombra::sun::parse_duration;

use super::super::args::{GEOJSON, ends_in};

/// Further outputs.
#[derive(Clone, Debug, Args)]
pub(crate) struct ProductsArgs {
    /// Where to write lines of equal time in shadow (.geojson)
    #[arg(long, value_name = "OUT", value_parser = geojson, requires = "levels")]
    pub(crate) contours: Option<PathBuf>,

    /// Of how much shadow there are lines, in minutes, or with a unit: 60,120,240 or 1h,2h,4h
    #[arg(long, value_name = "TIMES", value_parser = level, value_delimiter = ',', requires = "contours", allow_hyphen_values = true)]
    pub(crate) levels: Vec<f32>,

    /// Where to write tiles for maps on the web: a folder of {z}/{x}/{y}.png, {y}.bin with the minutes, and tiles.json
    #[arg(long, value_name = "DIR")]
    pub(crate) tiles: Option<PathBuf>,

    /// The largest zoom of the tiles [default: the first one at which a pixel is no wider than a cell, 17 at least]
    #[arg(long, value_name = "ZOOM", requires = "tiles", value_parser = clap::value_parser!(u8).range(0..=22))]
    pub(crate) max_zoom: Option<u8>,

    /// Where to write the shadows of a day, moment by moment: an animation (.gif), or a folder of pictures
    #[arg(long, value_name = "OUT", value_parser = frames)]
    pub(crate) frames: Option<PathBuf>,

    /// How far the moments of --frames are apart, by the clock: 10min, 30s [default: 10min]
    #[arg(long, value_name = "TIME", requires = "frames", value_parser = every)]
    pub(crate) every: Option<f64>,

    /// Where to write the city as a model (.glb): what is measured on carries minutes as a texture
    #[arg(long, value_name = "OUT", value_parser = glb)]
    pub(crate) glb: Option<PathBuf>,
}

impl ProductsArgs {
    /// All that is written.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let all = [&self.contours, &self.tiles, &self.frames, &self.glb];
        all.into_iter().flatten().map(PathBuf::as_path)
    }

    /// Whether all of it could be written now.
    pub(crate) fn can_write(&self) -> anyhow::Result<()> {
        for path in [&self.contours, &self.glb].into_iter().flatten() {
            can_write_whole(path)?;
        }
        if let Some(folder) = &self.tiles {
            TileSet::can_write(folder)?;
        }
        if let Some(path) = &self.frames {
            FrameWriter::create(path)?;
        }
        Ok(())
    }

    /// Seconds between moments.
    pub(crate) fn every(&self) -> f64 {
        self.every.unwrap_or(600.0)
    }
}

fn geojson(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &GEOJSON)
}

fn frames(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("gif") => Err(
            "an animation that ends in .gif is wanted, or a folder without an ending".to_owned(),
        ),
        _ => Ok(path),
    }
}

fn every(text: &str) -> Result<f64, String> {
    match parse_duration(text).map_err(|error| error.to_string())? {
        seconds if (1.0..=86_400.0).contains(&seconds) => Ok(seconds),
        _ => Err("a second to a day is wanted, as 10min or 30s".to_owned()),
    }
}

fn glb(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &["glb"])
}

/// Minutes; of a net change they may be negative.
fn level(text: &str) -> Result<f32, String> {
    let text = text.trim();
    let (sign, size) = match text.strip_prefix('-') {
        Some(size) => (-1.0, size),
        None => (1.0, text),
    };
    let minutes = match size.parse::<f64>() {
        Ok(minutes) => minutes,
        Err(_) => parse_duration(size).map_err(|error| error.to_string())? / 60.0,
    };
    if minutes.is_finite() {
        Ok((sign * minutes) as f32)
    } else {
        Err("minutes are wanted, as 90, 90min or 1.5h".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_minutes_or_has_a_unit() {
        for (text, minutes) in [
            ("60", 60.0),
            ("2h", 120.0),
            ("90min", 90.0),
            ("-1h", -60.0),
            ("0", 0.0),
        ] {
            assert_eq!(level(text), Ok(minutes), "{text}");
        }
        for wrong in ["", "-", "nan", "inf", "long", "1 week"] {
            assert!(level(wrong).is_err(), "{wrong}");
        }
    }
}
