//! Models that stand in a city.

use ombra_geometry::Point3;

use crate::city::City;
use crate::draft::FARTHEST;
use crate::error::CityError;
use crate::height_field::HeightField;

/// What the origin of a model stands on.
#[derive(Clone, Copy, Debug)]
pub enum Base<'a> {
    /// So many metres high.
    Height(f64),
    /// On the city's own ground: its terrain, or the flat ground.
    Ground,
    /// On the heights of a field, however little of it is the city's terrain.
    Field(&'a HeightField),
}

impl City {
    /// Adds the triangles of a model: metres, x toward the east of the **map**, y toward its north, z up. Its
    /// origin is a place of the map.
    ///
    /// Triangles with a corner that is not finite are left out. They cast shadow on both sides.
    ///
    /// # Errors
    /// When the origin is not on the map, or over 60 km from the city's, and when there is no ground to stand on.
    pub fn add_model(
        &mut self,
        triangles: impl IntoIterator<Item = [Point3; 3]>,
        origin: [f64; 2],
        base: Base<'_>,
    ) -> Result<(), CityError> {
        let at = self.origin.to_local(origin);
        if !(at[0].abs().max(at[1].abs()) <= FARTHEST) {
            let [x, y] = origin;
            let crs = self.origin.crs().name().to_owned();
            return Err(CityError::ModelElsewhere { x, y, crs });
        }
        let north = self.north_of_map(origin, at);
        let base = match base {
            Base::Height(base) => Some(base),
            Base::Ground => self.ground_at(at).map(f64::from),
            Base::Field(field) => {
                let map = self.origin.on_map(field.crs().clone()).to_map(at);
                field.height(map)
            }
        };
        let Some(base) = base else {
            let [x, y] = origin;
            return Err(CityError::ModelWithoutGround { x, y });
        };
        let placed = |p: Point3| {
            let p = p.wide();
            Point3::new(
                (at[0] + p.x * north[1] + p.y * north[0]) as f32,
                (at[1] - p.x * north[0] + p.y * north[1]) as f32,
                (base + p.z) as f32,
            )
        };
        let triangles = triangles.into_iter().map(|corners| corners.map(placed));
        self.context
            .extend(triangles.filter(|corners| corners.iter().all(|p| p.is_finite())));
        Ok(())
    }

    /// Where the map's north points there, in local metres, 1 long: it leans against true north.
    fn north_of_map(&self, [x, y]: [f64; 2], at: [f64; 2]) -> [f64; 2] {
        let crs = self.origin.crs();
        let step = if crs.is_geographic() { 1e-3 } else { 100.0 };
        let to = self.origin.to_local([x, y + step]);
        let way = [to[0] - at[0], to[1] - at[1]];
        let length = way[0].hypot(way[1]);
        if length > 0.0 {
            way.map(|x| x / length)
        } else {
            // At the very edge of the map.
            [0.0, 1.0]
        }
    }

    /// The z of the ground at a place (local metres): of the highest terrain there, or of the flat ground; `None` if
    /// there is no ground ([`City::is_terrain_all`]).
    #[must_use]
    pub fn ground_at(&self, [x, y]: [f64; 2]) -> Option<f32> {
        let heights = self.terrain.iter().filter_map(|corners| {
            let [a, b, c] = corners.map(|p| p.wide());
            let part =
                |p: Point3<f64>, q: Point3<f64>| (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
            let (of_a, of_b, of_c) = (part(b, c), part(c, a), part(a, b));
            let whole = of_a + of_b + of_c;
            let is_in = of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 && whole > 0.0;
            is_in.then(|| ((of_a * a.z + of_b * b.z + of_c * c.z) / whole) as f32)
        });
        let flat = (!self.is_terrain_all).then_some(self.ground);
        heights.reduce(f32::max).or(flat)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;
    use crate::draft::Draft;
    use crate::facet::Facet;

    /// Flat terrain of the Dutch grid, far west of its middle, at 3 m.
    fn city() -> City {
        let mut draft = Draft::new(Crs::from_epsg(28992).unwrap());
        let at = |x: f64, y: f64| [84_600.0 + x, 447_400.0 + y, 3.0];
        draft
            .terrain
            .push([at(0.0, 0.0), at(99.0, 0.0), at(0.0, 99.0)]);
        draft.finish().unwrap()
    }

    const TRIANGLE: [Point3; 3] = [
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(0.0, 50.0, 0.0),
        Point3::new(0.0, 50.0, 20.0),
    ];

    #[test]
    fn a_model_leans_as_its_map_does_and_stands_on_the_ground() {
        let mut city = city();
        city.add_model([TRIANGLE], [84_610.0, 447_410.0], Base::Ground)
            .unwrap();
        let [foot, far, top] = city.context[0];
        let expected = city.origin.to_local([84_610.0, 447_460.0]);
        assert!((f64::from(far.x) - expected[0]).abs() < 0.01, "{far:?}");
        assert!((f64::from(far.y) - expected[1]).abs() < 0.02, "{far:?}");
        assert!(
            (far.x - foot.x).abs() > 0.5,
            "the grid leans by 0.8 degrees"
        );
        assert_eq!((foot.z, top.z), (3.0, 23.0));
        let facets = city.facets();
        assert_eq!(facets.last().unwrap().owner, Facet::CONTEXT);
        city.add_model([TRIANGLE], [84_610.0, 447_410.0], Base::Height(7.5))
            .unwrap();
        assert_eq!(city.context[1][0].z, 7.5);
        // Beside the terrain the ground is flat, at its lowest.
        assert_eq!(city.ground_at([-500.0, 0.0]), Some(3.0));
    }

    #[test]
    fn what_is_nowhere_is_left_out_or_told() {
        let mut city = city();
        let nowhere = [TRIANGLE[0], TRIANGLE[1], Point3::new(f32::NAN, 0.0, 0.0)];
        city.add_model([nowhere], [84_610.0, 447_410.0], Base::Ground)
            .unwrap();
        assert!(city.context.is_empty());
        for origin in [[0.0, 0.0], [f64::NAN, 0.0], [1e300, 1.0]] {
            let told = city
                .add_model([TRIANGLE], origin, Base::Ground)
                .unwrap_err();
            assert!(told.to_string().contains("within 60 km"), "{told}");
        }
    }

    #[test]
    fn a_model_stands_on_heights_that_are_no_terrain_of_the_city() {
        let mut city = city();
        let slope = HeightField::new(
            Crs::from_epsg(28992).unwrap(),
            [50, 50],
            [10.0, 0.0, 84_600.0, 0.0, -10.0, 447_800.0],
            (0..2500).map(|k| (k % 50) as f32).collect(),
        )
        .unwrap();
        city.add_model([TRIANGLE], [84_800.0, 447_600.0], Base::Field(&slope))
            .unwrap();
        let foot = city.context[0][0].z;
        assert!((foot - 20.0).abs() < 1e-3, "{foot}");

        city.is_terrain_all = true;
        for (origin, base) in [
            ([85_600.0, 447_600.0], Base::Field(&slope)),
            ([84_800.0, 447_600.0], Base::Ground),
        ] {
            let told = city.add_model([TRIANGLE], origin, base).unwrap_err();
            assert!(told.to_string().contains("E,N,H"), "{told}");
        }
        assert_eq!(city.context.len(), 1);
    }
}
