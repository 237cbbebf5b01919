//! Coordinate reference systems of maps, by their names.

use std::fmt;
use std::sync::Arc;

use proj4rs::Proj;

use crate::error::CityError;

/// The coordinate reference system of a map: what its two numbers mean on the ground.
///
/// Coordinates are east (or longitude) first, north (or latitude) second, whatever order the
/// authority lists them in: that is how GeoJSON, CityJSON and all who write them have it.
/// Geographic coordinates are in degrees.
#[derive(Clone)]
pub struct Crs {
    name: String,
    pub(crate) proj: Arc<Proj>,
}

impl Crs {
    /// WGS 84 longitude and latitude, in degrees.
    #[must_use]
    pub fn wgs84() -> Self {
        Self::from_proj("OGC:CRS84", "+proj=longlat +datum=WGS84 +no_defs")
            .expect("a definition that is known to be right")
    }

    /// By its number in the EPSG registry. Of a compound system (with heights) the horizontal part
    /// counts, and the unit of its heights.
    ///
    /// # Errors
    /// When the number is not known, or its projection is none that can be reckoned here.
    pub fn from_epsg(code: u32) -> Result<Self, CityError> {
        let name = format!("EPSG:{code}");
        let known = u16::try_from(code)
            .ok()
            .and_then(crs_definitions::from_code)
            .ok_or_else(|| unknown(&name, "no such code"))?;
        Self::from_proj(&name, known.proj4)
    }

    /// By any of the names that files and people use: `EPSG:25832` or just `25832`,
    /// `urn:ogc:def:crs:EPSG::25832`, `https://www.opengis.net/def/crs/EPSG/0/25832`, `OGC:CRS84`,
    /// a PROJ string (`+proj=utm +zone=32`), or WKT (1 or 2).
    ///
    /// # Errors
    /// When it is none of these.
    pub fn parse(text: &str) -> Result<Self, CityError> {
        let text = text.trim();
        if text.contains("+proj") {
            return Self::from_proj(text, text);
        }
        if text.contains('[') {
            let proj = proj4wkt::wkt_to_projstring(text)
                .map_err(|error| unknown(text, &error.to_string()))?;
            return Self::from_proj(wkt_name(text), &proj);
        }
        // The words of a name, its URN or its URL; an empty one is a version that is left out.
        let mut words = text.split([':', '/', ',']).filter(|word| !word.is_empty());
        let last = words.next_back().unwrap_or_default();
        let authority_is =
            |name: &str| (text.split([':', '/', ','])).any(|word| word.eq_ignore_ascii_case(name));
        if last.eq_ignore_ascii_case("CRS84") || last.eq_ignore_ascii_case("CRS84h") {
            return Ok(Self::wgs84());
        }
        match last.parse() {
            Ok(code) if authority_is("EPSG") || text == last => Self::from_epsg(code),
            _ => Err(unknown(text, "neither an EPSG code nor CRS84")),
        }
    }

    fn from_proj(name: &str, definition: &str) -> Result<Self, CityError> {
        let proj = Proj::from_proj_string(definition)
            .map_err(|error| unknown(name, &error.to_string()))?;
        if proj.is_geocent() {
            return Err(unknown(
                name,
                "geocentric coordinates are not those of a map",
            ));
        }
        if !proj.has_inverse() && !proj.is_latlong() {
            return Err(unknown(name, "its projection has no way back"));
        }
        Ok(Self {
            name: shortened(name),
            proj: Arc::new(proj),
        })
    }

    /// Its name: `EPSG:25832`, `OGC:CRS84`, the name that WKT gives, or the PROJ string.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether coordinates are degrees of longitude and latitude.
    #[must_use]
    pub fn is_geographic(&self) -> bool {
        self.proj.is_latlong()
    }

    /// How many metres one unit of height is; 1 unless the system says otherwise.
    #[must_use]
    pub fn metres_of_height(&self) -> f64 {
        let metres = self.proj.vto_meter();
        if metres > 0.0 { metres } else { 1.0 }
    }
}

/// Equal by name.
impl PartialEq for Crs {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl fmt::Debug for Crs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Crs({:?})", self.name)
    }
}

impl fmt::Display for Crs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}

fn unknown(name: &str, reason: &str) -> CityError {
    CityError::UnknownCrs {
        name: shortened(name),
        reason: shortened(reason),
    }
}

/// The first quoted text of WKT, which is the system's name.
fn wkt_name(wkt: &str) -> &str {
    wkt.split('"').nth(1).unwrap_or("WKT")
}

fn shortened(text: &str) -> String {
    const MOST: usize = 200;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_system_has_many_names() {
        for name in [
            "EPSG:28992",
            "epsg:28992",
            "28992",
            "urn:ogc:def:crs:EPSG::28992",
            "urn:ogc:def:crs:EPSG:9.8:28992",
            "http://www.opengis.net/def/crs/EPSG/0/28992",
            "https://www.opengis.net/def/crs/EPSG/0/28992",
        ] {
            assert_eq!(Crs::parse(name).unwrap().name(), "EPSG:28992", "{name}");
        }
        for name in ["OGC:CRS84", "CRS84", "urn:ogc:def:crs:OGC:1.3:CRS84"] {
            assert!(Crs::parse(name).unwrap().is_geographic(), "{name}");
        }
        let wkt = crs_definitions::from_code(28992).unwrap().wkt;
        assert_eq!(Crs::parse(wkt).unwrap().name(), "Amersfoort / RD New");
        assert!(
            !Crs::parse("+proj=utm +zone=33 +ellps=WGS84")
                .unwrap()
                .is_geographic()
        );
    }

    #[test]
    fn what_is_no_name_says_so() {
        for name in [
            "",
            "EPSG:",
            "EPSG:99999",
            "EPSG:1",
            "mars",
            "LOCAL:7",
            "+proj=nix",
            "GEOGCS[",
            "70000",
        ] {
            let error = Crs::parse(name).unwrap_err().to_string();
            assert!(error.contains("is not known"), "{name}: {error}");
        }
    }
}
