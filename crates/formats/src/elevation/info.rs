//! What a surface or terrain model holds.

use std::path::Path;

use ombra_city::Finding;
use serde::Serialize;

use super::geo_tags::GeoTags;
use super::pixels::Pixels;
use super::{broken, decoder, parse};
use crate::error::FormatError;
use crate::input::Input;
use crate::limits::Limits;

/// What a surface or terrain model holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ElevationInfo {
    /// "GeoTIFF".
    pub format: &'static str,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// "32-bit floating-point numbers".
    pub sample: String,
    /// "Deflate", "LZW", "PackBits" or "none".
    pub compression: String,
    /// How many images the file has besides: most often smaller ones of the same.
    pub more_images: u64,
    /// The coordinate reference system, if the file names one by its code.
    pub crs: Option<String>,
    /// The width and the height of a pixel in metres on the ground, if there is a reference system.
    pub pixel: Option<[f64; 2]>,
    /// Metres from west to east and from south to north, if there is a reference system.
    pub extent: Option<[f64; 2]>,
    /// Longitude and latitude, in degrees, of its middle, if there is a reference system.
    pub origin: Option<[f64; 2]>,
    /// The lowest and the highest height, metres, if there is a reference system.
    pub heights: Option<[f32; 2]>,
    /// How many pixels have no height, if there is a reference system.
    pub blank: Option<u64>,
    /// What its user should hear of.
    pub findings: Vec<Finding>,
}

/// Reads what a surface or terrain model holds: as a whole if it names its reference system, its head
/// otherwise.
pub(crate) fn elevation_info(path: &Path) -> Result<ElevationInfo, FormatError> {
    let read = || {
        let limits = Limits::default();
        let bytes = Input::on_disk(path).source(&limits)?.rest()?;
        let mut decoder = decoder(&bytes)?;
        let pixels = Pixels::of(&mut decoder, bytes.len() as u64, &limits)?;
        let tags = GeoTags::read(&mut decoder)?;
        let mut info = ElevationInfo {
            format: "GeoTIFF",
            width: pixels.size[0],
            height: pixels.size[1],
            sample: pixels.sample,
            compression: pixels.compression,
            more_images: 0,
            crs: None,
            pixel: None,
            extent: None,
            origin: None,
            heights: None,
            blank: None,
            findings: Vec::new(),
        };
        while decoder.more_images() {
            decoder.next_image().map_err(broken)?;
            info.more_images += 1;
        }
        match tags.crs() {
            Ok(_) => info.look_at(&bytes, &limits)?,
            Err(error) => info.findings.push(Finding {
                place: "file".to_owned(),
                message: error.to_string(),
                count: 1,
            }),
        }
        Ok(info)
    };
    read().map_err(|error: FormatError| error.in_file(path))
}

impl ElevationInfo {
    fn look_at(&mut self, bytes: &[u8], limits: &Limits) -> Result<(), FormatError> {
        let elevation = parse(bytes, None, limits)?;
        let field = &elevation.field;
        let city = |error| FormatError::file(crate::error::Fault::City(error));
        let origin = field.origin().map_err(city)?;
        let extent = field.extent(&origin);
        let [width, height] = [self.width, self.height].map(|n| f64::from(n.max(2) - 1));
        // From middle to middle along a row and a column: turned rasters, too, have their own pixels.
        let at = |pixel| origin.to_local(field.on_map(pixel));
        let along = |to: [f64; 2], count: f64| to[0].hypot(to[1]) / count;
        let [a, b, c] = [
            at([0, 0]),
            at([self.width - 1, 0]),
            at([0, self.height - 1]),
        ];
        self.crs = Some(field.crs().name().to_owned());
        self.pixel = Some([
            along([b[0] - a[0], b[1] - a[1]], width),
            along([c[0] - a[0], c[1] - a[1]], height),
        ]);
        self.extent = Some([0, 1].map(|k| extent.high[k] - extent.low[k]));
        self.origin = Some([origin.longitude(), origin.latitude()]);
        self.heights = Some(field.range());
        self.blank = Some(field.blank());
        self.findings.extend(elevation.findings);
        Ok(())
    }
}
