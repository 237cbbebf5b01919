//! What casts shadow and where: a city or a surface model, terrain, and models beside it.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::{Args, ValueEnum};
use ombra::city::{Base, City, CityError, Crs, Edited, Edits, Extent, Origin, demo_city};
use ombra::formats::Limits;
use ombra::formats::city::{CityModel, Up, read_city, read_city_model};
use ombra::formats::elevation::{Elevation, is_elevation, read_elevation};

use super::args::ShadowsArgs;
use super::bound::extent;
use super::{DEMO, wrong_usage};

/// What stands around.
#[derive(Clone, Debug, Args)]
pub(crate) struct SurroundingsArgs {
    /// Terrain as a GeoTIFF of heights: the city stands on it, and it casts shadow. With a surface model as the
    /// city it tells ground from what stands on it
    #[arg(long, value_name = "DEM")]
    pub(crate) terrain: Option<PathBuf>,

    /// What the coordinates of the terrain mean, whatever it says itself
    #[arg(long, value_name = "CRS", requires = "terrain", value_parser = super::args::crs)]
    pub(crate) terrain_crs: Option<Crs>,

    /// A model that casts shadow as well, in metres: OBJ, PLY, STL, glTF; may be given several times
    #[arg(long, value_name = "MODEL", requires = "context_origin")]
    pub(crate) context: Vec<PathBuf>,

    /// Where the origin of the model is, in the coordinates of the city: east, north and height; without a
    /// height it is on the ground. One for each model, or one for all
    #[arg(long, value_name = "E,N[,H]", requires = "context", value_parser = place, allow_hyphen_values = true)]
    pub(crate) context_origin: Vec<ModelOrigin>,

    /// Which axis of the models points up [default: y in glTF, z in all others]
    #[arg(long, value_enum, requires = "context")]
    pub(crate) context_up: Option<Axis>,
}

/// Where the origin of a model is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ModelOrigin {
    map: [f64; 2],
    base: Option<f64>,
}

/// Which axis points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Axis {
    /// x east, y up, z south
    Y,
    /// x east, y north, z up
    Z,
}

fn place(text: &str) -> Result<ModelOrigin, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let numbers = numbers.unwrap_or_default();
    match numbers[..] {
        _ if !numbers.iter().all(|x| x.is_finite()) => None,
        [east, north] => Some((east, north, None)),
        [east, north, base] => Some((east, north, Some(base))),
        _ => None,
    }
    .map(|(east, north, base)| ModelOrigin {
        map: [east, north],
        base,
    })
    .ok_or_else(|| "two or three numbers are wanted: east,north or east,north,height".to_owned())
}

/// What was read, before it is known how much of the terrain matters.
pub(super) struct Site<'a> {
    args: &'a ShadowsArgs,
    origin: Origin,
    ground: GroundedOn,
    terrain: Option<Elevation>,
    models: Vec<(&'a Path, CityModel)>,
    /// What else the city might be.
    edited: Option<Edited>,
}

enum GroundedOn {
    City(Box<City>),
    Surface(Elevation),
}

impl<'a> Site<'a> {
    pub(super) fn read(args: &'a ShadowsArgs) -> anyhow::Result<Self> {
        let around = &args.surroundings;
        let (models, origins) = (around.context.len(), around.context_origin.len());
        if origins > 1 && origins != models {
            wrong_usage(&format!(
                "--context-origin: {models} models have {origins} origins; one each is wanted, or one for all"
            ));
        }
        let limits = Limits::default();
        let city = &args.city;
        let ground = if city == DEMO {
            GroundedOn::City(Box::new(demo_city()))
        } else if is_elevation(city)? {
            GroundedOn::Surface(read_elevation(city, args.crs.as_ref(), &limits)?)
        } else {
            GroundedOn::City(Box::new(read_city(city, &args.city_options())?))
        };
        let origin = match &ground {
            GroundedOn::City(found) => found.origin.clone(),
            GroundedOn::Surface(found) => found.field.origin().map_err(|e| of_file(city, &e))?,
        };
        let terrain = around.terrain.as_ref();
        let up = around.context_up.map(|axis| match axis {
            Axis::Y => Up::Y,
            Axis::Z => Up::Z,
        });
        let model = |path: &'a PathBuf| Ok((path.as_path(), read_city_model(path, up, &limits)?));
        Ok(Self {
            args,
            origin,
            ground,
            edited: None,
            terrain: terrain
                .map(|path| read_elevation(path, around.terrain_crs.as_ref(), &limits))
                .transpose()?,
            models: (around.context.iter().map(model)).collect::<anyhow::Result<_>>()?,
        })
    }

    pub(super) const fn origin(&self) -> &Origin {
        &self.origin
    }

    /// What if: the city is there twice from now on. A surface model has no buildings to be changed.
    pub(super) fn edit(&mut self, edits: &Edits) -> anyhow::Result<()> {
        if let GroundedOn::City(city) = &self.ground {
            let edited = city.edited(edits);
            self.edited = Some(edited.map_err(|error| anyhow!("{}: {error}", self.args.city))?);
        }
        Ok(())
    }

    /// Around all of it; terrain and models that were added do not count.
    pub(super) fn extent(&self) -> Extent {
        let own = match &self.ground {
            GroundedOn::City(city) => extent(&city.facets()),
            GroundedOn::Surface(surface) => surface.field.extent(&self.origin),
        };
        match &self.edited {
            Some(edited) => {
                let Extent { low, high } = extent(&edited.city.facets());
                // Where nothing is left there is none.
                [low, high]
                    .into_iter()
                    .filter(|at| at.iter().all(|x| x.is_finite()))
                    .fold(own, Extent::with)
            }
            None => own,
        }
    }

    /// Of a surface model: where it lies, and its highest height.
    pub(super) fn surface(&self) -> Option<(Extent, f32)> {
        match &self.ground {
            GroundedOn::City(_) => None,
            GroundedOn::Surface(surface) => Some((self.extent(), surface.field.range()[1])),
        }
    }

    /// The city with all that is around the places, as far as shadows reach while the sun stands at
    /// least so high, in radians; and how far that is, in metres.
    pub(super) fn city(self, places: Extent, altitude: f64) -> anyhow::Result<(City, f64)> {
        let (city, edited, reach) = self.cities(places, altitude)?;
        Ok((edited.map_or(city, |edited| edited.city), reach))
    }

    /// The same, and what else it might be on the same ground.
    pub(super) fn cities(
        self,
        places: Extent,
        altitude: f64,
    ) -> anyhow::Result<(City, Option<Edited>, f64)> {
        let reach = self.rise() / altitude.max(0.0).tan();
        let extent = places.widened(reach);
        let (name, terrain) = (&self.args.city, self.terrain);
        let terrain_name = self
            .args
            .surroundings
            .terrain
            .as_deref()
            .unwrap_or(Path::new(""));
        let of_terrain = |error: &CityError| of_file(&terrain_name.display().to_string(), error);
        let mut findings = Vec::new();
        let mut edited = self.edited;
        let mut surface = None;
        let mut city = match self.ground {
            GroundedOn::City(mut city) => {
                if let Some(terrain) = &terrain {
                    let others = edited.as_mut().map(|edited| &mut edited.city);
                    for city in [&mut *city].into_iter().chain(others) {
                        (city.stand_on(&terrain.field, extent)).map_err(|e| of_terrain(&e))?;
                    }
                }
                *city
            }
            GroundedOn::Surface(mut found) => {
                let below = terrain.as_ref().map(|terrain| &terrain.field);
                let city = City::of_surface(&found.field, below, extent);
                findings.append(&mut found.findings);
                surface = Some(found.field);
                city.map_err(|error| of_file(name, &error))?
            }
        };
        findings.extend(terrain.iter().flat_map(|terrain| terrain.findings.clone()));
        // Models stand on the bare ground, and also where no shadow reaches the places, so on all of its heights.
        let bare = terrain.as_ref().map(|terrain| &terrain.field);
        let on_ground = bare.or(surface.as_ref()).map_or(Base::Ground, Base::Field);
        city.findings.splice(0..0, findings);
        let origins = &self.args.surroundings.context_origin;
        for (index, (path, model)) in self.models.into_iter().enumerate() {
            let at = origins.get(index).or(origins.first());
            let at = at.expect("clap asks for an origin with a model");
            let file = path.display().to_string();
            let base = at.base.map_or(on_ground, Base::Height);
            let others = edited.as_mut().map(|edited| &mut edited.city);
            for city in [&mut city].into_iter().chain(others) {
                (city.add_model(model.triangles.iter().copied(), at.map, base))
                    .map_err(|error| of_file(&file, &error))?;
            }
            city.findings
                .extend(model.findings.iter().map(|finding| ombra::city::Finding {
                    place: file.clone(),
                    message: finding.to_string(),
                    count: 1,
                }));
        }
        Ok((city, edited, reach))
    }

    /// From the lowest place to the highest top, metres, models left out.
    fn rise(&self) -> f64 {
        let of_field = |elevation: &Elevation| {
            let [low, high] = elevation.field.range();
            f64::from(high - low)
        };
        match &self.ground {
            GroundedOn::Surface(surface) => of_field(surface),
            GroundedOn::City(city) => {
                let added = self.edited.iter().flat_map(|edited| &edited.city.buildings);
                let tops = (city.buildings.iter().chain(added))
                    .flat_map(|b| b.parts.iter().map(|part| part.range()[1] - b.ground));
                let tallest = f64::from(tops.fold(0.0, f32::max));
                tallest + self.terrain.as_ref().map_or(0.0, of_field)
            }
        }
    }
}

fn of_file(name: &str, error: &CityError) -> anyhow::Error {
    anyhow!("{name}: {error}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_origin_is_two_or_three_numbers() {
        let at = |map, base| Ok(ModelOrigin { map, base });
        assert_eq!(place("-1.5, 2"), at([-1.5, 2.0], None));
        assert_eq!(place("1,2,-3"), at([1.0, 2.0], Some(-3.0)));
        for wrong in ["", "1", "1,2,3,4", "1,nan", "a,b", "1,inf"] {
            assert!(place(wrong).is_err(), "{wrong}");
        }
    }
}
