//! Degrees that are taken for metres.

use super::{Draft, DraftPart};
use crate::extent::Extent;

/// No city is so small, in metres.
const SMALLEST: f64 = 2.0;

/// Nor one of many buildings so small: longitudes and latitudes of a country span no more.
const SMALLEST_OF_MANY: f64 = 20.0;
const MANY: usize = 100;

/// What to say of a city that is far too small because its coordinates are longitude and latitude.
pub(super) fn taken_for_metres(draft: &Draft) -> Option<String> {
    if draft.crs.is_geographic() {
        return None;
    }
    let buildings = || draft.buildings.iter().chain(&draft.parts);
    let mut all = Extent::NOWHERE;
    for part in buildings().flat_map(|building| &building.parts) {
        all = match part {
            DraftPart::Footprint { rings, .. } => {
                rings.iter().flatten().copied().fold(all, Extent::with)
            }
            DraftPart::Faces(faces) => {
                let corners = faces.iter().flat_map(|face| face.rings.iter().flatten());
                corners.map(|&[x, y, _]| [x, y]).fold(all, Extent::with)
            }
        };
    }
    let corners = draft.terrain.iter().flatten().map(|&[x, y, _]| [x, y]);
    let Extent { low, high } = corners.fold(all, Extent::with);
    let is_degrees = (0..2).all(|k| low[k] >= -180.0 && high[k] <= 180.0);
    let wide = f64::max(high[0] - low[0], high[1] - low[1]);
    let smallest = if buildings().count() > MANY {
        SMALLEST_OF_MANY
    } else {
        SMALLEST
    };
    (is_degrees && wide < smallest).then(|| {
        let wide = if wide < 0.01 {
            "less than 0.01".to_owned()
        } else {
            format!("only {wide:.2}")
        };
        format!(
            "is {wide} m wide in {}, and its coordinates look like degrees: name the right coordinate \
             reference system",
            draft.crs.name()
        )
    })
}

#[cfg(test)]
mod tests {
    use crate::crs::Crs;
    use crate::draft::{Draft, DraftBuilding, DraftPart};

    fn findings(crs: Crs, [x, y]: [f64; 2], size: f64) -> Vec<String> {
        let mut draft = Draft::new(crs);
        let corners = [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
        draft.buildings.push(DraftBuilding {
            place: "feature 0".to_owned(),
            parts: vec![DraftPart::Footprint {
                rings: vec![corners.to_vec()],
                base: 0.0,
                top: 9.0,
            }],
            ..DraftBuilding::default()
        });
        let findings = match draft.finish() {
            Ok(city) => city.findings,
            Err(crate::CityError::NothingThere { findings }) => findings,
            Err(error) => panic!("{error}"),
        };
        findings.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_city_of_degrees_on_a_map_of_metres_says_so_first() {
        let metres = || Crs::from_epsg(25832).unwrap();
        let told = findings(metres(), [13.4, 52.5], 2e-4);
        assert!(
            told[0].contains("city: is less than 0.01 m wide in EPSG:25832"),
            "{told:?}"
        );
        assert!(told[0].contains("look like degrees"), "{told:?}");
        assert!(findings(Crs::wgs84(), [13.4, 52.5], 2e-4).is_empty());
        assert!(findings(metres(), [13.4, 52.5], 12.0).is_empty());
        assert!(findings(metres(), [500_013.4, 5_800_052.5], 1.0).is_empty());
    }
}
