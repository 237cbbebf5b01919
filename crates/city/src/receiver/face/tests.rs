use super::*;
use crate::crs::Crs;
use crate::draft::{Draft, DraftBuilding, DraftFace, DraftPart};

fn at(x: f64, y: f64) -> [f64; 2] {
    [500_000.0 + x, 5_800_000.0 + y]
}

fn city(parts: Vec<DraftPart>) -> City {
    let mut draft = Draft::new(Crs::from_epsg(32633).unwrap());
    draft
        .buildings
        .extend(parts.into_iter().map(|part| DraftBuilding {
            place: "test".to_owned(),
            parts: vec![part],
            ..DraftBuilding::default()
        }));
    draft.finish().unwrap()
}

/// A box of so many metres to the east and to the north.
fn block([x, y]: [f64; 2], [width, depth]: [f64; 2], top: f64) -> DraftPart {
    let ring = vec![
        at(x, y),
        at(x + width, y),
        at(x + width, y + depth),
        at(x, y + depth),
    ];
    DraftPart::Footprint {
        rings: vec![ring],
        base: 0.0,
        top,
    }
}

/// Faces of a roof and walls of one pitch each, open: nothing tells which side is out.
fn open(rings: Vec<Vec<[f64; 3]>>) -> DraftPart {
    let face = |ring: Vec<[f64; 3]>| DraftFace {
        rings: vec![
            ring.into_iter()
                .map(|[x, y, z]| [at(x, y)[0], at(x, y)[1], z])
                .collect(),
        ],
        surface: Surface::Untold,
    };
    DraftPart::Faces(rings.into_iter().map(face).collect())
}

#[test]
fn a_block_has_a_lattice_on_each_face() {
    let city = city(vec![block([0.0, 0.0], [12.0, 6.0], 9.0)]);
    let walls = city.face_places(FaceKind::Facade, 3.0, |_| true).unwrap();
    assert_eq!(walls.len(), 2 * 4 * 3 + 2 * 2 * 3);
    let outer = crate::polygon::Polygon::bounds(match &city.buildings[0].parts[0] {
        Part::Prism(prism) => &prism.outline,
        Part::Faces(_) => panic!("a block is a prism"),
    });
    for place in &walls {
        let (p, n) = (place.at, place.normal);
        assert!((n.length() - 1.0).abs() < 1e-6 && n.z.abs() < 1e-6);
        // 2 cm before the wall that it looks away from.
        let off = [
            p.x - outer[1][0],
            outer[0][0] - p.x,
            p.y - outer[1][1],
            outer[0][1] - p.y,
        ];
        let off = off.into_iter().fold(f32::MIN, f32::max);
        assert!((off - 0.02).abs() < 1e-3, "{off}");
        let up = (p.z - 1.5) / 3.0;
        assert!(
            (up - up.round()).abs() < 1e-3,
            "in the middle of a cell: {}",
            p.z
        );
    }
    let roof = city.face_places(FaceKind::Roof, 3.0, |_| true).unwrap();
    assert_eq!(roof.len(), 4 * 2);
    assert!(roof.iter().all(|place| (place.at.z - 9.02).abs() < 1e-4));
    let eastern = city
        .face_places(FaceKind::Roof, 3.0, |[x, _]| {
            x > f64::from(outer[0][0]) + 6.0
        })
        .unwrap();
    assert_eq!(eastern.len(), 2 * 2);
    assert!(
        roof.iter()
            .all(|place| place.normal.z == 1.0 && place.building == 0)
    );
}

#[test]
fn small_and_odd_faces_have_a_place() {
    // An L: the middle of its box is not in it.
    let ring = [
        (0., 0.),
        (20., 0.),
        (20., 1.),
        (1., 1.),
        (1., 20.),
        (0., 20.),
    ];
    let ring = ring.into_iter().map(|(x, y)| at(x, y)).collect();
    let city = city(vec![DraftPart::Footprint {
        rings: vec![ring],
        base: 0.0,
        top: 2.0,
    }]);
    let roof = city.face_places(FaceKind::Roof, 100.0, |_| true).unwrap();
    assert_eq!(roof.len(), 1);
    let at = roof[0].at;
    let Part::Prism(prism) = &city.buildings[0].parts[0] else {
        panic!("an outline is a prism");
    };
    assert!(prism.outline.contains([at.x, at.y]));
    assert_eq!(
        city.face_places(FaceKind::Facade, 100.0, |_| true)
            .unwrap()
            .len(),
        6
    );
}

#[test]
fn a_roof_that_nothing_encloses_faces_up_and_a_wall_away_from_the_building() {
    let roof = vec![[0., 0., 5.], [0., 8., 5.], [8., 8., 7.], [8., 0., 7.]];
    // Turned inward, as some files have them.
    let wall = vec![[0., 0., 0.], [0., 0., 5.], [8., 0., 7.], [8., 0., 0.]];
    let city = city(vec![open(vec![roof, wall])]);
    let roofs = city.face_places(FaceKind::Roof, 2.0, |_| true).unwrap();
    assert_eq!(roofs.len(), 4 * 5, "8.25 m upslope");
    assert!(roofs.iter().all(|place| place.normal.z > 0.9));
    let walls = city.face_places(FaceKind::Facade, 2.0, |_| true).unwrap();
    assert!(!walls.is_empty());
    assert!(walls.iter().all(|place| place.normal.y < -0.99), "south");
    assert!(walls.iter().all(|place| place.at.z < 7.0));
}

#[test]
fn a_bent_face_is_followed() {
    let saddle = vec![[0., 0., 5.], [8., 0., 8.], [8., 8., 5.], [0., 8., 8.]];
    let city = city(vec![open(vec![saddle])]);
    let roofs = city.face_places(FaceKind::Roof, 1.0, |_| true).unwrap();
    assert!(roofs.len() > 60, "{}", roofs.len());
    // Two triangles meet in one of the diagonals: none of their places is as high as the saddle's plane in all corners.
    let facets = city.facets();
    for place in &roofs {
        let off = facets.iter().map(|facet| {
            let plane = Plane::of(&facet.corners[..3]).unwrap();
            plane.distance(place.at).abs()
        });
        let off = off.fold(f64::MAX, f64::min);
        assert!((off - STAND_OFF).abs() < 1e-3 || off < STAND_OFF, "{off}");
    }
}

#[test]
fn what_cannot_be_sampled_says_so() {
    let city = city(vec![block([0.0, 0.0], [2000.0, 2000.0], 9.0)]);
    for cell in [0.0, -1.0, f64::NAN, 1e9] {
        let error = city
            .face_places(FaceKind::Roof, cell, |_| true)
            .unwrap_err();
        assert!(matches!(error, GridError::Cell(_)));
    }
    let error = city
        .face_places(FaceKind::Roof, 0.01, |_| true)
        .unwrap_err();
    assert_eq!(error, GridError::ManyPlaces);
}

#[test]
fn a_place_lies_in_the_middle_of_its_cell_of_its_chart() {
    let city = city(vec![
        block([0.0, 0.0], [10.0, 7.0], 12.0),
        block([30.0, 5.0], [0.4, 3.0], 1.0),
    ]);
    for kind in [FaceKind::Roof, FaceKind::Facade] {
        let charts: Vec<FaceChart> = city.face_charts(kind, 2.0).collect();
        assert_eq!(charts.len(), if kind == FaceKind::Roof { 2 } else { 8 });
        let places = city.face_places(kind, 2.0, |_| true).unwrap();
        for place in &places {
            let chart = &charts[place.face as usize];
            assert!((0..2).all(|k| place.cell[k] < chart.count[k]));
            // All faces here are rectangles: two triangles from corner to corner.
            let corner = |cells: [f64; 2]| {
                let all = chart
                    .in_cells
                    .as_flattened()
                    .iter()
                    .zip(chart.triangles.as_flattened());
                let nearest = |at: &[f64; 2]| (at[0] - cells[0]).hypot(at[1] - cells[1]);
                let (_, at) = all
                    .min_by(|a, b| nearest(a.0).total_cmp(&nearest(b.0)))
                    .unwrap();
                *at
            };
            let [columns, rows] = chart.count.map(f64::from);
            let (from, right, up) = (
                corner([0.0; 2]),
                corner([columns, 0.0]),
                corner([0.0, rows]),
            );
            let [u, v] = [0, 1].map(|k| (place.cell[k] as f32 + 0.5) / chart.count[k] as f32);
            let at = from + (right - from) * u + (up - from) * v;
            assert!(
                (at - place.at).length() < 1e-3,
                "{at:?}, not {:?}",
                place.at
            );
        }
    }
}
