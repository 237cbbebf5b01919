//! Surface models, terrain under a city, and models beside it.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use crate::{fail, outside_data, succeed};

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let all = [&["shadows"], arguments, &["--json", "--quiet"]].concat();
    serde_json::from_str(&succeed(folder, &all)).unwrap()
}

const DAY: [&str; 2] = ["--date", "2026-03-20"];

/// A TIFF of 41 by 41 pixels of 2 m in UTM zone 33, north up, of 32-bit floating-point numbers.
fn height_field(path: &Path, z: impl Fn(u32, u32) -> f32) {
    const SIZE: u32 = 41;
    let entries: [(u16, u16, u32, u32); 13] = [
        (256, 4, 1, SIZE),
        (257, 4, 1, SIZE),
        (258, 3, 1, 32),
        (259, 3, 1, 1),
        (262, 3, 1, 1),
        (273, 4, 1, 400),
        (277, 3, 1, 1),
        (278, 4, 1, SIZE),
        (279, 4, 1, 4 * SIZE * SIZE),
        (339, 3, 1, 3),
        (33550, 12, 3, 200),
        (33922, 12, 6, 224),
        (34735, 3, 12, 272),
    ];
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.resize(200, 0);
    let doubles = [
        2.0,
        2.0,
        0.0,
        0.0,
        0.0,
        0.0,
        500_000.0,
        5_800_082.0,
        0.0_f64,
    ];
    bytes.extend(doubles.iter().flat_map(|x| x.to_le_bytes()));
    let keys = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633_u16];
    bytes.extend(keys.iter().flat_map(|x| x.to_le_bytes()));
    bytes.resize(400, 0);
    for row in 0..SIZE {
        for column in 0..SIZE {
            bytes.extend(z(column, row).to_le_bytes());
        }
    }
    std::fs::write(path, bytes).unwrap();
}

/// A house of 10 m by 10 m, 12 m tall, in the middle of that.
fn house(path: &Path) {
    let corners = [[36, 36], [46, 36], [46, 46], [36, 46], [36, 36]];
    let ring = corners.map(|[x, y]| format!("[{}, {}]", 500_000 + x, 5_800_000 + y));
    let text = format!(
        r#"{{"type": "FeatureCollection", "crs": {{"properties": {{"name": "EPSG:32633"}}}}, "features": [{{"type": "Feature",
        "properties": {{"height": 12}}, "geometry": {{"type": "Polygon", "coordinates": [[{}]]}}}}]}}"#,
        ring.join(", ")
    );
    std::fs::write(path, text).unwrap();
}

#[test]
fn a_surface_model_is_measured_and_both_methods_agree() {
    let folder = tempfile::tempdir().unwrap();
    let tower = |c, r| {
        if (15..20).contains(&c) && (15..20).contains(&r) {
            40.0
        } else {
            10.0
        }
    };
    height_field(&folder.path().join("dsm.tif"), tower);
    height_field(&folder.path().join("dem.tif"), |_, _| 10.0);
    let mean = |more: &[&str]| {
        let told = json(
            folder.path(),
            &[&["dsm.tif", DAY[0], DAY[1], "--cell", "2"], more].concat(),
        );
        (
            told["minutes_mean"].as_f64().unwrap(),
            told["places"].as_u64().unwrap(),
        )
    };
    let (all, places) = mean(&["-o", "a.tif"]);
    assert_eq!(places, 40 * 40, "the middles of pixels lie 80 m apart");
    assert!(all > 30.0, "{all}");
    let (sampled, _) = mean(&["--method", "sampled"]);
    assert!((all - sampled).abs() < 1.0, "{all} and {sampled}");
    let (_, ground) = mean(&["--terrain", "dem.tif"]);
    assert_eq!(ground, 1600 - 36, "less the tower and its walls");
    let info = succeed(folder.path(), &["info", "dsm.tif"]);
    for line in [
        "format      GeoTIFF, heights",
        "size        41x41 pixels",
        "numbers     32-bit floating-point numbers",
        "crs         EPSG:32633",
        "heights     10.00 m to 40.00 m",
    ] {
        assert!(info.contains(line), "{info}");
    }
}

#[test]
fn terrain_and_models_cast_shadow_on_a_city() {
    let folder = tempfile::tempdir().unwrap();
    house(&folder.path().join("house.geojson"));
    height_field(&folder.path().join("flat.tif"), |_, _| 300.0);
    // A ridge along the south.
    height_field(&folder.path().join("ridge.tif"), |_, r| {
        if r > 35 { 330.0 } else { 300.0 }
    });
    let mut wall = String::new();
    for [x, z] in [[-20, 0], [20, 0], [20, 25], [-20, 25]] {
        writeln!(wall, "v {x} 0 {z}").unwrap();
    }
    std::fs::write(folder.path().join("wall.obj"), wall + "f 1 2 3 4\n").unwrap();
    let mean = |more: &[&str]| {
        let area = "500030,5800030,500060,5800060";
        let base = ["house.geojson", DAY[0], DAY[1], "--area", area];
        let told = json(folder.path(), &[&base, more].concat());
        assert_eq!(told["buildings"], 1);
        told["minutes_mean"].as_f64().unwrap()
    };
    let flat = mean(&[]);
    let on_terrain = mean(&["--terrain", "flat.tif"]);
    assert!((flat - on_terrain).abs() < 0.5, "{flat} and {on_terrain}");
    assert!(mean(&["--terrain", "ridge.tif"]) > flat + 60.0);
    let origin = "500041,5800025";
    let wall = ["--context", "wall.obj", "--context-origin", origin];
    let with_wall = mean(&wall);
    assert!(with_wall > flat + 60.0, "{with_wall} and {flat}");
    let on_both = mean(&[&wall[..], &["--terrain", "flat.tif"]].concat());
    assert!(
        (with_wall - on_both).abs() < 0.5,
        "{with_wall} and {on_both}"
    );
    // As if y were up, it lies on the ground.
    let lying = mean(&[&wall[..], &["--context-up", "y"]].concat());
    assert!((lying - flat).abs() < 1.0, "{lying} and {flat}");
    let deep = [
        "--context",
        "wall.obj",
        "--context-origin",
        "500041,5800025,-25",
    ];
    assert!((mean(&deep) - flat).abs() < 0.5);
}

#[test]
fn what_is_asked_wrongly_of_surroundings_is_told() {
    let folder = tempfile::tempdir().unwrap();
    house(&folder.path().join("house.geojson"));
    height_field(&folder.path().join("dem.tif"), |_, _| f32::NAN);
    std::fs::write(
        folder.path().join("a.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 9\nf 1 2 3\n",
    )
    .unwrap();
    let base = ["shadows", "house.geojson", DAY[0], DAY[1]];
    let told = |more: &[&str], code| fail(folder.path(), &[&base, more].concat(), code);
    assert!(told(&["--context", "a.obj"], 2).contains("--context-origin"));
    assert!(told(&["--context-origin", "1,2"], 2).contains("--context"));
    assert!(told(&["--terrain-crs", "EPSG:25833"], 2).contains("--terrain"));
    let wrong = ["--context", "a.obj", "--context-origin", "1,x"];
    assert!(told(&wrong, 2).contains("east,north"));
    let two = ["--context-origin", "1,2", "--context-origin", "3,4"];
    assert!(told(&[&["--context", "a.obj"], &two[..]].concat(), 2).contains("one each"));
    let far = ["--context", "a.obj", "--context-origin", "0,0"];
    assert!(told(&far, 1).contains("a.obj: the origin of the model"));
    assert!(told(&["--terrain", "dem.tif"], 1).contains("dem.tif: no pixel has a height"));
    assert!(told(&["--terrain", "house.geojson"], 1).contains("GeoTIFF"));
    assert!(told(&["--terrain", "none.tif"], 1).contains("none.tif"));
    let demo = ["shadows", "demo", DAY[0], DAY[1], "--terrain", "flat.tif"];
    height_field(&folder.path().join("flat.tif"), |_, _| 3.0);
    let talk = fail(folder.path(), &demo, 1);
    assert!(
        talk.contains("flat.tif: no height lies within reach"),
        "{talk}"
    );
}

#[test]
fn a_real_surface_model_is_measured() {
    let Some(data) = outside_data() else { return };
    let folder = tempfile::tempdir().unwrap();
    let [dsm, dem] = ["DSM.tif", "DEM.tif"].map(|name| {
        let path = data.join("city/dsm_athens").join(name);
        path.to_str().unwrap().to_owned()
    });
    let area = "476950,4206000,477050,4206100";
    let hours = [
        "--date",
        "2026-12-21",
        "--min-altitude",
        "10",
        "--area",
        area,
        "--cell",
        "2",
    ];
    let mean = |method: &[&str]| {
        let all = [&[dsm.as_str(), "--terrain", &dem], &hours[..], method].concat();
        let told = json(folder.path(), &all);
        assert_eq!(told["time_zone"], "Europe/Athens");
        (
            told["places"].as_u64().unwrap(),
            told["minutes_mean"].as_f64().unwrap(),
        )
    };
    let ((places, exact), (_, sampled)) = (mean(&[]), mean(&["--method", "sampled"]));
    assert!(
        (400..2400).contains(&places),
        "{places} of 2500 are streets and yards"
    );
    assert!((exact - sampled).abs() < 1.0, "{exact} and {sampled}");
}
