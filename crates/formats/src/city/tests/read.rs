//! What the formats can say.

use ombra_city::heights::Heights;
use ombra_city::{Crs, Part};

use super::super::CityOptions;
use super::{findings, read, read_with, tops};

pub(in super::super) const GEOJSON: &str = r#"{"type":"FeatureCollection",
"features":[
 {"type":"Feature","id":"a","properties":{"height":"10 m","min_height":2},
  "geometry":{"type":"Polygon","coordinates":[[[0,0],[0.001,0],[0.001,0.001],[0,0.001],[0,0]]]}},
 {"type":"Feature","id":7,"properties":{"building:levels":3},
  "geometry":{"type":"GeometryCollection","geometries":[
   {"type":"MultiPolygon","coordinates":[
    [[[0.002,0,5],[0.003,0,6],[0.003,0.001,5],[0.002,0,5]]],
    [[[0.004,0,5],[0.005,0,4],[0.005,0.001,5],[0.004,0,5]]]]},
   {"type":"LineString","coordinates":[[0,0],[1,1]]}]}}]}"#;

pub(in super::super) const LIST: &str = r#"[{"height":30,"polygon":[[0,0],[0.001,0],[0.001,0.001]]},
 {"height":12.5,"polygon":[[[0.002,0],[0.003,0],[0.003,0.001],[0.002,0]]]},{"height":1}]"#;

pub(in super::super) const CITYJSON: &str = r#"{"type":"CityJSON","version":"1.1",
"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},
"transform":{"scale":[0.001,0.001,0.001],"translate":[90000,435000,0]},
"CityObjects":{
 "b":{"type":"Building","attributes":{"TerrainHeight":1.5},"children":["p"],"geometry":[
  {"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3]]]}]},
 "p":{"type":"BuildingPart","parents":["b"],"geometry":[
  {"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]},
  {"type":"Solid","lod":"2.2","boundaries":[[[[3,2,1,0]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],
   [[2,3,7,6]],[[3,0,4,7]]]],"semantics":{"surfaces":[{"type":"RoofSurface"},{"type":"GroundSurface"}],
   "values":[[1,0,null,null,null,null]]}}]},
 "t":{"type":"TINRelief","geometry":[{"type":"CompositeSurface","lod":"1",
  "boundaries":[[[0,1,2]],[[0,2,3]]]}]},
 "r":{"type":"Road","geometry":[]}},
"vertices":[[0,0,0],[10000,0,0],[10000,10000,0],[0,10000,0],
 [0,0,9000],[10000,0,9000],[10000,10000,9000],[0,10000,9000]]}"#;

#[test]
fn geojson() {
    let city = read(GEOJSON).unwrap();
    assert_eq!(
        findings(&city),
        ["feature 1: LineString is no polygon: left out"]
    );
    let [a, b] = &city.buildings[..] else {
        panic!("two buildings");
    };
    assert_eq!((a.id.as_deref(), b.id.as_deref()), (Some("a"), Some("7")));
    assert_eq!((a.parts.len(), b.parts.len()), (1, 2));
    assert_eq!(a.parts[0].range(), [2.0, 10.0]);
    // z of the ground is the lowest of the corners; three levels stand on it.
    assert_eq!(b.ground, 4.0);
    assert_eq!(b.parts[0].range(), [4.0, 13.0]);
    // A hangs 2 m above its ground: six faces. The triangles have three walls and a roof each.
    assert_eq!(city.facets().len(), 6 + 2 * 4);
    let Part::Prism(prism) = &a.parts[0] else {
        panic!("an outline makes a prism");
    };
    // 111.32 m by 110.57 m at the equator.
    assert!((prism.outline.area() - 111.32 * 110.57).abs() < 20.0);
}

#[test]
fn a_feature_and_a_geometry_alone() {
    let polygon = r#"{"type":"Polygon","coordinates":[[[0,0],[0.001,0],[0.001,0.001],[0,0]]]}"#;
    let feature =
        format!(r#"{{"type":"Feature","properties":{{"HEIGHT":8}},"geometry":{polygon}}}"#);
    assert_eq!(tops(&read(&feature).unwrap()), [8.0]);
    assert!(
        read(polygon)
            .unwrap_err()
            .contains("geometry: no usable height")
    );
    let options = CityOptions {
        heights: Heights {
            default: Some(5.0),
            ..Heights::default()
        },
        ..CityOptions::default()
    };
    assert_eq!(tops(&read_with(polygon, &options).unwrap()), [5.0]);
}

#[test]
fn the_reference_system_is_that_of_the_file_or_the_one_asked_for() {
    let metres = |crs: &str| {
        format!(
            r#"{{"features":[{{"type":"Feature","properties":{{"height":8}},"geometry":
            {{"type":"Polygon","coordinates":[[[500000,5800000],[500010,5800000],[500010,5800010],
            [500000,5800000]]]}}}}],{crs}"type":"FeatureCollection"}}"#
        )
    };
    let named = r#""crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32633"}},"#;
    let city = read(&metres(named)).unwrap();
    assert_eq!(city.origin.crs().name(), "EPSG:32633");
    assert!((city.origin.longitude() - 15.0).abs() < 0.01);
    let error = read(&metres("")).unwrap_err();
    assert!(error.contains("lie outside of OGC:CRS84"), "{error}");
    let error = read(&metres(&named.replace("32633", "1"))).unwrap_err();
    assert!(error.contains("EPSG:1"), "{error}");
    let options = CityOptions {
        crs: Some(Crs::from_epsg(32633).unwrap()),
        ..CityOptions::default()
    };
    assert!(read_with(&metres(""), &options).is_ok());
}

#[test]
fn a_list_of_polygons() {
    let city = read(LIST).unwrap();
    assert_eq!(tops(&city), [30.0, 12.5]);
    assert_eq!(
        findings(&city),
        ["polygon 2: no \"polygon\" in it: left out"]
    );
}

#[test]
fn cityjson() {
    let city = read(CITYJSON).unwrap();
    assert_eq!(
        findings(&city),
        [
            "CityObject b: less detailed than its parts, which are used instead",
            "CityObject r: Road is no building: left out",
        ]
    );
    assert_eq!(city.buildings.len(), 1);
    let building = &city.buildings[0];
    assert_eq!(building.id.as_deref(), Some("b"));
    assert_eq!(building.ground_elevation, Some(1.5));
    let Part::Faces(faces) = &building.parts[0] else {
        panic!("faces stay faces");
    };
    assert!(faces.is_closed);
    assert_eq!(faces.faces.len(), 6);
    assert_eq!(city.terrain.len(), 2);
    let facets = city.facets();
    assert_eq!(facets.len(), 8);
    assert_eq!(facets.iter().filter(|f| f.is_two_sided).count(), 2);
}

pub(in super::super) const CITYJSONSEQ: &str = r#"{"type":"CityJSON","version":"2.0","CityObjects":{},"vertices":[],
"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},
"transform":{"scale":[0.01,0.01,0.01],"translate":[90000,435000,0]}}
{"type":"CityJSONFeature","id":"a","CityObjects":{
 "a":{"type":"Building","children":["a-0"]},
 "a-0":{"type":"BuildingPart","parents":["a"],"geometry":[{"type":"Solid","lod":"1","boundaries":[[
  [[0,2,1]],[[3,4,5]],[[0,1,4,3]],[[1,2,5,4]],[[2,0,3,5]]]]}]}},
 "vertices":[[0,0,0],[1000,0,0],[0,1000,0],[0,0,700],[1000,0,700],[0,1000,700]]}
{"type":"CityJSONFeature","id":"b","CityObjects":{
 "b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}},
 "vertices":[[2000,0,400],[3000,0,400],[2000,1000,400]]}
"#;

#[test]
fn a_sequence_of_cityjson() {
    let city = read(CITYJSONSEQ).unwrap();
    let ids: Vec<_> = city
        .buildings
        .iter()
        .filter_map(|b| b.id.as_deref())
        .collect();
    assert_eq!(ids, ["a", "b"]);
    assert_eq!(tops(&city), [7.0, 4.0]);
    assert_eq!(
        findings(&city),
        ["CityObject b: faces enclose no solid: both of their sides cast shadow"]
    );
    for (from, to, told) in [
        ("[3000,0,400]", "", "JSON: "),
        (
            "\"type\":\"CityJSONFeature\",\"id\":\"b\"",
            "\"type\":\"Feature\",\"id\":\"b\"",
            "document b: is a Feature",
        ),
        (
            "[[0,1,2]]",
            "[[0,1,3]]",
            "CityObject b: uses vertex 3, 3 present",
        ),
        ("\"version\"", "\"edition\"", "version: null found"),
        ("\"scale\"", "\"scales\"", "missing field `scale`"),
    ] {
        let error = read(&CITYJSONSEQ.replacen(from, to, 1)).unwrap_err();
        assert!(error.contains(told), "{error}");
    }
    let cut = CITYJSONSEQ.len() - 20;
    let error = read(&CITYJSONSEQ[..cut]).unwrap_err();
    assert!(error.contains(&format!("byte {cut}: JSON: EOF")), "{error}");
}

#[test]
fn what_a_document_lacks_is_named() {
    for (from, to, told) in [
        (
            "\"version\":\"1.1\"",
            "\"version\":\"3.0\"",
            "version: \"3.0\" found",
        ),
        (
            "referenceSystem",
            "reference",
            "metadata.referenceSystem: is missing",
        ),
        ("EPSG/0/7415", "EPSG/0/999999", "is not known"),
        ("[[3,2,1,0]]", "[[3,2,1,-1]]", "an index from 0"),
        ("[[3,2,1,0]]", "[[[3,2,1,0]]]", "not as deep"),
        ("\"vertices\"", "\"vertexes\"", "missing field `vertices`"),
        ("435000", "1e300", "lie outside of"),
    ] {
        let text = CITYJSON.replacen(from, to, 1);
        let error = read(&text).unwrap_err();
        assert!(error.contains(told), "{error}");
    }
    for (text, told) in [
        ("", "file is empty"),
        ("<svg/>", "unknown kind of file"),
        ("<osm/>", "no building that could be placed"),
        ("{\"type\":\"Topology\"}", "unknown kind of file"),
        (
            "{\"type\":\"FeatureCollection\"}",
            "\"features\" is missing",
        ),
        (
            "{\"type\":\"FeatureCollection\",\"features\":3}",
            "expected a list",
        ),
        (
            "{\"type\":\"FeatureCollection\",\"features\":[]}",
            "no building that could be placed",
        ),
        ("[]", "no building that could be placed"),
        ("[1,[2],null]", "no \"polygon\" in it"),
    ] {
        let error = read(text).unwrap_err();
        assert!(error.contains(told), "{error}");
    }
    let deep = "[".repeat(100_000);
    assert!(read(&deep).is_err());
    let deep = format!("[{}{}]", "[".repeat(1000), "]".repeat(1000));
    assert!(read(&deep).unwrap_err().contains("recursion"));
}
