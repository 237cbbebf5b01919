//! Where shadow is measured: what may be asked, and the places that come of it.

use std::cell::LazyCell;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueEnum};
use ombra::accrual::{Ground, OnFaces, Tiles};
use ombra::city::{City, Crs, Extent, FaceKind, Grid, Inside, Origin};
use ombra::formats::Limits;
use ombra::formats::city::{Point, PointFile, read_points};
use ombra::formats::places::PLACE_COLUMNS;
use ombra::geometry::Point3;

use super::args::{area, cell};
use super::bound::Bound;
use super::wrong_usage;
use crate::commands::Talk;

/// Where.
#[derive(Clone, Debug, Args)]
pub(crate) struct PlacesArgs {
    /// What is measured on: the ground, roofs, or facades
    #[arg(long, value_enum, value_name = "WHAT", default_value_t = On::Ground, conflicts_with = "points")]
    pub(crate) on: On,

    /// How wide a cell of the grid is, or how far places on a face are apart, in metres: 1, 0.5m, 2 m
    #[arg(long, value_name = "METRES", default_value = "1", value_parser = cell, conflicts_with = "points")]
    pub(crate) cell: f64,

    /// Only this part of the map: west, south, east, north in the coordinates of the file; all that stands in the file
    /// throws shadow into it
    #[arg(long, value_name = "W,S,E,N", value_parser = area, allow_hyphen_values = true, conflicts_with_all = ["study", "points"])]
    pub(crate) area: Option<[f64; 4]>,

    /// How far the map of the ground goes beyond what the file holds, in metres: shadow of what stands at its edge falls there
    #[arg(long, value_name = "METRES", value_parser = super::args::metres, conflicts_with_all = ["area", "study", "points"])]
    pub(crate) margin: Option<f64>,

    /// Only within the polygons of this file (GeoJSON); all that stands in the city's file throws shadow into them
    #[arg(long, value_name = "FILE", conflicts_with = "points")]
    pub(crate) study: Option<PathBuf>,

    /// At the points of this file instead: GeoJSON, or a table (CSV) with columns lon and lat, or x and y; z is metres
    /// above the ground
    #[arg(long, value_name = "FILE")]
    pub(crate) points: Option<PathBuf>,
}

/// What is measured on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum On {
    /// A grid over the ground
    Ground,
    /// What faces up of buildings
    Roofs,
    /// Outer walls
    Facades,
}

impl PlacesArgs {
    /// Whether it is a grid over the ground, of which there are maps.
    pub(crate) fn is_grid(&self) -> bool {
        self.on == On::Ground && self.points.is_none()
    }

    /// Whether it is a part of what the file holds.
    pub(crate) fn is_part(&self) -> bool {
        self.area.is_some() || self.study.is_some() || self.points.is_some()
    }
}

/// The places of a run.
pub(super) struct Places {
    pub(super) kind: Kind,
    /// Those that are measured.
    pub(super) tiles: Tiles,
}

/// What they are, whether or not they are measured.
pub(super) enum Kind {
    Grid {
        grid: Grid,
        bound: Bound,
    },
    Faces {
        kind: FaceKind,
        found: OnFaces,
    },
    Points {
        file: PointFile,
        at: Vec<Point3>,
        /// What each lies in.
        inside: Vec<Option<Within>>,
        /// Which of them lie in nothing.
        outside: Vec<u32>,
    },
}

/// What a point lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Within {
    /// This building.
    Building(u32),
    /// What stands on the ground of a surface model, which has no buildings.
    Raised,
}

/// Where places were asked for, before it is known what stands around them.
pub(super) enum Asked {
    Within(Bound),
    /// Of which file, and where its points lie, metres east and north.
    Points(PathBuf, PointFile, Vec<[f64; 2]>),
}

impl Asked {
    /// Of a city that lies within `all`.
    pub(super) fn read(
        args: &PlacesArgs,
        origin: &Origin,
        all: Extent,
        talk: &Talk,
    ) -> anyhow::Result<Self> {
        let Some(path) = &args.points else {
            return Ok(Self::Within(Bound::new(args, origin, all, talk)?));
        };
        let file = read_points(path, &Limits::default())?;
        for finding in &file.findings {
            talk.say(&format!("{}: {finding}", path.display()));
        }
        let at = locate(&file, path, origin)?;
        Ok(Self::Points(path.clone(), file, at))
    }

    /// Around the places; `all` if nothing bounds them.
    pub(super) fn extent(&self, all: Extent) -> Extent {
        match self {
            Self::Within(Bound::Nothing) => all,
            Self::Within(Bound::Box(extent)) => *extent,
            Self::Within(Bound::Study(study)) => {
                let [low, high] = study.bounds();
                Extent { low, high }
            }
            Self::Points(_, _, at) => at.iter().copied().fold(Extent::NOWHERE, Extent::with),
        }
    }
}

impl Places {
    /// Of a city that lies within `all`.
    pub(super) fn new(
        args: &PlacesArgs,
        asked: Asked,
        city: &City,
        all: Extent,
        talk: &Talk,
    ) -> anyhow::Result<Self> {
        let places = match asked {
            Asked::Points(path, file, at) => points(&path, file, &at, city, talk)?,
            Asked::Within(bound) => match args.on {
                On::Ground => on_ground(args, city, all, bound)?,
                On::Roofs => on_faces(args, city, FaceKind::Roof, &bound)?,
                On::Facades => on_faces(args, city, FaceKind::Facade, &bound)?,
            },
        };
        if places.tiles.is_empty() {
            bail!("{}", places.nothing(args));
        }
        Ok(places)
    }

    /// Why there is no place.
    fn nothing(&self, args: &PlacesArgs) -> String {
        let within = args.study.as_ref().map_or_else(
            || {
                args.area
                    .map_or(String::new(), |_| " in the --area".to_owned())
            },
            |path| format!(" in {}", path.display()),
        );
        match &self.kind {
            Kind::Grid { .. } => {
                format!(
                    "no place of the grid{within} lies outside of buildings; take smaller cells"
                )
            }
            Kind::Faces { kind, .. } => format!("there is no free {}{within}", kind.name()),
            Kind::Points { file, .. } => {
                let name = args.points.as_deref().unwrap_or(Path::new("--points"));
                let name = name.display();
                match &file.points[..] {
                    [_] => format!("{name}: its point lies inside of a building"),
                    all => format!("{name}: all {} points lie inside of buildings", all.len()),
                }
            }
        }
    }

    /// How many places there are, measured or not.
    pub(super) fn count(&self) -> usize {
        match &self.kind {
            Kind::Grid { grid, .. } => grid.count(),
            Kind::Faces { found, .. } => found.places.len(),
            Kind::Points { at, .. } => at.len(),
        }
    }

    /// One number for each of the places, out of those for the measured ones; NaN for the rest.
    pub(super) fn spread(&self, minutes: &[f32]) -> Vec<f32> {
        let mut values = vec![f32::NAN; self.count()];
        for (index, &minutes) in self.numbers(0..minutes.len()).zip(minutes) {
            values[index as usize] = minutes;
        }
        values
    }

    /// Which of the places some of the measured ones are.
    pub(super) fn numbers(&self, which: std::ops::Range<usize>) -> impl Iterator<Item = u32> {
        let indices = self.tiles.indices()[which].iter();
        indices.map(|&index| match &self.kind {
            Kind::Points { outside, .. } => outside[index as usize],
            _ => index,
        })
    }

    /// Of the cells of a grid those that lie in no building and are not among the first `done` places: they lie outside of a
    /// study area, or were not measured. Nothing if there is none.
    pub(super) fn outside(&self, city: &City, done: usize) -> Vec<bool> {
        let Kind::Grid { grid, bound } = &self.kind else {
            return Vec::new();
        };
        let mut outside = vec![false; grid.count()];
        if let Bound::Study(study) = bound {
            let (ground, inside) = (Ground::new(city), Inside::new(city));
            for (index, outside) in (0..).zip(&mut outside) {
                let at = grid.centre(index % grid.width, index / grid.width);
                let is_free = || ground.at(at).is_none_or(|place| !inside.contains(place));
                *outside = !study.contains(at) && is_free();
            }
        }
        for &index in &self.tiles.indices()[done..] {
            outside[index as usize] = true;
        }
        if outside.contains(&true) {
            outside
        } else {
            Vec::new()
        }
    }

    /// For people.
    pub(super) fn describe(&self) -> String {
        let measured = self.tiles.places().len();
        match &self.kind {
            Kind::Grid { grid, .. } => format!(
                "{} x {} cells of {} m, {measured} to measure",
                grid.width, grid.height, grid.cell
            ),
            Kind::Faces { kind, found } => format!(
                "{measured} places on {}s, {} left out that lie in or against a building",
                kind.name(),
                found.hidden
            ),
            Kind::Points { at, .. } => format!(
                "{} points, {} of them inside of buildings",
                at.len(),
                at.len() - measured
            ),
        }
    }

    /// How many were left out or are not measured because they lie in or against a building.
    pub(super) fn hidden(&self) -> usize {
        match &self.kind {
            Kind::Grid { .. } => 0,
            Kind::Faces { found, .. } => found.hidden,
            Kind::Points { at, .. } => at.len() - self.tiles.places().len(),
        }
    }

    /// "ground", "roof", "facade" or "points".
    pub(super) fn name(&self) -> &'static str {
        match &self.kind {
            Kind::Grid { .. } => "ground",
            Kind::Faces { kind, .. } => kind.name(),
            Kind::Points { .. } => "points",
        }
    }
}

fn on_ground(args: &PlacesArgs, city: &City, all: Extent, bound: Bound) -> anyhow::Result<Places> {
    let (option, [from, to]) = match &bound {
        Bound::Nothing => ("", [all.low, all.high]),
        Bound::Box(within) if args.margin.is_some() => ("--margin: ", [within.low, within.high]),
        Bound::Box(within) => ("--area: ", [within.low, within.high]),
        Bound::Study(study) => ("--study: ", study.bounds()),
    };
    let grid = match (&bound, Grid::within(from, to, args.cell)) {
        (_, Ok(grid)) => grid,
        (Bound::Nothing, Err(error)) => bail!(error),
        (_, Err(error)) => wrong_usage(&format!("{option}{error}")),
    };
    // The cells of an area are those that it touches, of a study area those whose middles lie in it.
    let tiles = match &bound {
        Bound::Study(study) => Tiles::on_ground(city, &grid, |at| study.contains(at)),
        _ => Tiles::on_ground(city, &grid, |_| true),
    };
    let kind = Kind::Grid { grid, bound };
    Ok(Places { kind, tiles })
}

fn on_faces(
    args: &PlacesArgs,
    city: &City,
    kind: FaceKind,
    bound: &Bound,
) -> anyhow::Result<Places> {
    let found = OnFaces::of(city, kind, args.cell, |at| bound.contains(at))
        .unwrap_or_else(|error| wrong_usage(&format!("--cell: {error}")));
    let at: Vec<Point3> = found.places.iter().map(|place| place.at).collect();
    let tiles = Tiles::near(&at);
    let kind = Kind::Faces { kind, found };
    Ok(Places { kind, tiles })
}

/// Farther from the city than this, in metres, a point is a mistake: no shadow comes so far, and the city's metres
/// are none there.
const FARTHEST: f64 = 50_000.0;

/// Where points lie, metres east and north.
fn locate(file: &PointFile, path: &Path, origin: &Origin) -> anyhow::Result<Vec<[f64; 2]>> {
    let crs = file.crs.as_ref().unwrap_or_else(|| origin.crs());
    let origin = origin.on_map(crs.clone());
    let locate = |point: &Point| {
        let local = origin.to_local(point.at);
        if local[0].hypot(local[1]) <= FARTHEST {
            return Ok(local);
        }
        bail!(
            "{}: {}: {}",
            path.display(),
            file.place(point),
            nowhere(point.at, local, crs)
        )
    };
    file.points.iter().map(locate).collect()
}

fn points(
    path: &Path,
    file: PointFile,
    at: &[[f64; 2]],
    city: &City,
    talk: &Talk,
) -> anyhow::Result<Places> {
    let name = path.display();
    let taken = |name: &&&str| {
        file.points
            .iter()
            .any(|point| point.properties.contains_key(**name))
    };
    for column in PLACE_COLUMNS.iter().filter(taken) {
        talk.say(&format!(
            "{name}: {column:?} of its points gives way to what is found now"
        ));
    }
    let (ground, inside) = (Ground::new(city), Inside::new(city));
    // Few files have such points.
    let raised = LazyCell::new(|| raised(city));
    let stand = |(point, &at): (&Point, &[f64; 2])| {
        if let Some(foot) = ground.at(at) {
            let at = Point3::new(foot.x, foot.y, foot.z + point.height as f32);
            return Ok((at, inside.building(at).map(Within::Building)));
        }
        let Some(top) = raised.as_ref().and_then(|raised| raised.at(at)) else {
            let ([x, y], place) = (point.at, file.place(point));
            bail!(
                "{name}: {place}: {x}, {y} lies beside the terrain or in a hole of it: there is no ground to stand on"
            );
        };
        // How high the ground is below a roof or a tree nobody has said here: the point is shown on top.
        Ok((top, Some(Within::Raised)))
    };
    let stood = (file.points.iter().zip(at)).map(stand);
    let (at, inside): (Vec<Point3>, Vec<Option<Within>>) = stood
        .collect::<anyhow::Result<Vec<_>>>()?
        .into_iter()
        .unzip();
    let outside: Vec<u32> = (0..at.len() as u32)
        .filter(|&index| inside[index as usize].is_none())
        .collect();
    let measured: Vec<Point3> = outside.iter().map(|&index| at[index as usize]).collect();
    Ok(Places {
        tiles: Tiles::near(&measured),
        kind: Kind::Points {
            file,
            at,
            inside,
            outside,
        },
    })
}

/// The top of what stands on the ground of a surface model.
fn raised(city: &City) -> Option<Ground> {
    let is_surface = city.buildings.is_empty() && city.is_terrain_all;
    (is_surface && !city.context.is_empty()).then(|| {
        Ground::new(&City {
            origin: city.origin.clone(),
            buildings: Vec::new(),
            terrain: city.context.clone(),
            is_terrain_all: true,
            context: Vec::new(),
            ground: city.ground,
            findings: Vec::new(),
        })
    })
}

fn nowhere([x, y]: [f64; 2], local: [f64; 2], crs: &Crs) -> String {
    let away = local[0].hypot(local[1]) / 1000.0;
    if away.is_finite() {
        format!("{x}, {y} ({crs}) is {away:.0} km from the city; 50 km at most are wanted")
    } else {
        format!("{x}, {y} is no place of {crs}")
    }
}
