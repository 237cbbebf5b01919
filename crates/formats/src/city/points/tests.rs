use super::*;

fn read(text: &str) -> Result<PointFile, String> {
    of_bytes(text.as_bytes()).map_err(|error| error.to_string())
}

#[test]
fn geojson_points_keep_what_is_said_of_them() {
    let text = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": null},
        {"type": "Feature", "id": 7, "properties": {"name": "Café", "floor": 2},
         "geometry": {"type": "Point", "coordinates": [4.36, 52.01, 6.5]}},
        {"type": "Feature", "geometry": {"type": "LineString", "coordinates": []}},
        {"type": "Feature", "id": "m", "geometry":
         {"type": "MultiPoint", "coordinates": [[4.3, 52.0], [4.4, 52.1]]}}]}"#;
    let file = read(text).unwrap();
    let places: Vec<String> = file.points.iter().map(|point| file.place(point)).collect();
    assert_eq!(places, ["feature 1", "feature 3", "feature 3"]);
    assert_eq!(
        (file.points[0].at, file.points[0].height),
        ([4.36, 52.01], 6.5)
    );
    assert_eq!(file.points[0].id.as_deref(), Some("7"));
    assert_eq!(file.points[0].properties["floor"], 2);
    assert_eq!(
        (file.points[2].at, file.points[2].height),
        ([4.4, 52.1], 0.0)
    );
    assert_eq!(file.findings.len(), 2);
    assert!(file.crs.is_some_and(|crs| crs.is_geographic()));
}

#[test]
fn tables_have_the_separators_of_spreadsheets() {
    for text in [
        "id,Lon,LAT,z,name\na,4.36,52.01,3,\"Plein, noord\"\n,4.37,52.02,,007\n",
        "id;Lon;LAT;z;name\r\na;4.36;52.01;3;Plein, noord\r\n;4.37;52.02;;007\r\n",
        "\u{feff}id\tLon\tLAT\tz\tname\na\t4.36\t52.01\t3\tPlein, noord\n\t4.37\t52.02\t\t007",
    ] {
        let file = read(text).unwrap();
        assert_eq!(file.points.len(), 2, "{text}");
        assert_eq!(file.points[0].properties["name"], "Plein, noord");
        assert_eq!(file.points[0].properties.len(), 1);
        assert_eq!(file.points[0].height, 3.0);
        assert_eq!(
            (file.points[0].id.as_deref(), &file.points[1].id),
            (Some("a"), &None)
        );
        assert_eq!(file.points[1].properties["name"], "007");
        assert_eq!(file.place(&file.points[1]), "line 3");
        assert!(file.crs.is_some());
    }
    let file = read("x,y,n\n84600,447400,1.5\n").unwrap();
    assert!(file.crs.is_none());
    assert_eq!(file.points[0].properties["n"], 1.5);
}

#[test]
fn what_is_no_list_of_points_says_where() {
    for (text, told) in [
        ("", "empty"),
        (
            "a,b\n1,2\n",
            "line 1: table: its columns are a, b; lon and lat",
        ),
        ("x,x,y\n1,2,3\n", "\"x\" is there twice"),
        ("x,y\n", "there is none"),
        (
            "x,y\n1,2\n3\n",
            "line 3: table: 1 columns, where the first line names 2",
        ),
        (
            "x,y\n1,\"2,5\"\n",
            "line 2: table: column y: \"2,5\" is no number",
        ),
        ("x,y\n1,nan\n", "is no number"),
        (
            "x,y,z\n1,2,-3\n",
            "line 2: table: z is -3; 0 to 10000 metres above the ground",
        ),
        ("{\"type\": \"CityJSON\"}", "GeoJSON with points"),
        ("[1, 2]", "GeoJSON with points"),
        (
            "PAR1\u{15}\0\u{15},x,y",
            "unknown kind of file; GeoJSON with points or CSV",
        ),
        (
            "{\"type\": \"Point\", \"coordinates\": [1]}",
            "geometry: a point needs two numbers",
        ),
        (
            "{\"type\": \"Point\", \"coordinates\": [1, \"2\"]}",
            "\"2\\\"\" is no number",
        ),
        (
            "{\"type\": \"Point\", \"coordinates\": [1, 2, 1e9]}",
            "z is 1000000000",
        ),
        (
            "{\"type\": \"MultiPoint\", \"coordinates\": 3}",
            "MultiPoint without a list",
        ),
        (
            "{\"type\": \"Polygon\", \"coordinates\": []}",
            "there is none: geometry: Polygon is no point",
        ),
        ("{\"type\": \"Point\", \"coordinates\": [1, 2", "cut short"),
    ] {
        let error = read(text).unwrap_err();
        assert!(
            error.contains(told) || told.contains('\\'),
            "{text}: {error}"
        );
        assert!(!error.contains('\n'), "{error}");
    }
    assert!(
        of_bytes(b"x,y,n\n1,2,\xff\n")
            .unwrap_err()
            .to_string()
            .contains("UTF-8")
    );
}
