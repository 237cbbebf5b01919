//! A study from outside: what it measures, what its page holds, and what happens when it is stopped.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

use ombra::accel::StructureKind;
use ombra_study::{Settings, Study, Subject, Watch, Workload, study};

fn small() -> Settings {
    Settings {
        size: [12, 9],
        rounds: 1,
        threads: vec![2, 1, 2],
        ..Settings::smoke()
    }
}

fn of(scenes: &[&str], settings: &Settings, watch: &Watch<'_>) -> Study {
    let load = |name: &&str| Subject::load(name, settings).unwrap();
    study(scenes.iter().map(load).collect(), settings, watch).unwrap()
}

#[test]
fn every_structure_gets_rays_of_every_kind_on_every_number_of_threads() {
    let settings = small();
    let found = of(&["study:city", "card"], &settings, &Watch::default());
    assert_eq!(found.threads, [1, 2]);
    assert!(!found.interrupted);
    for scene in &found.scenes {
        let rays = scene.workloads.iter().map(|set| (set.workload, set.rays));
        assert_eq!(
            rays.collect::<Vec<_>>(),
            Workload::ALL.map(|kind| (kind, 108))
        );
        let names: Vec<_> = scene
            .structures
            .iter()
            .map(|report| report.structure)
            .collect();
        let all: Vec<_> = StructureKind::ALL.iter().map(|kind| kind.name()).collect();
        assert_eq!(names, all);
        for report in &scene.structures {
            assert!(
                report.bytes > 0 && report.bytes_per_primitive > 0.0,
                "{report:?}"
            );
            assert!(report.builds.iter().all(|build| build.seconds.is_some()));
            for measured in &report.workloads {
                assert_eq!(measured.differences, 0);
                assert!(measured.cost.tests_made.mean > 0.0, "{measured:?}");
                assert_eq!(measured.speeds.len(), 2);
                assert!(
                    measured
                        .speeds
                        .iter()
                        .all(|speed| speed.rays_per_second.is_some())
                );
            }
        }
    }
    let santos = found.santos.as_ref().unwrap();
    assert_eq!(santos.pairs.len(), 8, "{santos:?}");
}

#[test]
fn counts_do_not_depend_on_threads_or_rounds() {
    let counts = |threads: usize, rounds: usize| {
        let settings = Settings {
            threads: vec![threads],
            rounds,
            ..small()
        };
        let found = of(&["study:hills"], &settings, &Watch::default());
        let reports = found.scenes[0].structures.iter();
        let costs =
            reports.flat_map(|report| report.workloads.iter().map(|m| format!("{:?}", m.cost)));
        costs.collect::<Vec<_>>()
    };
    assert_eq!(counts(1, 0), counts(3, 1));
}

#[test]
fn without_rounds_there_are_counts_and_a_page_but_no_drawing() {
    let settings = Settings {
        rounds: 0,
        ..small()
    };
    let found = of(&["study:stadium"], &settings, &Watch::default());
    assert_eq!(found.drawing(), None);
    assert!(found.santos.is_none());
    let page = found.page();
    assert!(page.contains("Steps against tests") && page.contains("Bytes a primitive"));
    assert!(found.table().contains("nodes + tests a ray"));
}

#[test]
fn a_page_stands_alone_and_says_something_under_every_plot() {
    let found = of(
        &["study:hills", "study:stadium"],
        &small(),
        &Watch::default(),
    );
    let page = found.page();
    for elsewhere in [
        "http:", "https:", "@import", "<link", "<script", "src=", "url(",
    ] {
        assert!(!page.contains(elsewhere), "{elsewhere}");
    }
    for needed in [
        "lang=\"en\"",
        "name=\"viewport\"",
        "prefers-color-scheme: dark",
        "<title>",
    ] {
        assert!(page.contains(needed), "{needed}");
    }
    let figures: Vec<_> = page.split("<figure>").skip(1).collect();
    assert_eq!(figures.len(), 2 + 2 * 4 + 1);
    for figure in figures {
        let figure = figure.split("</figure>").next().unwrap();
        let (plot, said) = figure.split_once("<figcaption>").unwrap();
        assert!(plot.contains("<svg"), "{figure}");
        let said = said.strip_suffix("</figcaption>\n").unwrap();
        assert!(said.len() > 60 && said.ends_with('.'), "{said}");
    }
    for nonsense in ["NaN", "inf ", "none."] {
        assert!(!page.contains(nonsense), "{nonsense}");
    }
    let drawing = found.drawing().unwrap();
    assert!(drawing.starts_with("<svg xmlns=") && drawing.contains("<style>"));
}

#[test]
fn a_chosen_few_are_compared_without_the_default() {
    let settings = Settings {
        kinds: vec![StructureKind::Grid, StructureKind::KdRopes],
        ..small()
    };
    let found = of(&["cornell"], &settings, &Watch::default());
    assert_eq!(found.scenes[0].structures.len(), 2);
    assert!(found.santos.is_none());
    assert_eq!(found.drawing(), None);
    assert!(found.page().contains("kd-ropes"));
}

#[test]
fn brute_force_gets_fewer_rays_where_all_would_take_too_long() {
    let settings = Settings {
        kinds: vec![StructureKind::BruteForce, StructureKind::Bvh],
        size: [40, 40],
        rounds: 1,
        threads: vec![1],
        detail: 60,
        ..Settings::default()
    };
    let found = of(&["study:hills"], &settings, &Watch::default());
    let [force, boxes] = &found.scenes[0].structures[..] else {
        panic!("{found:?}");
    };
    assert!(
        force
            .workloads
            .iter()
            .all(|measured| (64..1600).contains(&measured.rays))
    );
    assert!(boxes.workloads.iter().all(|measured| measured.rays == 1600));
    for text in [found.table(), found.page()] {
        assert!(
            text.contains("study:hills: brute-force got 277 of 1 600 primary rays"),
            "{text}"
        );
    }
}

#[test]
fn a_scene_without_anything_has_primary_rays_only() {
    let folder = std::env::temp_dir().join(format!("ombra-study-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("nothing.toml");
    std::fs::write(&file, "background = 0.5\n").unwrap();
    let found = of(&[file.to_str().unwrap()], &small(), &Watch::default());
    std::fs::remove_dir_all(&folder).unwrap();
    let rays: Vec<_> = found.scenes[0]
        .workloads
        .iter()
        .map(|set| set.rays)
        .collect();
    assert_eq!(rays, [108, 0, 0, 0]);
    assert!(found.table().contains("there are no diffuse rays"));
    assert!(!found.page().contains("NaN"));
}

#[test]
fn a_study_that_is_stopped_keeps_what_was_measured() {
    let settings = small();
    let total = Cell::new(0);
    let stopped_after = |jobs: u64| {
        let stop = AtomicBool::new(false);
        let seen = Cell::new(0);
        let progress = |progress: ombra_study::Progress<'_>| {
            assert!(progress.done < progress.total, "{progress:?}");
            total.set(progress.total);
            seen.set(seen.get() + 1);
            if seen.get() == jobs {
                stop.store(true, Ordering::Relaxed);
            }
        };
        let watch = Watch {
            stop: Some(&stop),
            progress: Some(&progress),
        };
        of(&["study:city", "cornell"], &settings, &watch)
    };
    assert!(stopped_after(1).scenes.is_empty());
    // Both scenes take the same jobs.
    let one_scene = total.get() / 2;
    for jobs in [
        1,
        2,
        5,
        13,
        14,
        40,
        one_scene - 2,
        one_scene + 2,
        2 * one_scene - 2,
    ] {
        let found = stopped_after(jobs);
        assert!(found.interrupted, "{jobs}");
        assert!(found.scenes.len() <= 2);
        assert!(found.page().contains("was interrupted"), "{jobs}");
        assert!(found.table().contains("was interrupted"), "{jobs}");
        assert!(!found.page().contains("NaN"), "{jobs}");
    }
    assert_eq!(stopped_after(40).scenes.len(), 1);
    assert_eq!(stopped_after(one_scene + 20).scenes.len(), 2);
}

#[test]
fn a_scene_that_is_not_there_is_said_to_be_so() {
    for (name, said) in [
        ("study:nowhere", "study:hills"),
        ("nowhere", "no built-in scene"),
    ] {
        let error = Subject::load(name, &small()).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(said), "{error}");
    }
}
