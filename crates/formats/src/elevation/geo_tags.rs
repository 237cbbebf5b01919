//! Where pixels are on a map, and what the map's coordinates mean (OGC 19-008r4).

use std::io::Cursor;

use ombra_city::Crs;
use ombra_city::heights::FOOT;
use tiff::decoder::Decoder;
use tiff::tags::Tag;

use super::{broken, wrong};
use crate::error::{Fault, FormatError, shown};

/// Keys.
const MODEL_TYPE: u16 = 1024;
const RASTER_TYPE: u16 = 1025;
const CITATION: u16 = 1026;
const GEODETIC_CRS: u16 = 2048;
const PROJECTED_CRS: u16 = 3072;
const PROJECTED_CITATION: u16 = 3073;
const VERTICAL_UNITS: u16 = 4099;

/// Values of keys.
const PROJECTED: u16 = 1;
const GEOGRAPHIC: u16 = 2;
const POINT: u16 = 2;
const USER_DEFINED: u16 = 32767;

/// Where the texts of keys lie.
const TEXTS: u16 = 34737;

/// The metres of a foot of the US survey.
const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

/// What the tags of GeoTIFF say.
#[derive(Clone, Debug, Default)]
pub(super) struct GeoTags {
    scale: Vec<f64>,
    tie_points: Vec<f64>,
    transformation: Vec<f64>,
    keys: Vec<[u16; 4]>,
    texts: String,
}

impl GeoTags {
    pub(super) fn read(decoder: &mut Decoder<Cursor<&[u8]>>) -> Result<Self, FormatError> {
        let mut doubles = |tag| match decoder.find_tag(tag).map_err(broken)? {
            Some(value) => value.into_f64_vec().map_err(broken),
            None => Ok(Vec::new()),
        };
        let scale = doubles(Tag::ModelPixelScaleTag)?;
        let tie_points = doubles(Tag::ModelTiepointTag)?;
        let transformation = doubles(Tag::ModelTransformationTag)?;
        let keys = match decoder.find_tag(Tag::GeoKeyDirectoryTag).map_err(broken)? {
            Some(value) => value.into_u16_vec().map_err(broken)?,
            None => Vec::new(),
        };
        let texts = decoder.get_tag_ascii_string(Tag::GeoAsciiParamsTag);
        // The first four numbers are versions and a count.
        let (keys, _) = keys.get(4..).unwrap_or_default().as_chunks::<4>();
        Ok(Self {
            scale,
            tie_points,
            transformation,
            keys: keys.to_vec(),
            texts: texts.unwrap_or_default(),
        })
    }

    /// The numbers that lead from a pixel to its middle on the map, see
    /// [`HeightField::new`](ombra_city::HeightField::new).
    pub(super) fn map_from_pixel(&self) -> Result<[f64; 6], FormatError> {
        let [a, b, c, d, e, f] = match (
            &self.transformation[..],
            &self.scale[..],
            &self.tie_points[..],
        ) {
            (&[a, b, _, c, d, e, _, f, ..], ..) => [a, b, c, d, e, f],
            (_, &[x, y, ..], &[column, row, _, east, north, _]) => {
                [x, 0.0, east - column * x, 0.0, -y, north + row * y]
            }
            (_, [], [_, _, _, _, _, _, _, ..]) => {
                return Err(wrong(
                    "has points on the map but no scale: straighten it first, as gdalwarp does",
                ));
            }
            _ => {
                return Err(wrong(
                    "does not say where on the map its pixels are; ModelPixelScale with one \
                     ModelTiepoint, or ModelTransformation is needed",
                ));
            }
        };
        // Of a pixel that is an area the corner has whole numbers, of a point the middle.
        let half = if self.value(RASTER_TYPE) == Some(POINT) {
            0.0
        } else {
            0.5
        };
        Ok([a, b, c + half * (a + b), d, e, f + half * (d + e)])
    }

    /// What the coordinates mean.
    pub(super) fn crs(&self) -> Result<Crs, FormatError> {
        let code = match self.value(MODEL_TYPE) {
            Some(GEOGRAPHIC) => self.value(GEODETIC_CRS),
            Some(PROJECTED) | None => self.value(PROJECTED_CRS).or(self.value(GEODETIC_CRS)),
            Some(_) => None,
        };
        match code {
            Some(code) if code != USER_DEFINED && code > 0 => {
                Crs::from_epsg(code.into()).map_err(|error| FormatError::file(Fault::City(error)))
            }
            _ => Err(wrong(format!(
                "names no coordinate reference system by its EPSG code{}; name that of the file",
                self.named()
            ))),
        }
    }

    /// The words for the system, for messages.
    fn named(&self) -> String {
        let text = [PROJECTED_CITATION, CITATION].into_iter().find_map(|key| {
            let &[_, at, length, from] = self.keys.iter().find(|entry| entry[0] == key)?;
            let (from, length) = (usize::from(from), usize::from(length));
            (at == TEXTS).then(|| self.texts.get(from..from + length))?
        });
        text.map_or_else(String::new, |text| {
            format!(" (it says {:?})", shown(text.trim_end_matches(['|', '\0'])))
        })
    }

    /// How many metres one unit of height is, if the file says so.
    pub(super) fn metres_of_height(&self) -> Option<f64> {
        match self.value(VERTICAL_UNITS)? {
            9001 => Some(1.0),
            9002 => Some(FOOT),
            9003 => Some(SURVEY_FOOT),
            _ => None,
        }
    }

    /// The value of a key that is a number itself.
    fn value(&self, key: u16) -> Option<u16> {
        let entry = self.keys.iter().find(|entry| entry[0] == key)?;
        (entry[1] == 0).then_some(entry[3])
    }
}
