//! Cities from outside the project have the numbers that are known of them.

use ombra_city::{City, Facet, Part};

use super::super::{CityOptions, read_city};
use super::{findings, outside_data, tops};

fn real(name: &str) -> Option<City> {
    let path = outside_data(name)?;
    Some(read_city(path, &CityOptions::default()).unwrap_or_else(|error| panic!("{error}")))
}

/// Metres from the west to the east end of all buildings, and from the south to the north end.
fn extent(city: &City) -> [f32; 2] {
    let corners = || city.facets().into_iter().flat_map(|f| f.corners);
    let range = |all: Vec<f32>| {
        all.iter().copied().fold(f32::MIN, f32::max) - all.iter().copied().fold(f32::MAX, f32::min)
    };
    [
        range(corners().map(|p| p.x).collect()),
        range(corners().map(|p| p.y).collect()),
    ]
}

fn triangles(facets: &[Facet]) -> usize {
    facets.iter().filter(|f| f.is_triangle()).count()
}

#[test]
fn lower_manhattan() {
    let Some(city) = real("city/geojson/lower_manhattan_nyc_opendata.geojson") else {
        return;
    };
    assert_eq!(city.buildings.len(), 650);
    assert_eq!(findings(&city), [""; 0]);
    let tops = tops(&city);
    assert_eq!(tops[0], 429.27, "One World Trade Center");
    let ground = city.buildings[0].ground_elevation.unwrap();
    assert!((ground - 1.52).abs() < 0.01);
    let lowest = tops.iter().copied().fold(f32::MAX, f32::min);
    assert!((lowest - 17.4).abs() < 0.5, "57 ft: {lowest}");
    // The list of the data has "6 true multipolygons" and "no holes": it is 6 with holes.
    let has_courts = |part: &Part| matches!(part, Part::Prism(p) if !p.outline.holes.is_empty());
    let with_courts = (city.buildings.iter()).filter(|b| b.parts.iter().any(has_courts));
    assert_eq!(with_courts.count(), 6);
    // 4,878 positions, of which each of 667 rings repeats one, make as many walls.
    let facets = city.facets();
    assert_eq!(facets.len(), 5934);
    assert!(facets.iter().all(|f| !f.is_two_sided));
    let walls = facets
        .iter()
        .filter(|f| f.corners[0].z < f.corners[3].z)
        .count();
    assert_eq!(walls, 4878 - 667);
    // 0.0219° at 84,400 m each, 0.0119° at 111,050 m each.
    let [east, north] = extent(&city);
    assert!(
        (east - 1850.0).abs() < 10.0 && (north - 1326.0).abs() < 10.0,
        "{east} {north}"
    );
}

#[test]
fn suzhou() {
    let Some(city) = real("city/geojson/suzhou_buildings.geojson") else {
        return;
    };
    assert_eq!(city.buildings.len(), 3076);
    assert_eq!(findings(&city), [""; 0]);
    let tops = tops(&city);
    assert_eq!(tops.iter().copied().fold(f32::MIN, f32::max), 84.0);
    assert_eq!(tops.iter().copied().fold(f32::MAX, f32::min), 3.0);
    assert_eq!(city.facets().len(), 17_948);
}

/// 26 of its polygons are not simple, and 95 repeat a corner.
#[test]
fn manhattan_of_deck_gl() {
    let Some(city) = real("city/manhattan_deckgl/buildings.json") else {
        return;
    };
    assert_eq!(city.buildings.len(), 999 - 3);
    let tops = tops(&city);
    assert_eq!(tops.iter().copied().fold(f32::MIN, f32::max), 541.0);
    assert_eq!(tops.iter().copied().fold(f32::MAX, f32::min), 2.0);
    let counts: Vec<u64> = city.findings.iter().map(|f| f.count).collect();
    assert_eq!(counts, [95, 2, 17, 4, 3], "{:?}", findings(&city));
}

#[test]
fn delft() {
    let Some(city) = real("city/cityjson/delft.city.json") else {
        return;
    };
    assert_eq!(city.buildings.len(), 160);
    let unused: u64 = (city.findings.iter())
        .filter(|f| f.message.ends_with("is no building: left out"))
        .map(|f| f.count)
        .sum();
    assert_eq!(unused, 570 - 160);
    assert!((city.origin.latitude() - 52.012).abs() < 0.001);
    assert!((city.origin.longitude() - 4.3666).abs() < 0.001);
    let facets = city.facets();
    assert!(
        facets.iter().all(|f| !f.is_two_sided),
        "solids without floors"
    );
    assert_eq!((facets.len(), triangles(&facets)), (3155, 747));
}

#[test]
fn rotterdam() {
    let Some(city) = real("city/cityjson/rotterdam_delfshaven.city.json") else {
        return;
    };
    assert_eq!(city.buildings.len(), 853);
    assert!((tops(&city).iter().copied().fold(f32::MIN, f32::max) - 41.158).abs() < 1e-3);
    assert_eq!(city.ground, 0.0);
    assert_eq!(city.buildings[0].ground_elevation, Some(1.37));
    // 1044.6 m by 649.5 m of the grid, which leans by 0.7° there.
    let [east, north] = extent(&city);
    assert!(
        (east - 1045.0).abs() < 10.0 && (north - 650.0).abs() < 15.0,
        "{east} {north}"
    );
    let facets = city.facets();
    assert_eq!((facets.len(), triangles(&facets)), (20_865, 4213));
    assert_eq!(facets.iter().filter(|f| f.is_two_sided).count(), 20_014);
}

#[test]
fn chicago() {
    let Some(city) = real("city/osm/chicago_loop.osm.pbf") else {
        return;
    };
    assert_eq!(
        findings(&city),
        [
            "relation 1870546: no usable height: left out (--default-height gives one) (865 times)",
            "relation 20048625: begins at 6 m, above its height of 6 m: left out (2 times)",
            "way 145208575: building:levels is zero (0 m) (6 times)",
            "way 210671718: lies under the ground: left out (3 times)",
            "way 1178203072: building:levels \"7-7\" is not a height",
            "way 1178533812: height is zero (0 m)",
            "way 24989834: has parts that leave some of it uncovered: that keeps the height of the \
             whole (28 times)",
        ]
    );
    let parts: usize = city.buildings.iter().map(|b| b.parts.len()).sum();
    assert_eq!((city.buildings.len(), parts), (937, 1093));
    assert_eq!(city.facets().len(), 21_938);
    let tops = tops(&city);
    assert_eq!(
        tops.iter().copied().fold(f32::MIN, f32::max),
        527.0,
        "Willis Tower"
    );
    // The Trump Tower is made of eight parts, up to its mast.
    let trump = (city.buildings.iter()).find(|b| b.id.as_deref() == Some("way/64594680"));
    let trump = trump.unwrap();
    let highest = trump
        .parts
        .iter()
        .map(|p| p.range()[1])
        .fold(f32::MIN, f32::max);
    assert_eq!((trump.parts.len(), highest), (8, 423.0));
    // 98 % of it lie within 2.5 km, as its list says.
    let [east, north] = extent(&city);
    assert!(east < 2800.0 && north < 2750.0, "{east} {north}");
}
