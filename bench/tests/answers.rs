//! Every bench is a test: its contestants agree. No clock here.

use ombra_bench::{BENCHES, Settings};

#[test]
fn the_contestants_of_every_bench_agree() {
    for bench in BENCHES {
        let records = (bench.run)(&Settings::tiny()).unwrap();
        assert!(records.len() >= 2, "{} has nobody to compare", bench.name);
        for record in records {
            assert!(record.rays > 0 && record.seconds.is_none());
            assert!(record.to_string().contains("same answer"));
        }
    }
}

#[test]
fn a_round_on_the_clock_gives_a_ratio_and_json() {
    let settings = Settings {
        rounds: 1,
        threads: vec![1],
        ..Settings::tiny()
    };
    for bench in BENCHES {
        let records = (bench.run)(&settings).unwrap();
        let first = &records[0];
        assert_eq!(first.ratio.unwrap().median, 1.0);
        assert!(first.rays_per_second().unwrap() > 0.0);
        let json = serde_json::to_string(&records).unwrap();
        assert!(json.contains("\"rays\":"));
    }
}
