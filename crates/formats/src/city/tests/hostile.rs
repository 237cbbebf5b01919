//! Readers never panic, whatever the bytes.

use proptest::prelude::*;

use super::super::osm::tests::{OSM, pbf};
use super::super::{CityOptions, read_city_bytes};
use super::read::{CITYJSON, CITYJSONSEQ, GEOJSON, LIST};

/// Half of the changes are to bytes that mean something in text and in numbers.
fn change() -> impl Strategy<Value = (usize, u8)> {
    let telling = prop::sample::select(&b"0123456789-+.eE[]{}\",:n </>&="[..]);
    (any::<usize>(), prop_oneof![telling, any::<u8>()])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cities_that_are_changed_and_cut(
        changes in prop::collection::vec(change(), 0..4),
        cut in 0..6000_usize,
    ) {
        let packed = pbf(OSM, false);
        let texts = [GEOJSON, LIST, CITYJSON, CITYJSONSEQ, OSM].map(str::as_bytes);
        for whole in texts.into_iter().chain([&packed[..]]) {
            let mut bytes = whole.to_vec();
            for (at, byte) in &changes {
                let at = at % bytes.len();
                bytes[at] = *byte;
            }
            if cut < bytes.len() {
                bytes.truncate(cut);
            }
            match read_city_bytes("city", &bytes, &CityOptions::default()) {
                Ok(city) => {
                    let facets = city.facets();
                    prop_assert!(facets.iter().flat_map(|f| f.corners).all(|p| p.is_finite()));
                    let inside = ombra_city::Inside::new(&city);
                    let _ = facets.iter().filter(|f| inside.contains(f.corners[0])).count();
                }
                Err(error) => prop_assert!(!error.to_string().contains('\n')),
            }
        }
    }

    #[test]
    fn rings_of_any_shape(
        corners in prop::collection::vec((-30..30_i32, -30..30_i32), 0..14),
        hole in prop::collection::vec((-30..30_i32, -30..30_i32), 0..8),
    ) {
        let ring = |corners: &[(i32, i32)]| {
            let corners: Vec<String> = corners
                .iter()
                .map(|(x, y)| format!("[{},{}]", f64::from(*x) * 1e-5, f64::from(*y) * 1e-5))
                .collect();
            format!("[{}]", corners.join(","))
        };
        let polygon = format!("[{},{}]", ring(&corners), ring(&hole));
        let text = format!("[{{\"height\":9,\"polygon\":{polygon}}}]");
        if let Ok(city) = read_city_bytes("city", text.as_bytes(), &CityOptions::default()) {
            for facet in city.facets() {
                prop_assert!(facet.corners.iter().all(|p| p.is_finite()));
            }
        }
    }
}
