use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::record::Field;
use serde_json::json;

use super::*;

const UP: Vector3 = Vector3::new(0.0, 0.0, 1.0);

fn metadata() -> Vec<(String, String)> {
    vec![(
        "command".to_owned(),
        "ombra shadows 'a \"b\".geojson'".to_owned(),
    )]
}

fn known() -> Map<String, Value> {
    let Value::Object(known) = json!({"name": "Plein\n1", "minutes": "mine", "tilt": 1}) else {
        unreachable!("an object is one");
    };
    known
}

fn rows(properties: &Map<String, Value>) -> [PlaceRow<'_>; 3] {
    [
        PlaceRow {
            position: [4.36, 52.01, 1.5],
            minutes: Some(12.3),
            id: Some("é"),
            properties: Some(properties),
            ..PlaceRow::default()
        },
        PlaceRow {
            position: [4.37, 52.0, 0.0],
            inside: true,
            building: Some((7, None)),
            ..PlaceRow::default()
        },
        PlaceRow {
            position: [4.365, 52.02, -30.25],
            minutes: Some(0.0),
            building: Some((8, Some("b8"))),
            surface: Some(("facade", Vector3::new(-1.0, 0.0, 0.0))),
            ..PlaceRow::default()
        },
    ]
}

#[test]
fn which_way_a_face_looks() {
    let (azimuth, tilt) = angles(UP);
    assert_eq!((azimuth, tilt), (None, 0.0));
    assert_eq!(angles(-UP), (None, 180.0));
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (normal, expected) in [
        ([0.0, 1.0, 0.0], (0.0, 90.0)),
        ([half, 0.0, half], (90.0, 45.0)),
        ([0.0, -1.0, 0.0], (180.0, 90.0)),
        ([-1.0, 0.0, 0.0], (270.0, 90.0)),
        ([-1e-6, 1.0, 0.0], (0.0, 90.0)),
    ] {
        let (azimuth, tilt) = angles(normal.into());
        assert_eq!(
            (azimuth, tilt),
            (Some(expected.0), expected.1),
            "{normal:?}"
        );
    }
}

#[test]
fn geojson_says_all_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.geojson");
    write_places_geojson(&path, rows(&known()), &metadata()).unwrap();
    let file: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(file["ombra"]["command"], "ombra shadows 'a \"b\".geojson'");
    let features = &file["features"];
    assert_eq!(features.as_array().unwrap().len(), 3);
    assert_eq!(
        features[0],
        json!({"type": "Feature", "id": "é",
            "geometry": {"type": "Point", "coordinates": [4.36, 52.01, 1.5]},
            "properties": {"name": "Plein\n1", "minutes": 12.3, "inside": false}})
    );
    assert_eq!(
        features[1]["properties"],
        json!({"minutes": null, "inside": true, "building": 7, "building_id": null})
    );
    assert_eq!(
        features[2]["properties"],
        json!({"minutes": 0.0, "inside": false, "building": 8, "building_id": "b8",
            "surface": "facade", "azimuth": 270.0, "tilt": 90.0})
    );
    write_places_geojson(&path, [], &[]).unwrap();
    let file: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(file["features"], json!([]));
}

#[test]
fn geoparquet_says_all_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write_places_parquet(&path, rows(&known()), &metadata()).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    write_places_parquet(&path, rows(&known()), &metadata()).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), bytes, "the same bytes again");

    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let footer = reader.metadata().file_metadata();
    let value = |key: &str| {
        let all = footer.key_value_metadata().unwrap();
        all.iter()
            .find(|entry| entry.key == key)
            .and_then(|entry| entry.value.clone())
            .unwrap()
    };
    assert_eq!(value("command"), "ombra shadows 'a \"b\".geojson'");
    let geo: Value = serde_json::from_str(&value("geo")).unwrap();
    assert_eq!(geo["version"], "1.1.0");
    assert_eq!(geo["primary_column"], "geometry");
    let geometry = &geo["columns"]["geometry"];
    assert_eq!(
        (&geometry["encoding"], &geometry["geometry_types"]),
        (&json!("WKB"), &json!(["Point Z"]))
    );
    assert_eq!(
        geometry["bbox"],
        json!([4.36, 52.0, -30.25, 4.37, 52.02, 1.5])
    );

    let rows: Vec<_> = reader
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let column = |row: usize, name: &str| {
        let mut columns = rows[row].get_column_iter();
        columns
            .find(|(own, _)| *own == name)
            .map(|(_, field)| field.clone())
            .unwrap()
    };
    assert_eq!(rows.len(), 3);
    let Field::Bytes(point) = column(2, "geometry") else {
        panic!("WKB is bytes");
    };
    let mut expected = vec![1, 0xe9, 3, 0, 0];
    expected.extend(
        [4.365_f64, 52.02, -30.25]
            .into_iter()
            .flat_map(f64::to_le_bytes),
    );
    assert_eq!(point.data(), expected);
    for (row, name, expected) in [
        (0, "minutes", Field::Float(12.3)),
        (0, "inside", Field::Bool(false)),
        (0, "building", Field::Null),
        (0, "id", Field::Str("é".to_owned())),
        (1, "minutes", Field::Null),
        (1, "inside", Field::Bool(true)),
        (1, "building", Field::Long(7)),
        (1, "building_id", Field::Null),
        (1, "azimuth", Field::Null),
        (2, "building_id", Field::Str("b8".to_owned())),
        (2, "surface", Field::Str("facade".to_owned())),
        (2, "azimuth", Field::Float(270.0)),
        (2, "tilt", Field::Float(90.0)),
        (2, "properties", Field::Null),
    ] {
        assert_eq!(column(row, name), expected, "{row} {name}");
    }
    let Field::Str(properties) = column(0, "properties") else {
        panic!("JSON is text");
    };
    let properties: Value = serde_json::from_str(&properties).unwrap();
    assert_eq!(properties, Value::Object(known()));
}

#[test]
fn a_change_has_columns_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let known = json!({"net": "mine", "name": "a"});
    let change = PlaceChange {
        before: Some(12.0),
        after: Some(10.5),
        net: Some(-1.5),
    };
    let rows = [
        PlaceRow {
            change: Some(change),
            properties: known.as_object(),
            ..PlaceRow::default()
        },
        PlaceRow {
            change: Some(PlaceChange::default()),
            ..PlaceRow::default()
        },
    ];
    let path = folder.path().join("a.geojson");
    write_places_geojson(&path, rows, &[]).unwrap();
    let file: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let own = &file["features"][0]["properties"];
    let expected = json!({"minutes": null, "inside": false, "name": "a",
        "before": 12.0, "after": 10.5, "net": -1.5});
    assert_eq!(own, &expected);
    let path = folder.path().join("a.parquet");
    write_places_parquet(&path, rows, &[]).unwrap();
    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let nets: Vec<Field> = (reader.get_row_iter(None).unwrap())
        .map(|row| {
            let row = row.unwrap();
            let mut columns = row.get_column_iter();
            columns.find(|(name, _)| *name == "net").unwrap().1.clone()
        })
        .collect();
    assert_eq!(nets, [Field::Float(-1.5), Field::Null]);
}

#[test]
fn many_rows_and_none_are_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    for count in [0, 1, 65_536, 70_000] {
        let rows = (0..count).map(|k| PlaceRow {
            position: [f64::from(k) * 1e-5, 1.0, 2.0],
            minutes: Some(k as f32),
            ..PlaceRow::default()
        });
        write_places_parquet(&path, rows, &[]).unwrap();
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        assert_eq!(
            reader.metadata().file_metadata().num_rows(),
            i64::from(count)
        );
        assert_eq!(reader.get_row_iter(None).unwrap().count(), count as usize);
    }
    let error = write_places_parquet(folder.path().join("no/a.parquet"), [], &[]).unwrap_err();
    assert!(error.to_string().contains("does not exist"));
}
