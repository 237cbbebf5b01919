//! What an edit costs. The whole city of 45,000 buildings, in cells as small as one likes:
//! `OMBRA_WHAT_IF_CELL=4 cargo test --release -p ombra-bench --test what_if -- --nocapture`

use ombra_bench::shadows::{PROCEDURAL, what_if};
use ombra_city::procedural_city;

#[test]
fn one_tower_is_measured_again_where_it_can_be_seen() {
    let cell: Option<f64> = std::env::var("OMBRA_WHAT_IF_CELL")
        .ok()
        .map(|text| text.parse().expect("metres are wanted, as 4"));
    let city = procedural_city(1, if cell.is_some() { 45_000 } else { 400 });
    let cell = cell.unwrap_or(8.0);
    let records = what_if(PROCEDURAL, &city, cell, &mut |line| println!("{line}")).unwrap();
    assert_eq!(records.len(), 3);
    for record in &records {
        println!("{record:?}, {:.2} %", 100.0 * record.share());
        assert!(record.changed <= record.again);
        assert!(record.again < record.places / 2);
    }
}
