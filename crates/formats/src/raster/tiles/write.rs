//! Tiles as files.

use std::fs;
use std::io;
use std::path::Path;

use ombra_city::Origin;
use png::ColorType;
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::TileSet;
use super::mercator::{SIDE, Tile, to_degrees};
use super::sample::Sampler;
use crate::error::FormatError;
use crate::image::{png_bytes, write_error};
use crate::raster::map::Shades;
use crate::raster::{Raster, Scale};
use crate::whole_folder::{Kind, WholeFolder};

const KIND: Kind = Kind {
    what: "tiles",
    marker: "tiles.json",
    is_own: |name| name.parse::<u8>().is_ok_and(|zoom| zoom <= super::LARGEST),
};

impl TileSet {
    /// Whether [`write`](Self::write) could write there now, for whoever has long to work before it does.
    ///
    /// # Errors
    /// When there is something that is no folder of tiles by ombra, or the folder above it is not there or cannot be written into.
    pub fn can_write(folder: impl AsRef<Path>) -> Result<(), FormatError> {
        WholeFolder::create(folder.as_ref(), KIND).map(drop)
    }

    /// Writes the tiles of a raster, and `tiles.json` (TileJSON 3.0.0) beside them: `name` is for people, `metadata` say how the
    /// numbers came about. Tiles that were there give way. Minutes that do not fit into two bytes are left out: there are pictures only then.
    ///
    /// # Errors
    /// As for [`can_write`](Self::can_write), and when a file cannot be written; what was there before is still there then.
    pub fn write(
        &self,
        folder: impl AsRef<Path>,
        raster: &Raster<'_>,
        shades: &Shades,
        name: &str,
        metadata: &[(String, String)],
    ) -> Result<(), FormatError> {
        let folder = WholeFolder::create(folder.as_ref(), KIND)?;
        let path = folder.path();
        let numbers = Numbers::of(raster, shades.scale());
        let sampler = Sampler::new(raster);
        for zoom in self.zooms[0]..=self.zooms[1] {
            let tiles = self.tiles(zoom);
            for tile in &tiles {
                let column = path.join(zoom.to_string()).join(tile.at[0].to_string());
                fs::create_dir_all(column).map_err(write_error)?;
            }
            let write = |tile: &Tile| -> Result<(), FormatError> {
                let file =
                    |ending| path.join(format!("{zoom}/{}/{}.{ending}", tile.at[0], tile.at[1]));
                let minutes = sampler.minutes(*tile);
                fs::write(file("png"), picture(&minutes, shades)?).map_err(write_error)?;
                numbers.map_or(Ok(()), |numbers| {
                    fs::write(file("bin"), numbers.bytes(&minutes)).map_err(write_error)
                })
            };
            tiles.par_iter().try_for_each(write)?;
        }
        let about = self.about(raster.origin(), shades, numbers, name, metadata);
        let text = serde_json::to_vec_pretty(&about)
            .map_err(io::Error::from)
            .map_err(write_error)?;
        fs::write(path.join(KIND.marker), text).map_err(write_error)?;
        folder.finish()
    }

    /// As TileJSON.
    fn about(
        &self,
        origin: &Origin,
        shades: &Shades,
        numbers: Option<Numbers>,
        name: &str,
        metadata: &[(String, String)],
    ) -> Value {
        let [north_west, south_east] = self.bounds.map(to_degrees);
        let said = metadata
            .iter()
            .map(|(name, value)| (name.clone(), json!(value)));
        let mut about = json!({
            "tilejson": "3.0.0",
            "generator": concat!("ombra ", env!("CARGO_PKG_VERSION")),
            "name": name,
            "scheme": "xyz",
            "tiles": ["{z}/{x}/{y}.png"],
            "minzoom": self.zooms[0],
            "maxzoom": self.zooms[1],
            "bounds": [north_west[0], south_east[1], south_east[0], north_west[1]],
            "center": [origin.longitude(), origin.latitude(), self.zooms[0]],
            "legend": legend(shades),
            "ombra": Value::Object(said.collect::<Map<_, _>>()),
        });
        if let Some(Numbers { none }) = numbers {
            about["numbers"] = json!({
                "tiles": ["{z}/{x}/{y}.bin"],
                "unit": "minutes",
                "type": "int16",
                "byte_order": "little",
                "width": SIDE,
                "height": SIDE,
                "none": none,
            });
        }
        about
    }
}

/// Minutes, and their colours as web pages have them.
fn legend(shades: &Shades) -> Vec<Value> {
    const STEPS: i32 = 8;
    let first = match shades.scale() {
        Scale::Change => -STEPS,
        _ => 0,
    };
    let steps = (first..=STEPS).map(|step| shades.top() * step as f32 / STEPS as f32);
    let shown = steps.map(|minutes| {
        let [r, g, b] = shades.colour(minutes);
        json!([minutes, format!("#{r:02x}{g:02x}{b:02x}")])
    });
    shown.collect()
}

/// How minutes are written in two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Numbers {
    /// What says that there is none.
    none: i16,
}

impl Numbers {
    /// `None` if they do not fit.
    fn of(raster: &Raster<'_>, scale: Scale) -> Option<Self> {
        let none = if scale == Scale::Change { i16::MIN } else { -1 };
        let most = f32::from(i16::MAX) / raster.unit().minutes();
        let known = raster.values().iter().filter(|value| !value.is_nan());
        known
            .clone()
            .all(|value| value.abs() <= most)
            .then_some(Self { none })
    }

    fn bytes(self, minutes: &[f32]) -> Vec<u8> {
        let number = |&minutes: &f32| {
            if minutes.is_nan() {
                self.none
            } else {
                minutes.round() as i16
            }
        };
        minutes
            .iter()
            .flat_map(|minutes| number(minutes).to_le_bytes())
            .collect()
    }
}

/// Transparent where there is no number.
fn picture(minutes: &[f32], shades: &Shades) -> Result<Vec<u8>, FormatError> {
    let pixel = |&minutes: &f32| {
        if minutes.is_nan() {
            return [0; 4];
        }
        let [r, g, b] = shades.colour(minutes);
        [r, g, b, u8::MAX]
    };
    let pixels: Vec<u8> = minutes.iter().flat_map(pixel).collect();
    png_bytes([SIDE; 2], ColorType::Rgba, &pixels)
}
