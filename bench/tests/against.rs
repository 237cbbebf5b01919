//! ombra against itself always, against Embree where it is there. Little is traced, and what the
//! clock said is not looked at.

use ombra_accel::StructureKind;
use ombra_bench::against::{Options, Peer, Report, run};

fn measure(peer: Peer, accels: Vec<StructureKind>) -> anyhow::Result<Report> {
    let options = Options {
        peers: vec![peer],
        accels,
        threads: vec![1, 2],
        ..Options::smoke()
    };
    run(&options, &mut |_| ())
}

#[test]
fn structures_of_ombra_agree_and_are_right_in_the_eyes_of_the_judge() {
    let kinds = vec![StructureKind::Bvh, StructureKind::KdRopes];
    let report = measure(Peer::Ombra, kinds).unwrap();
    // Two scenes, two structures, one ray or many a call, four workloads; each on one and two
    // threads for speed.
    assert_eq!(report.answers.len(), 2 * 2 * 2 * 4);
    assert_eq!(report.records.len(), 2 * report.answers.len());
    assert_eq!(report.builds.len(), 2 * 2 * 2);
    for answer in &report.answers {
        let shown = format!("{answer:?}");
        assert_eq!(answer.other_hits + answer.other_distances, 0, "{shown}");
        assert_eq!(answer.wrong, 0, "{shown}");
        assert_eq!(answer.changed_by_flushing, Some(0), "{shown}");
        assert!(answer.judged >= 64, "{shown}");
        assert!(answer.hits > 0 && answer.hits < answer.rays, "{shown}");
    }
    for record in &report.records {
        assert!(record.mrays.unwrap() > 0.0);
        assert!(record.over_best.unwrap() <= record.over_single.unwrap());
        assert_eq!(record.base, record.contestant.starts_with("ombra bvh,"));
    }
    let tables = report.tables();
    for part in [
        "| ombra kd-ropes, many |",
        "### city: builds",
        "## All scenes",
        "interior, 1 thread:",
        "interior, 2 threads:",
    ] {
        assert!(tables.contains(part), "{part} in\n{tables}");
    }
}

#[test]
fn without_a_clock_only_answers_are_compared() {
    let options = Options {
        peers: vec![Peer::Ombra],
        rounds: 0,
        threads: vec![1],
        ..Options::smoke()
    };
    let report = run(&options, &mut |_| ()).unwrap();
    assert!(report.records.iter().all(|record| record.mrays.is_none()));
    assert!(report.tables().contains("answers"));
}

#[test]
fn embree_and_ombra_see_the_same_scene() {
    let report = match measure(Peer::Embree, vec![StructureKind::default()]) {
        Ok(report) => report,
        Err(error) => {
            let words = format!("{error:#}");
            assert!(words.contains("Embree"), "{words}");
            println!("skipped: {words}");
            return;
        }
    };
    assert_eq!(report.peers[0].name, "embree");
    for answer in &report.answers {
        let shown = format!("{answer:?}");
        assert!(answer.other_hits * 100 <= answer.rays, "{shown}");
        if answer.contestant.starts_with("ombra") {
            assert_eq!(answer.wrong, 0, "{shown}");
        }
    }
    let first = &report.builds[0];
    assert!(first.peak_bytes_told.unwrap() > first.own_bytes.unwrap());
    assert!(report.records[0].base && !report.records.last().unwrap().base);
}
