use ombra_accrual::Stretch;
use ombra_city::{Facet, Grid};
use ombra_sun::{Instant, Span};

use super::*;

fn about() -> SpellsAbout {
    let mut about = SpellsAbout {
        version: 1,
        latitude: 52.0,
        longitude: 4.36,
        time_zone: "Europe/Amsterdam".to_owned(),
        refraction: false,
        windows: Vec::new(),
        on: "ground".to_owned(),
        cell: None,
        grid: None,
        places: 4,
        buildings: vec![Some("way/1".to_owned()), None],
    };
    about.set_grid(Grid {
        corner: [-10.0, 5.0],
        cell: 2.0,
        width: 2,
        height: 2,
    });
    let at = Instant::from_seconds;
    about.set_spans(&[Span::new(at(1_000.0), at(90_000.000_4))]);
    about
}

fn stretch(from: f64, to: f64, owner: u32, is_alone: bool) -> Stretch {
    Stretch {
        from: Instant::from_seconds(from),
        to: Instant::from_seconds(to),
        owner,
        is_alone,
    }
}

/// Places with none, one and several stretches, at either end and in between.
fn groups() -> [SpellsGroup; 2] {
    let mut first = SpellsGroup {
        places: vec![0, 1, 3],
        positions: vec![[4.36, 52.0, 0.0], [4.361, 52.0, 1.5], [4.36, 52.001, -2.25]],
        ..SpellsGroup::default()
    };
    first.stretches.push([]);
    first.stretches.push([
        stretch(1000.0, 2000.125, 0, true),
        stretch(2000.125, 3000.5, 1, false),
        stretch(4000.0, 5000.0, Facet::TERRAIN, true),
    ]);
    first.stretches.push([]);
    let mut second = SpellsGroup {
        places: vec![2],
        positions: vec![[4.361, 52.001, 0.0]],
        ..SpellsGroup::default()
    };
    second
        .stretches
        .push([stretch(86_000.0, 90_000.0, Facet::CONTEXT, true)]);
    [first, second]
}

/// The same without a grid, whose cells would not be enough.
fn points() -> SpellsAbout {
    SpellsAbout {
        grid: None,
        ..about()
    }
}

fn write(path: &std::path::Path, about: &SpellsAbout, groups: &[SpellsGroup]) {
    let metadata = [("command".to_owned(), "ombra shadows demo".to_owned())];
    write_spells(path, about, &metadata, |writer| {
        groups.iter().try_for_each(|group| writer.write(group))
    })
    .map_err(|error: crate::FormatError| error.to_string())
    .unwrap();
}

#[test]
fn what_is_written_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &about(), &groups());
    let file = SpellsFile::open(&path).unwrap();
    assert_eq!(*file.about(), about());
    assert_eq!(file.about().grid().unwrap().corner, [-10.0, 5.0]);
    assert_eq!(file.about().windows, [[1_000_000, 90_000_000]]);
    let command = ("command".to_owned(), "ombra shadows demo".to_owned());
    assert_eq!(file.metadata(), [command]);
    assert_eq!(file.groups(), 2);
    for (k, group) in groups().into_iter().enumerate() {
        assert_eq!(file.read(k).unwrap(), group);
    }
}

#[test]
fn many_places_come_back() {
    let mut group = SpellsGroup::default();
    for k in 0..150_000_u32 {
        group.places.push(k);
        group.positions.push([4.36, 52.0, 0.0]);
        let count = [0, 3, 1, 0, 7][k as usize % 5];
        let begin = |j: u32| f64::from(1000 + 10 * j + k % 10);
        group
            .stretches
            .push((0..count).map(|j| stretch(begin(j), begin(j) + 5.0, k % 2, k % 3 == 0)));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &points(), std::slice::from_ref(&group));
    assert!(SpellsFile::open(&path).unwrap().read(0).unwrap() == group);
}

#[test]
fn what_rounds_to_nothing_is_left_out() {
    let mut group = groups()[1].clone();
    group.stretches = Default::default();
    group.stretches.push([
        stretch(1000.0, 1000.0003, 0, true),
        stretch(2000.0, 2000.001, 1, true),
    ]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &about(), &[group]);
    let read = SpellsFile::open(&path).unwrap().read(0).unwrap();
    assert_eq!(read.stretches.of(0), [stretch(2000.0, 2000.001, 1, true)]);
}

#[test]
fn threads_read_groups_at_once() {
    let all: Vec<SpellsGroup> = (0..40_u32)
        .map(|group| {
            let mut own = SpellsGroup::default();
            for k in 0..2000 {
                own.places.push(2000 * group + k);
                own.positions.push([4.36, 52.0, f64::from(group)]);
                let begin = f64::from(1000 + group + k);
                own.stretches.push([stretch(begin, begin + 1.0, 0, true)]);
            }
            own
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &points(), &all);
    let file = SpellsFile::open(&path).unwrap();
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (file, all) = (&file, &all);
            scope.spawn(move || {
                for k in (thread..40).step_by(2).chain(0..10) {
                    assert!(file.read(k).unwrap() == all[k]);
                }
            });
        }
    });
}

#[test]
fn none_is_a_file_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    write(&path, &about(), &[]);
    assert_eq!(SpellsFile::open(&path).unwrap().groups(), 0);
}

#[test]
fn what_is_wrong_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.parquet");
    let fault = |path: &std::path::Path| {
        let read = || {
            let file = SpellsFile::open(path)?;
            (0..file.groups()).try_for_each(|group| file.read(group).map(drop))
        };
        read().unwrap_err().to_string()
    };
    assert!(fault(&path).contains("a.parquet"), "no such file");
    std::fs::write(&path, b"not parquet at all").unwrap();
    assert!(fault(&path).contains("GeoParquet"));
    // Other GeoParquet than this.
    crate::places::write_places_parquet(&path, [], &[]).unwrap();
    assert!(
        fault(&path).contains("no column \"place\""),
        "{}",
        fault(&path)
    );
    assert!(fault(&path).contains("--spells"));

    let mut wrong = groups()[0].clone();
    wrong.stretches = Default::default();
    wrong.stretches.push([
        stretch(2000.0, 3000.0, 0, true),
        stretch(1000.0, 2500.0, 0, true),
    ]);
    wrong.stretches.push([]);
    wrong.stretches.push([]);
    write(&path, &about(), &[wrong.clone()]);
    assert!(fault(&path).contains("not in order"), "{}", fault(&path));
    wrong.stretches = Default::default();
    wrong.stretches.push([stretch(1000.0, 2000.0, 2, true)]);
    wrong.stretches.push([]);
    wrong.stretches.push([]);
    write(&path, &about(), &[wrong]);
    assert!(fault(&path).contains("building 2"), "{}", fault(&path));
    let mut later = about();
    later.version = 2;
    write(&path, &later, &[]);
    assert!(fault(&path).contains("layout 2"));
    later = about();
    later.set_grid(Grid {
        width: 99_999_999,
        height: 99_999_999,
        ..about().grid().unwrap()
    });
    write(&path, &later, &[]);
    assert!(fault(&path).contains("too many"));
    let mut outside = groups()[1].clone();
    outside.places[0] = 4;
    write(&path, &about(), &[outside]);
    assert!(fault(&path).contains("place 4"));
    let mut nowhere = groups()[1].clone();
    nowhere.positions[0][1] = f64::NAN;
    write(&path, &about(), &[nowhere]);
    assert!(fault(&path).contains("NaN"));
    // Not all of it.
    write(&path, &about(), &groups());
    let whole = std::fs::read(&path).unwrap();
    for cut in [0, 1, 8, whole.len() / 2, whole.len() - 1] {
        std::fs::write(&path, &whole[..cut]).unwrap();
        assert!(fault(&path).contains("a.parquet"));
    }
    // Any byte of it: an error or another answer, and no panic.
    for index in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[index] ^= 0xff;
        std::fs::write(&path, &bytes).unwrap();
        let _ = SpellsFile::open(&path)
            .and_then(|file| (0..file.groups()).try_for_each(|group| file.read(group).map(drop)));
    }
}
