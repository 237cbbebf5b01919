//! A city that is a surface model: heights of all that there is, ground, roofs and trees alike.

use crate::city::City;
use crate::error::CityError;
use crate::extent::Extent;
use crate::finding::Notes;
use crate::height_field::{HeightField, Vertices, triangles};
use crate::stand::elsewhere;

/// What stands more than this above the terrain, in metres, is no ground: buildings and trees, but not cars,
/// kerbs and the noise of what was measured.
const RAISED: f32 = 2.0;

impl City {
    /// A city whose surface is a height field, as far as `extent` needs it; [`HeightField::origin`] is its
    /// origin.
    ///
    /// With the terrain below it, what stands more than 2 m above that casts shadow and is no ground:
    /// [`City::context`]. Where there is no terrain all is ground, roofs as well. Beside the surface and in
    /// its holes there is none.
    ///
    /// # Errors
    /// When no height lies in the extent, more than [`MOST_PIXELS`](crate::MOST_PIXELS) pixels do, or the
    /// field lies outside of its reference system.
    pub fn of_surface(
        surface: &HeightField,
        terrain: Option<&HeightField>,
        extent: Extent,
    ) -> Result<Self, CityError> {
        let origin = surface.origin()?;
        let vertices = Vertices::new(surface, &origin, extent)?;
        let mut notes = Notes::default();
        let mut is_raised = Vec::new();
        if let Some(terrain) = terrain {
            let below = vertices.heights_of(terrain, surface, &origin);
            if below.iter().all(|z| z.is_nan()) {
                return Err(elsewhere(terrain, &origin));
            }
            let above = vertices.points.iter().map(|p| p.z).zip(&below);
            let uncovered = (above.clone()).filter(|(z, below)| z.is_finite() && below.is_nan());
            let uncovered = uncovered.count();
            is_raised = above.map(|(z, below)| z - below > RAISED).collect();
            let raised = is_raised.iter().filter(|&&is| is).count();
            let all = is_raised.len();
            let message = format!(
                "{raised} of {all} pixels are more than {RAISED} m above the terrain: they cast shadow and are \
                 no ground"
            );
            notes.add("surface", message);
            if uncovered > 0 {
                let message = format!("has no height under {uncovered} pixels: they are ground");
                notes.add("terrain", message);
            }
        }
        let blank = vertices.points.iter().filter(|p| !p.z.is_finite()).count();
        if blank > 0 {
            let message = format!("pixels have no height: {blank}; holes, with no ground in them");
            notes.add("surface", message);
        }
        let found = triangles(&vertices, &is_raised);
        if found.ground.is_empty() && found.raised.is_empty() {
            return Err(elsewhere(surface, &origin));
        }
        let all = found.ground.iter().chain(&found.raised).flatten();
        Ok(Self {
            ground: all.map(|p| p.z).fold(f32::INFINITY, f32::min),
            origin,
            buildings: Vec::new(),
            terrain: found.ground,
            is_terrain_all: true,
            context: found.raised,
            findings: notes.into_findings(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;
    use crate::facet::Facet;

    fn field(size: u32, z: impl Fn(u32, u32) -> f32) -> HeightField {
        let heights = (0..size * size).map(|k| z(k % size, k / size));
        HeightField::new(
            Crs::from_epsg(2100).unwrap(),
            [size; 2],
            [1.0, 0.0, 476_800.5, 0.0, -1.0, 4_206_249.5],
            heights.collect(),
        )
        .unwrap()
    }

    #[test]
    fn without_terrain_all_is_ground() {
        let tower = |c, r| if c == 10 && r == 12 { 40.0 } else { 5.0 };
        let city = City::of_surface(&field(30, tower), None, Extent::EVERYWHERE).unwrap();
        assert!(city.context.is_empty() && city.is_terrain_all && city.findings.is_empty());
        let top = city.terrain.iter().flatten().map(|p| p.z);
        assert_eq!(top.fold(0.0, f32::max), 40.0);
        assert_eq!(city.ground, 5.0);
        assert!(city.facets().iter().all(|f| f.owner == Facet::TERRAIN));
    }

    #[test]
    fn what_stands_on_the_terrain_is_no_ground() {
        let z = |c: u32, r: u32| match (c, r) {
            (10..15, 10..15) => 25.0,
            // As high as a car.
            (20, 20) => 6.5,
            (0, 0) => f32::NAN,
            _ => 5.0,
        };
        let bare = field(30, |c, _| if c == 29 { f32::NAN } else { 5.0 });
        let city = City::of_surface(&field(30, z), Some(&bare), Extent::EVERYWHERE).unwrap();
        let highest = |all: &[[ombra_geometry::Point3; 3]]| {
            let corners = all.iter().flatten().map(|p| p.z);
            corners.fold(0.0, f32::max)
        };
        assert_eq!(
            (highest(&city.terrain), highest(&city.context)),
            (6.5, 25.0)
        );
        assert!(city.facets().iter().any(|f| f.owner == Facet::CONTEXT));
        let told: Vec<String> = city.findings.iter().map(ToString::to_string).collect();
        assert_eq!(told.len(), 3, "{told:?}");
        assert!(told[0].contains("25 of 900"), "{told:?}");
        assert!(told[1].contains("under 30 pixels"), "{told:?}");
        assert!(told[2].contains("no height: 1;"), "{told:?}");
    }

    #[test]
    fn one_pixel_is_no_surface_and_terrain_elsewhere_is_told() {
        let one = City::of_surface(&field(1, |_, _| 3.0), None, Extent::EVERYWHERE);
        assert!(matches!(one, Err(CityError::HeightsElsewhere { .. })));
        let surface = field(10, |_, _| 3.0);
        let far = HeightField::new(
            surface.crs().clone(),
            [2, 2],
            [1.0, 0.0, 500_000.0, 0.0, -1.0, 4_200_000.0],
            vec![1.0; 4],
        )
        .unwrap();
        let told = City::of_surface(&surface, Some(&far), Extent::EVERYWHERE).unwrap_err();
        assert!(told.to_string().contains("24 km away"), "{told}");
    }
}
