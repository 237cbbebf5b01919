//! What further outputs may be asked for.

use std::path::{Path, PathBuf};

use clap::Args;
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
}

impl ProductsArgs {
    /// What is written as one file.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        self.contours.as_deref().into_iter()
    }
}

fn geojson(text: &str) -> Result<PathBuf, String> {
    ends_in(text, &GEOJSON)
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
