//! From the coordinates of a map to local metres, and back: the one place where that happens.

use std::fmt;
use std::sync::Arc;

use proj4rs::Proj;
use proj4rs::adaptors::transform_xy;

use crate::crs::Crs;
use crate::error::CityError;

/// Where on Earth the local metres of a city begin.
///
/// Local metres are those of a transverse Mercator projection of scale 1 that touches the Earth
/// (WGS 84) at the origin: x is east, y is **true** north there, and one metre is one metre on the
/// ground: within 1 in 100,000 up to 28 km from the origin's meridian. The metres of the map's own
/// projection are not used: those of Web Mercator are too long by half at 48° of latitude, and the
/// north of a grid is not the north that the sun knows.
#[derive(Clone)]
pub struct Origin {
    crs: Crs,
    local: Arc<Proj>,
    longitude: f64,
    latitude: f64,
}

impl Origin {
    /// An origin at `centre`, in the coordinates of the map.
    ///
    /// # Errors
    /// When `centre` lies outside of what the reference system can express.
    pub fn new(crs: Crs, centre: [f64; 2]) -> Result<Self, CityError> {
        let outside = || outside_of(&crs, centre);
        let geographic = Crs::wgs84();
        let [longitude, latitude] =
            transformed(&crs.proj, &geographic.proj, centre).ok_or_else(outside)?;
        if !(longitude.abs() <= 180.0 && latitude.abs() <= 90.0) {
            return Err(outside());
        }
        let definition = format!(
            "+proj=tmerc +lat_0={latitude:.12} +lon_0={longitude:.12} +k=1 +x_0=0 +y_0=0 \
             +datum=WGS84 +units=m +no_defs"
        );
        let local = Proj::from_proj_string(&definition).map_err(|_| outside())?;
        let origin = Self {
            crs,
            local: Arc::new(local),
            longitude,
            latitude,
        };
        // Far outside of its map a projection gives numbers that mean nothing: no way leads back.
        let back = origin.to_map([0.0, 0.0]);
        let leads_back =
            (0..2).all(|i| (back[i] - centre[i]).abs() <= 1e-6 * centre[i].abs() + 1.0);
        if !origin.crs.is_geographic() && !leads_back {
            return Err(outside_of(&origin.crs, centre));
        }
        Ok(origin)
    }

    /// Metres east and north of the origin. NaN where the map has no such place.
    #[must_use]
    pub fn to_local(&self, map: [f64; 2]) -> [f64; 2] {
        transformed(&self.crs.proj, &self.local, map).unwrap_or([f64::NAN; 2])
    }

    /// The coordinates on the map of a place `local` metres east and north of the origin. NaN where
    /// the map cannot show it.
    #[must_use]
    pub fn to_map(&self, local: [f64; 2]) -> [f64; 2] {
        transformed(&self.local, &self.crs.proj, local).unwrap_or([f64::NAN; 2])
    }

    /// The same origin for the coordinates of another map. Places that it cannot show are NaN.
    #[must_use]
    pub fn on_map(&self, crs: Crs) -> Self {
        Self {
            crs,
            ..self.clone()
        }
    }

    /// Longitude and latitude (WGS 84, degrees) of a place `local` metres east and north of the origin.
    #[must_use]
    pub fn to_geographic(&self, local: [f64; 2]) -> [f64; 2] {
        transformed(&self.local, &Crs::wgs84().proj, local).unwrap_or([f64::NAN; 2])
    }

    /// The map's reference system.
    #[must_use]
    pub fn crs(&self) -> &Crs {
        &self.crs
    }

    /// Degrees east of Greenwich (WGS 84), −180 to 180.
    #[must_use]
    pub fn longitude(&self) -> f64 {
        self.longitude
    }

    /// Degrees north of the equator (WGS 84), −90 to 90.
    #[must_use]
    pub fn latitude(&self) -> f64 {
        self.latitude
    }
}

impl fmt::Debug for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Origin")
            .field("crs", &self.crs)
            .field("longitude", &self.longitude)
            .field("latitude", &self.latitude)
            .finish()
    }
}

fn outside_of(crs: &Crs, [x, y]: [f64; 2]) -> CityError {
    let crs = crs.name().to_owned();
    CityError::OutsideCrs { x, y, crs }
}

/// `None` where either system cannot express the place.
fn transformed(from: &Proj, to: &Proj, place: [f64; 2]) -> Option<[f64; 2]> {
    let mut place = place;
    if from.is_latlong() {
        // Beyond the poles there is nothing, though some projections reckon on.
        if !(place[0].abs() <= 360.0 && place[1].abs() <= 90.0) {
            return None;
        }
        place = place.map(f64::to_radians);
    }
    let (x, y) = transform_xy(from, to, place[0], place[1]).ok()?;
    let place = if to.is_latlong() {
        [x.to_degrees(), y.to_degrees()]
    } else {
        [x, y]
    };
    place.iter().all(|x| x.is_finite()).then_some(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Metres of one degree of longitude and of latitude on WGS 84.
    fn degrees_in_metres(latitude: f64) -> [f64; 2] {
        let (a, e2) = (6_378_137.0, 0.006_694_379_990_14);
        let (sin, cos) = latitude.to_radians().sin_cos();
        let w2: f64 = 1.0 - e2 * sin * sin;
        let east = a * cos / w2.sqrt();
        let north = a * (1.0 - e2) / w2.powf(1.5);
        [east.to_radians(), north.to_radians()]
    }

    fn near(found: [f64; 2], expected: [f64; 2], tolerance: f64) {
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() <= tolerance, "{found:?}, not {expected:?}");
        }
    }

    #[test]
    fn a_degree_has_its_length_on_the_ellipsoid() {
        for latitude in [-54.8, -0.01, 0.0, 40.7, 69.6] {
            let origin = Origin::new(Crs::wgs84(), [-74.0, latitude]).unwrap();
            let [east, north] = degrees_in_metres(latitude);
            let step = 0.001;
            near(
                origin.to_local([-74.0 + step, latitude]),
                [east * step, 0.0],
                1e-3,
            );
            near(
                origin.to_local([-74.0, latitude + step]),
                [0.0, north * step],
                1e-3,
            );
        }
    }

    #[test]
    fn the_way_back_leads_to_the_same_place() {
        for (crs, centre) in [
            (Crs::wgs84(), [-74.0, 40.7]),
            (Crs::from_epsg(28992).unwrap(), [84_800.0, 447_600.0]),
            (Crs::from_epsg(3857).unwrap(), [-8_237_642.0, 4_970_241.0]),
            (Crs::from_epsg(2263).unwrap(), [980_000.0, 195_000.0]),
            (Crs::from_epsg(2100).unwrap(), [476_000.0, 4_204_000.0]),
        ] {
            let origin = Origin::new(crs, centre).unwrap();
            near(origin.to_local(centre), [0.0, 0.0], 1e-4);
            let local = [700.0, -1300.0];
            // Shifts between datums change heights as well, which are let go: millimetres.
            near(origin.to_local(origin.to_map(local)), local, 3e-3);
        }
    }

    /// Delft by the series of Schreutelkamp and Strang van Hees (Geodesia 2001, number 2).
    #[test]
    fn known_places_are_where_they_are() {
        let delft = Origin::new(Crs::from_epsg(7415).unwrap(), [84_615.0, 447_423.0]).unwrap();
        near(
            [delft.longitude(), delft.latitude()],
            [4.36199, 52.01070],
            2e-5,
        );
        let web = Origin::new(
            Crs::from_epsg(3857).unwrap(),
            [-8_237_642.318, 4_970_241.327],
        )
        .unwrap();
        near([web.longitude(), web.latitude()], [-74.0, 40.713956], 1e-6);
        // One metre of Web Mercator is cos 40.7° of a metre there.
        let [x, _] = web.to_local([-8_237_542.318, 4_970_241.327]);
        assert!((x - 75.9).abs() < 0.2, "{x}");
    }

    #[test]
    fn north_is_true_north_and_not_that_of_the_grid() {
        // Far west of its central meridian (5.39° E), the Dutch grid leans by 0.8°.
        let origin = Origin::new(Crs::from_epsg(28992).unwrap(), [84_600.0, 447_400.0]).unwrap();
        let [x, y] = origin.to_local([84_600.0, 448_400.0]);
        let lean = x.atan2(y).to_degrees();
        assert!((lean.abs() - 0.81).abs() < 0.05, "{lean}");
        let scale = x.hypot(y) / 1000.0;
        assert!((scale - 1.0).abs() < 2e-4, "{scale}");
    }

    #[test]
    fn places_that_are_not_on_the_map_are_told() {
        assert!(Origin::new(Crs::wgs84(), [84_600.0, 447_400.0]).is_err());
        assert!(Origin::new(Crs::wgs84(), [f64::NAN, 0.0]).is_err());
        let dutch = Crs::from_epsg(28992).unwrap();
        assert!(Origin::new(dutch, [90_000.0, 1e300]).is_err());
        let origin = Origin::new(Crs::wgs84(), [0.0, 51.0]).unwrap();
        assert!(origin.to_local([0.0, 91.0])[0].is_nan());
        assert!(origin.to_local([f64::INFINITY, 0.0])[0].is_nan());
    }
}
