//! What bounds the places: an area of the map, or the polygons of a file.

use anyhow::{Context as _, bail};
use ombra::city::{Extent, Facet, Origin, StudyArea};
use ombra::formats::Limits;
use ombra::formats::city::read_area;
use ombra::geometry::Point3;

use super::places::PlacesArgs;
use super::wrong_usage;
use crate::commands::Talk;

/// An area may lie so far beside the city, in metres: farther off there is no shadow worth the name, and the area is
/// a mistake, such as latitude before longitude.
pub(super) const BESIDE: f64 = 5_000.0;

/// Where places may lie.
pub(super) enum Bound {
    Nothing,
    Box(Extent),
    Study(StudyArea),
}

impl Bound {
    /// Of a city that lies within `all`.
    pub(super) fn new(
        args: &PlacesArgs,
        origin: &Origin,
        all: Extent,
        talk: &Talk,
    ) -> anyhow::Result<Self> {
        if let Some(area) = args.area {
            let within = area_box(area, origin);
            if is_apart(within, all.widened(BESIDE)) {
                bail!(
                    "--area: lies outside of the city; its coordinates are taken for those of {} (west, south, east, \
                     north)",
                    origin.crs().name()
                );
            }
            return Ok(Self::Box(within));
        }
        if let Some(margin) = args.margin {
            return Ok(Self::Box(all.widened(margin)));
        }
        let Some(path) = &args.study else {
            return Ok(Self::Nothing);
        };
        let file = read_area(path, &Limits::default())?;
        for finding in &file.findings {
            talk.say(&format!("{}: {finding}", path.display()));
        }
        let study = StudyArea::new(origin, &file.crs, &file.polygons())
            .with_context(|| path.display().to_string())?;
        let [low, high] = study.bounds();
        if is_apart(Extent { low, high }, all) {
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
            Self::Box(Extent { low, high }) => {
                (0..2).all(|k| low[k] <= place[k] && place[k] <= high[k])
            }
            Self::Study(study) => study.contains(place),
        }
    }
}

pub(super) fn is_apart(a: Extent, b: Extent) -> bool {
    (0..2).any(|k| a.high[k] < b.low[k] || b.high[k] < a.low[k])
}

/// Around all that throws shadow.
pub(super) fn extent(facets: &[Facet]) -> Extent {
    let corners = facets.iter().flat_map(|facet| facet.corners);
    let around = |extent: Extent, p: Point3| extent.with([p.x, p.y].map(f64::from));
    corners.fold(Extent::NOWHERE, around)
}

/// The box around an area of the map, whose sides need not be straight here: its corners and the middles of its
/// sides.
fn area_box([west, south, east, north]: [f64; 4], origin: &Origin) -> Extent {
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
    let local = around.map(|map| origin.to_local(map));
    if local.iter().flatten().any(|x| !x.is_finite()) {
        wrong_usage(&format!(
            "--area: the map of the city has no such place; its coordinates are those of {}",
            origin.crs().name()
        ));
    }
    local.into_iter().fold(Extent::NOWHERE, Extent::with)
}
