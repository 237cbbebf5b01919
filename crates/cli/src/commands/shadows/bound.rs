//! What bounds the places: an area of the map, or the polygons of a file.

use anyhow::{Context as _, bail};
use ombra::city::{City, Facet, StudyArea};
use ombra::formats::Limits;
use ombra::formats::city::read_area;

use super::places::PlacesArgs;
use super::wrong_usage;
use crate::commands::Talk;

/// Where places may lie.
pub(super) enum Bound {
    Nothing,
    /// From the south-west to the north-east, local metres.
    Box([[f64; 2]; 2]),
    Study(StudyArea),
}

impl Bound {
    pub(super) fn new(
        args: &PlacesArgs,
        city: &City,
        facets: &[Facet],
        talk: &Talk,
    ) -> anyhow::Result<Self> {
        if let Some(area) = args.area {
            return Ok(Self::Box(area_box(area, city)));
        }
        let Some(path) = &args.study else {
            return Ok(Self::Nothing);
        };
        let file = read_area(path, &Limits::default())?;
        for finding in &file.findings {
            talk.say(&format!("{}: {finding}", path.display()));
        }
        let study = StudyArea::new(&city.origin, &file.crs, &file.polygons)
            .with_context(|| path.display().to_string())?;
        let ([low, high], Some([from, to])) = (study.bounds(), extent(facets)) else {
            return Ok(Self::Study(study));
        };
        if (0..2).any(|k| high[k] < from[k] || to[k] < low[k]) {
            bail!(
                "{}: lies outside of the city; its coordinates are taken for those of {}",
                path.display(),
                file.crs
            );
        }
        Ok(Self::Study(study))
    }

    pub(super) fn contains(&self, place: [f64; 2]) -> bool {
        match self {
            Self::Nothing => true,
            Self::Box([low, high]) => (0..2).all(|k| low[k] <= place[k] && place[k] <= high[k]),
            Self::Study(study) => study.contains(place),
        }
    }
}

/// The least box around all that throws shadow, local metres.
pub(super) fn extent(facets: &[Facet]) -> Option<[[f64; 2]; 2]> {
    let corners = facets.iter().flat_map(|facet| facet.corners);
    corners
        .map(|p| [p.x, p.y].map(f64::from))
        .fold(None, |extent, p| {
            let [low, high] = extent.unwrap_or([p, p]);
            Some([
                [0, 1].map(|k| f64::min(low[k], p[k])),
                [0, 1].map(|k| f64::max(high[k], p[k])),
            ])
        })
}

/// The box around an area of the map, whose sides need not be straight here: its corners and the middles of its
/// sides.
fn area_box([west, south, east, north]: [f64; 4], city: &City) -> [[f64; 2]; 2] {
    let (x, y) = (0.5 * (west + east), 0.5 * (south + north));
    let around = [
        [west, south],
        [x, south],
        [east, south],
        [east, y],
        [east, north],
        [x, north],
        [west, north],
        [west, y],
    ];
    let local = around.map(|map| city.origin.to_local(map));
    if local.iter().flatten().any(|x| !x.is_finite()) {
        wrong_usage(&format!(
            "--area: the map of the city has no such place; its coordinates are those of {}",
            city.origin.crs().name()
        ));
    }
    let least = |axis: usize| local.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| {
        local
            .iter()
            .map(|p| p[axis])
            .fold(f64::NEG_INFINITY, f64::max)
    };
    [[least(0), least(1)], [most(0), most(1)]]
}
