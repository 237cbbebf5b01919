//! Exact shadow time against rays: against Embree's where it is there. Little is measured, and what the
//! clock said is not looked at.

use ombra_bench::shadows::{Options, run};

#[test]
fn rays_every_minute_see_the_shadow_that_exact_time_sees() {
    let mut talk = Vec::new();
    let report = run(&Options::smoke(), &mut |line| talk.push(line.to_owned())).unwrap();
    // Three days twice and the year, by all days and by some, on the ground; three days on façades.
    assert_eq!(report.jobs.len(), 3 + 3 + 2 + 3);
    for job in &report.jobs {
        let shown = format!("{job:?}");
        assert!(job.places >= 16 && job.places % 16 == 0, "{shown}");
        assert!(job.mean_seconds > 0.0, "{shown}");
        // A shadow that comes and goes is off by up to half a minute at both its ends.
        let days = (job.rays as f64 / 500.0).max(1.0);
        assert!(job.sampling.mean < 120.0 * days, "{shown}");
        assert!(job.over_single.is_some(), "{shown}");
        if let Some(packets) = job.packets {
            assert!(packets.most <= 120.0, "{shown}");
        }
    }
    assert!(!report.own.is_empty());
    let tables = report.tables();
    for part in [
        "## procedural: 200 buildings",
        "| ground, Dec 21 ±90 min |",
        "| façades, ",
    ] {
        assert!(tables.contains(part), "{part} in\n{tables}");
    }
    match &report.missing {
        Some(missing) => {
            assert!(missing.contains("cargo xtask bench --setup"), "{missing}");
            assert!(tables.contains(missing.as_str()) && talk[0].contains(missing.as_str()));
            println!("skipped: {missing}");
        }
        None => assert!(report.jobs.iter().all(|job| job.over_packets.is_some())),
    }
}

#[test]
fn an_embree_that_was_named_and_is_not_there_is_an_error() {
    let options = Options {
        embree: Some("no/such/folder".into()),
        ..Options::smoke()
    };
    let error = run(&options, &mut |_| ()).unwrap_err().to_string();
    assert!(error.contains("cargo xtask bench --setup"), "{error}");
}
