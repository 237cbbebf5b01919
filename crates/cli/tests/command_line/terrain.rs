//! Surface models, terrain under a city, and models beside it.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use crate::{fail, outside_data, run, succeed};

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
fn neither_a_hill_nor_a_far_model_is_the_city() {
    let folder = tempfile::tempdir().unwrap();
    house(&folder.path().join("house.geojson"));
    height_field(&folder.path().join("hill.tif"), |c, r| {
        if c < 4 && r < 4 { 390.0 } else { 300.0 }
    });
    std::fs::write(
        folder.path().join("mast.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 0 200\nf 1 2 3\n",
    )
    .unwrap();
    let area = "500038,5800038,500044,5800044";
    let base = [
        "house.geojson",
        DAY[0],
        DAY[1],
        "--area",
        area,
        "--on",
        "roofs",
    ];
    let around = |more: &[&str]| {
        let told = json(folder.path(), &[&base, more].concat());
        let around = &told["surroundings"];
        [
            "tallest",
            "margin",
            "uncertain_below",
            "uncertain_share",
            "lowest_sun",
        ]
        .map(|name| around[name].as_f64().unwrap())
    };
    let near = |a: [f64; 5], b: [f64; 5]| a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.1);
    let alone = around(&[]);
    let [tallest, margin, below, share, _] = alone;
    assert!(
        tallest.abs() < 0.1 && (1.5..4.5).contains(&margin),
        "{alone:?}"
    );
    assert!(below < 1.0 && share < 0.05, "{alone:?}");
    let hill = around(&["--terrain", "hill.tif"]);
    assert!(near(hill, alone), "{hill:?} and {alone:?}");
    let mast = around(&[
        "--context",
        "mast.obj",
        "--context-origin",
        "502000,5800040",
    ]);
    assert!(near(mast, alone), "{mast:?} and {alone:?}");

    // The sun never is so low: nothing, and not minus nothing, of the time.
    let high = json(
        folder.path(),
        &[&base[..], &["--min-altitude", "5"]].concat(),
    );
    let share = high["surroundings"]["uncertain_share"].as_f64().unwrap();
    assert!(share == 0.0 && share.is_sign_positive(), "{share}");
    // The lower rim of a disc is lower by its radius.
    let disc = json(
        folder.path(),
        &[&base[..], &["--min-altitude", "5", "--disc"]].concat(),
    );
    let lowest = |told: &Value| told["surroundings"]["lowest_sun"].as_f64().unwrap();
    let radius = lowest(&high) - lowest(&disc);
    assert!((0.26..0.28).contains(&radius), "{radius}");
    let all = [&["shadows"], &base[..], &["--min-altitude", "5"]].concat();
    let talk = String::from_utf8(run(folder.path(), &all).stderr).unwrap();
    assert!(talk.contains(": 1 building, "), "{talk}");
    assert!(talk.contains("nothing is missing"), "{talk}");
}

#[test]
fn points_on_roofs_of_a_surface_model_are_inside_and_models_stand_on_the_bare_ground() {
    let folder = tempfile::tempdir().unwrap();
    let tower = |c, r| {
        if (15..20).contains(&c) && (15..20).contains(&r) {
            40.0
        } else {
            10.0 + c as f32
        }
    };
    height_field(&folder.path().join("dsm.tif"), tower);
    height_field(&folder.path().join("dem.tif"), |c, _| 10.0 + c as f32);
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("roof.csv", "x,y,z\n500034,5800048,3\n");
    write("both.csv", "x,y\n500034,5800048\n500060,5800060\n");
    write("beside.csv", "x,y\n500034,5800048\n500560,5800060\n");
    let base = [
        "dsm.tif",
        "--terrain",
        "dem.tif",
        DAY[0],
        DAY[1],
        "--points",
    ];
    let told = json(
        folder.path(),
        &[&base[..], &["both.csv", "-o", "a.geojson"]].concat(),
    );
    assert_eq!((&told["places"], &told["hidden"]), (&1.into(), &1.into()));
    let text = std::fs::read(folder.path().join("a.geojson")).unwrap();
    let written: Value = serde_json::from_slice(&text).unwrap();
    let inside = |k: usize| {
        written["features"][k]["properties"]["inside"]
            .as_bool()
            .unwrap()
    };
    assert!(inside(0) && !inside(1), "{written}");
    assert!(written["features"][0]["properties"]["minutes"].is_null());
    let told = |name: &str| {
        fail(
            folder.path(),
            &[&["shadows", "--quiet"], &base[..], &[name]].concat(),
            1,
        )
    };
    let roof = told("roof.csv");
    assert!(roof.contains("roof.csv: its point lies inside"), "{roof}");
    assert!(told("beside.csv").contains("beside.csv: line 3"));

    // A floor of 4 m by 4 m, 25 m above its origin, which stands on the tower's pixels: 10 m + 17.5 m of ground. It hangs
    // above the roof, not 7.5 m below it.
    write(
        "floor.obj",
        "v -2 -2 25\nv 2 -2 25\nv 2 2 25\nv -2 2 25\nf 1 2 3 4\n",
    );
    let mean = |origin: &str| {
        let more = [
            "both.csv",
            "--context",
            "floor.obj",
            "--context-origin",
            origin,
        ];
        let told = json(folder.path(), &[&base[..], &more].concat());
        told["minutes_mean"].as_f64().unwrap()
    };
    let on_ground = mean("500036,5800046");
    // The middles of pixels lie 1 m in from their corners.
    let same = mean("500036,5800046,27.5");
    assert!((on_ground - same).abs() < 1e-3, "{on_ground} and {same}");
    let nowhere = [
        "shadows",
        "dsm.tif",
        DAY[0],
        DAY[1],
        "--context",
        "floor.obj",
        "--context-origin",
    ];
    let talk = fail(
        folder.path(),
        &[&nowhere[..], &["500500,5800046"]].concat(),
        1,
    );
    assert!(
        talk.contains("floor.obj: there is no ground") && talk.contains("E,N,H"),
        "{talk}"
    );
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
