use super::*;

fn origin() -> Origin {
    Origin::new(Crs::wgs84(), [4.36, 52.01]).unwrap()
}

/// Polygons in metres about the origin.
fn area(polygons: &[&[&[[f64; 2]]]]) -> Result<StudyArea, StudyError> {
    let origin = origin();
    let map = |p: &[f64; 2]| origin.to_map(*p);
    let polygons: Vec<Vec<Vec<[f64; 2]>>> = (polygons.iter())
        .map(|rings| {
            rings
                .iter()
                .map(|ring| ring.iter().map(map).collect())
                .collect()
        })
        .collect();
    StudyArea::new(&origin, origin.crs(), &polygons)
}

const fn square(low: f64, high: f64) -> [[f64; 2]; 5] {
    [
        [low, low],
        [high, low],
        [high, high],
        [low, high],
        [low, low],
    ]
}

#[test]
fn holes_and_several_polygons() {
    let (all, hole, island) = (square(0.0, 90.0), square(10.0, 50.0), square(20.0, 30.0));
    let apart = [[200.0, 0.0], [260.0, 0.0], [200.0, 80.0]];
    let area = area(&[
        &[&all, &hole],
        &[&island],
        &[&apart],
        &[&square(80.0, 120.0)],
    ])
    .unwrap();
    for (place, is_in) in [
        ([5.0, 5.0], true),
        ([15.0, 15.0], false),
        ([25.0, 25.0], true),
        ([60.0, 60.0], true),
        ([210.0, 10.0], true),
        ([250.0, 70.0], false),
        ([85.0, 85.0], true),
        ([110.0, 110.0], true),
        ([150.0, 40.0], false),
        ([-1.0, 40.0], false),
        ([40.0, 1e9], false),
        ([f64::NAN, 40.0], false),
    ] {
        assert_eq!(area.contains(place), is_in, "{place:?}");
    }
    let [low, high] = area.bounds();
    for (found, expected) in low.into_iter().chain(high).zip([0.0, 0.0, 260.0, 120.0]) {
        assert!((found - expected).abs() < 0.01, "{found}, not {expected}");
    }
}

#[test]
fn strips_change_nothing() {
    // A comb of many teeth: long sides and short ones.
    let mut comb = vec![[0.0, 0.0]];
    for tooth in 0..200 {
        let x = f64::from(tooth);
        comb.extend([[x, 100.0 - f64::from(tooth % 7)], [x + 0.5, 1.0]]);
    }
    comb.push([200.0, 0.0]);
    let area = area(&[&[&comb]]).unwrap();
    for k in 0..5000 {
        let place = [f64::from(k % 97) * 2.1, f64::from(k % 89) * 1.17];
        let plainly = area
            .sides
            .iter()
            .fold(false, |inside, side| inside ^ side.is_east_of(place));
        assert_eq!(area.contains(place), plainly, "{place:?}");
    }
}

#[test]
fn a_bow_tie_has_two_wings() {
    let area = area(&[&[&[[0.0, 0.0], [40.0, 40.0], [40.0, 0.0], [0.0, 40.0]]]]).unwrap();
    assert!(area.contains([5.0, 20.0]) && area.contains([35.0, 20.0]));
    assert!(!area.contains([20.0, 35.0]) && !area.contains([20.0, 5.0]));
}

#[test]
fn a_long_side_is_straight_on_the_map() {
    let origin = origin();
    let ring = vec![[4.0, 52.0], [4.8, 52.0], [4.8, 52.2], [4.0, 52.2]];
    let area = StudyArea::new(&origin, origin.crs(), &[vec![ring]]).unwrap();
    // The parallel bends by some metres away from the line between its ends.
    assert!(area.contains(origin.to_local([4.4, 52.000_01])));
    assert!(!area.contains(origin.to_local([4.4, 51.999_99])));
}

#[test]
fn what_encloses_nothing_is_no_area() {
    assert_eq!(area(&[]).unwrap_err(), StudyError::Empty);
    assert_eq!(area(&[&[]]).unwrap_err(), StudyError::Empty);
    assert_eq!(area(&[&[&[[1.0, 1.0]]]]).unwrap_err(), StudyError::Empty);
    assert_eq!(area(&[&[&[[1.0, 1.0]; 5]]]).unwrap_err(), StudyError::Empty);
    let origin = origin();
    let ring = vec![[4.0, 52.0], [4.8, 98.0], [4.8, 52.2]];
    let error = StudyArea::new(&origin, origin.crs(), &[vec![ring]]).unwrap_err();
    let error = error.to_string();
    assert!(
        error.contains("polygon 0: 4.8, 98 is no place of OGC:CRS84"),
        "{error}"
    );
}

#[test]
fn a_ring_of_very_many_far_corners_is_refused_before_it_fills_the_memory() {
    let origin = Origin::new(Crs::from_epsg(32633).unwrap(), [500_000.0, 5_800_000.0]).unwrap();
    let corner = |k: u32| [f64::from(k % 2) * 900_000.0, f64::from(k)];
    let ring = (0..100_000).map(corner).collect();
    let error = StudyArea::new(&origin, origin.crs(), &[vec![ring]]).unwrap_err();
    assert_eq!(error, StudyError::Large);
    assert!(error.to_string().contains("16777216 sides"), "{error}");
}
