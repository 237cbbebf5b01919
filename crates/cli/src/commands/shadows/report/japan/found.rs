//! The hours of shadow of the proposed buildings alone, on a level plane.

use ombra::accrual::{Exact, Occluders, Tiles};
use ombra::city::{Building, City, Extent, Facet, Grid, Inside, line_around};
use ombra::formats::contour::{ContourLine, contour_lines};
use ombra::geometry::Point3;
use ombra::sun::Instant;
use serde_json::{Value, json};

use super::super::super::bound::extent;
use super::super::super::wrong_usage;
use super::super::map::outline;
use super::super::study::Study;
use super::ground::average_ground;
use super::limits;
use super::zones::{Zone, along, to_sides};

/// Seconds between the instants at which it is looked at how far shadow reaches.
const LOOK: f64 = 600.0;

/// The map goes on so far around the site, metres.
const BESIDE: f64 = 15.0;

/// What came out.
pub(super) struct Found {
    /// The average ground: z in local metres.
    pub(super) ground: f64,
    pub(super) grid: Grid,
    /// Hours of shadow, a cell each; NaN within the buildings.
    pub(super) hours: Vec<f32>,
    /// Lines of equal time.
    pub(super) contours: Vec<ContourLine>,
    /// The lines of both zones.
    pub(super) lines: [Vec<Vec<[f64; 2]>>; 2],
    most: [Option<Most>; 2],
    /// Whether any of the proposed buildings reaches above the plane.
    is_above: bool,
}

/// The most shadow of a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Most {
    pub(super) seconds: f64,
    /// Metres east and north of the origin.
    pub(super) at: [f64; 2],
    /// Metres from the boundary of the site.
    pub(super) distance: f64,
}

impl Found {
    /// `None` if it was interrupted.
    pub(super) fn measure(study: &Study<'_>, height: f64) -> Option<Self> {
        let site = &study.resources[0].area;
        let proposed: Vec<Building> = study.new_buildings().cloned().collect();
        let ground = average_ground(&study.before, &proposed);
        let plane = ground + height;
        let alone = City {
            origin: study.before.origin.clone(),
            buildings: proposed,
            terrain: Vec::new(),
            is_terrain_all: false,
            context: Vec::new(),
            // Places on the ground lie on the plane.
            ground: plane as f32,
            findings: Vec::new(),
        };
        let facets = alone.facets();
        let reached = reached(study, &facets, plane);
        let [low, high] = site.within.bounds();
        let around = Extent { low, high }.widened(BESIDE);
        let within = reached.with(around.low).with(around.high);
        let grid = Grid::within(within.low, within.high, study.args.places.cell);
        let grid = grid.unwrap_or_else(|error| wrong_usage(&format!("--cell: {error}")));
        let (tiles, occluders) = study.cpu().install(|| {
            let tiles = Tiles::on_ground(&alone, &grid, |_| true);
            (tiles, Occluders::new(&facets))
        });
        let sheets = study.sheets(&study.when.spans);
        let exact = study.cpu().install(|| Exact::new(&occluders, &sheets));
        let lines = Zone::BOTH.map(|zone| line_around(&site.polygons, zone.begins()));
        let mut found = Self {
            ground,
            hours: vec![f32::NAN; grid.count()],
            grid,
            contours: Vec::new(),
            lines,
            most: [None; 2],
            is_above: (facets.iter().flat_map(|facet| facet.corners))
                .any(|corner| f64::from(corner.z) > plane),
        };
        let mut progress = study.progress(tiles.places().len());
        let all = study.seconds(&exact, &tiles, &mut progress)?;
        drop(progress);
        let places = tiles.places().iter().zip(tiles.indices());
        for ((at, &index), seconds) in places.zip(all) {
            found.hours[index as usize] = (seconds / 3600.0) as f32;
            let at = [at.x, at.y].map(f64::from);
            if seconds > 0.0 && !site.within.contains(at) {
                let distance = to_sides(&site.polygons, at);
                if let Some(zone) = Zone::of(distance) {
                    found.see(
                        zone,
                        Most {
                            seconds,
                            at,
                            distance,
                        },
                    );
                }
            }
        }
        found.see_lines(study, &alone, &exact, plane);
        found.contours = contour_lines(&found.grid, &found.hours, &levels(study));
        Some(found)
    }

    fn see(&mut self, zone: Zone, seen: Most) {
        let most = &mut self.most[zone as usize];
        if most.is_none_or(|most| seen.seconds > most.seconds) {
            *most = Some(seen);
        }
    }

    /// On the lines themselves, where there is most as a rule.
    fn see_lines(&mut self, study: &Study<'_>, alone: &City, exact: &Exact<'_>, plane: f64) {
        let inside = Inside::new(alone);
        for zone in Zone::BOTH {
            let places = along(&self.lines[zone as usize], 0.5 * self.grid.cell);
            let places = places
                .into_iter()
                .map(|[x, y]| Point3::new(x as f32, y as f32, plane as f32));
            let free: Vec<Point3> = places.filter(|&place| !inside.contains(place)).collect();
            let seconds = study.cpu().install(|| exact.seconds(&free));
            for (place, seconds) in free.iter().zip(seconds).filter(|own| own.1 > 0.0) {
                let at = [place.x, place.y].map(f64::from);
                let distance = zone.begins();
                self.see(
                    zone,
                    Most {
                        seconds,
                        at,
                        distance,
                    },
                );
            }
        }
    }

    pub(super) fn most(&self, zone: Zone) -> Option<Most> {
        self.most[zone as usize]
    }

    /// What the grid covers.
    pub(super) fn extent(&self) -> Extent {
        let Grid {
            corner,
            cell,
            width,
            height,
        } = self.grid;
        let [w, h] = [width, height].map(|count| f64::from(count) * cell);
        Extent {
            low: corner,
            high: [corner[0] + w, corner[1] + h],
        }
    }

    pub(super) fn findings(&self, study: &Study<'_>) -> Vec<String> {
        let mut findings = Vec::new();
        if !self.is_above {
            findings.push("no proposed building reaches above the plane of measuring: there is no shadow on it".to_owned());
        }
        let site = &study.resources[0].area;
        let inside =
            |at: &[f64; 2]| site.within.contains(*at) || to_sides(&site.polygons, *at) < 0.01;
        let mut corners = study.new_buildings().flat_map(outline).flatten();
        if !corners.all(|at| inside(&at)) {
            findings.push("a proposed building stands beyond the boundary of the site: are both where they should be?".to_owned());
        }
        let latitude = study.before.origin.latitude();
        if !(20.0..46.0).contains(&latitude) {
            findings.push(format!(
                "latitude {latitude:.2}° is not in Japan; the sun is that of the place all the same"
            ));
        }
        findings
    }

    /// In longitude and latitude.
    pub(super) fn geojson(&self, study: &Study<'_>) -> Value {
        let origin = &study.before.origin;
        let on_map =
            |&point: &[f64; 2]| origin.to_geographic(point).map(|x| (x * 1e8).round() / 1e8);
        let features = self.contours.iter().map(|contour| {
            let coordinates: Vec<[f64; 2]> = contour.points.iter().map(on_map).collect();
            json!({
                "type": "Feature",
                "properties": { "hours": contour.level },
                "geometry": { "type": "LineString", "coordinates": coordinates },
            })
        });
        json!({ "type": "FeatureCollection", "features": features.collect::<Vec<_>>() })
    }
}

/// Around the buildings, and all that their shadow comes to on the plane.
fn reached(study: &Study<'_>, facets: &[Facet], plane: f64) -> Extent {
    let sky = &study.when.suns[0];
    let spans = study.when.spans.iter();
    let instants = spans.flat_map(|span| span.middles(LOOK).1.chain([span.start, span.end]));
    let suns: Vec<[f64; 3]> = instants
        .map(|instant: Instant| sky.direction(instant))
        .collect();
    let above = facets.iter().flat_map(|facet| facet.corners);
    let above = above.filter(|corner| f64::from(corner.z) > plane);
    above.fold(extent(facets), |within, corner| {
        let [x, y, z] = corner.to_array().map(f64::from);
        suns.iter()
            .filter(|sun| sun[2] > 0.0)
            .fold(within, |within, sun| {
                let far = (z - plane) / sun[2];
                within.with([x - far * sun[0], y - far * sun[1]])
            })
    })
}

/// Every hour, and the limits.
fn levels(study: &Study<'_>) -> Vec<f32> {
    let limits = limits(&study.args.report);
    let hours = (1..study.when.hours().round() as u32).map(f64::from);
    let mut levels: Vec<f64> = hours.chain(limits.map(|limit| limit / 3600.0)).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    levels
        .into_iter()
        .filter(|&level| level > 0.0)
        .map(|level| level as f32)
        .collect()
}
