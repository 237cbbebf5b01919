//! Who may import whom: the one table, and the check of the workspace against it.
//!
//! A crate imports only from floors below its own, and the two wings never import one another.
//! A dev-dependency may also stand on the same floor, so that a test can hold neighbours against
//! each other, but never above: a published crate whose tests need the house over it cannot be
//! published, and a test that needs it belongs to the upper floor.

use anyhow::{Result, bail};
use cargo_metadata::{DependencyKind, Metadata};

use crate::cargo;

/// The floors, from the ground up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Floor {
    /// Rays, boxes, spaces, shapes.
    Ground,
    /// Finding the hit among millions.
    Structures,
    /// Ray programs: the waist.
    Programs,
    /// Other machines that run them.
    Devices,
    /// What is there.
    Descriptions,
    /// What is summed.
    Sums,
    /// Bytes to descriptions and back.
    Files,
    /// One door for users of Rust.
    Facade,
    /// What things cost: measured on all that is below.
    Measures,
    /// Where people come in.
    Outlets,
    /// Around the house: taught, tried. Nothing imports from here.
    Yard,
}

/// The wings: what one knows, the other must not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wing {
    /// Neither, or above both.
    Trunk,
    /// Pictures.
    Light,
    /// Shadow time.
    Sun,
}

/// One crate's place.
#[derive(Clone, Copy, Debug)]
struct Row {
    package: &'static str,
    floor: Floor,
    wing: Wing,
    /// Whether it is there, or only planned.
    built: bool,
}

const fn built(package: &'static str, floor: Floor, wing: Wing) -> Row {
    Row {
        package,
        floor,
        wing,
        built: true,
    }
}

const fn planned(package: &'static str, floor: Floor, wing: Wing) -> Row {
    Row {
        built: false,
        ..built(package, floor, wing)
    }
}

/// The table. A crate that is opened needs a row here, and a line in ARCHITECTURE.md.
const TABLE: &[Row] = &[
    built("ombra-geometry", Floor::Ground, Wing::Trunk),
    built("ombra-accel", Floor::Structures, Wing::Trunk),
    built("ombra-pipeline", Floor::Programs, Wing::Trunk),
    planned("ombra-gpu", Floor::Devices, Wing::Trunk),
    built("ombra-scene", Floor::Descriptions, Wing::Light),
    built("ombra-city", Floor::Descriptions, Wing::Sun),
    built("ombra-sun", Floor::Descriptions, Wing::Sun),
    built("ombra-render", Floor::Sums, Wing::Light),
    built("ombra-accrual", Floor::Sums, Wing::Sun),
    built("ombra-formats", Floor::Files, Wing::Trunk),
    built("ombra", Floor::Facade, Wing::Trunk),
    built("ombra-bench", Floor::Measures, Wing::Trunk),
    built("ombra-study", Floor::Measures, Wing::Trunk),
    built("ombra-cli", Floor::Outlets, Wing::Trunk),
    planned("ombra-server", Floor::Outlets, Wing::Trunk),
    planned("ombra-python", Floor::Outlets, Wing::Trunk),
    built("ombra-examples", Floor::Yard, Wing::Trunk),
    built("xtask", Floor::Yard, Wing::Trunk),
];

/// One crate of the workspace, and those of the workspace that it imports.
#[derive(Clone, Debug)]
struct Crate {
    name: String,
    imports: Vec<Import>,
}

#[derive(Clone, Debug)]
struct Import {
    name: String,
    /// By tests, examples and benches only.
    dev: bool,
}

/// Checks the workspace.
///
/// # Errors
/// One message with everything that is wrong.
pub(crate) fn run() -> Result<()> {
    let crates = workspace(&cargo::metadata()?);
    let findings = check(TABLE, &crates);
    if !findings.is_empty() {
        bail!(
            "{}\nthe table is in xtask/src/layers.rs",
            findings.join("\n")
        );
    }
    let arrows: usize = crates.iter().map(|krate| krate.imports.len()).sum();
    println!("{} crates, {arrows} imports, all downward", crates.len());
    Ok(())
}

/// The crates of the workspace. Imports of others are left out: they have no floor.
fn workspace(metadata: &Metadata) -> Vec<Crate> {
    let packages = metadata.workspace_packages();
    let ours = |name: &str| packages.iter().any(|package| package.name.as_str() == name);
    packages
        .iter()
        .map(|package| Crate {
            name: package.name.to_string(),
            imports: package
                .dependencies
                .iter()
                .filter(|dependency| ours(&dependency.name))
                .map(|dependency| Import {
                    name: dependency.name.clone(),
                    dev: dependency.kind == DependencyKind::Development,
                })
                .collect(),
        })
        .collect()
}

/// What is wrong, a line each.
fn check(table: &[Row], crates: &[Crate]) -> Vec<String> {
    let row = |name: &str| table.iter().find(|row| row.package == name);
    let mut findings = Vec::new();
    for krate in crates {
        let Some(from) = row(&krate.name) else {
            findings.push(format!("{} has no row: which floor is it on?", krate.name));
            continue;
        };
        if !from.built {
            findings.push(format!("{} is there, but its row says planned", krate.name));
        }
        for import in &krate.imports {
            // A crate without a row is reported where it stands itself.
            if let Some(to) = row(&import.name)
                && let Some(reason) = refusal(from, to, import.dev)
            {
                findings.push(format!("{} imports {}: {reason}", krate.name, import.name));
            }
        }
    }
    let missing = |row: &&Row| row.built && !crates.iter().any(|k| k.name == row.package);
    for row in table.iter().filter(missing) {
        findings.push(format!("{} has a row, but is not there", row.package));
    }
    findings
}

/// Why one crate may not import another; `None` if it may.
fn refusal(from: &Row, to: &Row, dev: bool) -> Option<String> {
    if from.package == "xtask" {
        return Some("xtask stands alone, so that it runs on a tree that does not compile".into());
    }
    if from.wing != to.wing && from.wing != Wing::Trunk && to.wing != Wing::Trunk {
        return Some(format!(
            "the {:?} wing never imports the {:?} wing",
            from.wing, to.wing
        ));
    }
    if to.floor == Floor::Yard {
        return Some("nothing imports what stands around the house".into());
    }
    if to.floor > from.floor {
        return Some(format!("{:?} is above {:?}", to.floor, from.floor));
    }
    if to.floor == from.floor && !dev {
        return Some(format!("both are on the floor {:?}", from.floor));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A graph of its own: "b" imports "a" and so on; "+a" is a dev-dependency.
    fn graph(crates: &[(&str, &[&str])]) -> Vec<Crate> {
        let import = |name: &&str| Import {
            name: name.trim_start_matches('+').to_owned(),
            dev: name.starts_with('+'),
        };
        crates
            .iter()
            .map(|(name, imports)| Crate {
                name: (*name).to_owned(),
                imports: imports.iter().map(import).collect(),
            })
            .collect()
    }

    const HOUSE: &[Row] = &[
        built("ground", Floor::Ground, Wing::Trunk),
        built("scene", Floor::Descriptions, Wing::Light),
        built("city", Floor::Descriptions, Wing::Sun),
        built("sun", Floor::Descriptions, Wing::Sun),
        built("render", Floor::Sums, Wing::Light),
        built("facade", Floor::Facade, Wing::Trunk),
        built("bench", Floor::Yard, Wing::Trunk),
        planned("server", Floor::Outlets, Wing::Trunk),
    ];

    /// The house above, everything in order, with some crates' imports replaced.
    fn findings(changes: &[(&str, &[&str])]) -> Vec<String> {
        let mut all: Vec<(&str, &[&str])> = vec![
            ("ground", &[]),
            ("scene", &["ground"]),
            ("city", &["ground"]),
            ("sun", &[]),
            ("render", &["scene", "ground"]),
            ("facade", &["render", "city", "sun", "ground"]),
            ("bench", &["facade", "+ground"]),
        ];
        for change in changes {
            match all.iter_mut().find(|(name, _)| *name == change.0) {
                Some(entry) => *entry = *change,
                None => all.push(*change),
            }
        }
        check(HOUSE, &graph(&all))
    }

    #[test]
    fn downward_imports_pass() {
        assert_eq!(findings(&[]), [""; 0]);
    }

    #[test]
    fn an_upward_import_is_refused_for_tests_too() {
        for import in ["scene", "+scene"] {
            let found = findings(&[("ground", &[import])]);
            assert_eq!(
                found,
                ["ground imports scene: Descriptions is above Ground"]
            );
        }
    }

    #[test]
    fn neighbours_meet_in_tests_only() {
        assert_eq!(findings(&[("sun", &["+city"])]), [""; 0]);
        let found = findings(&[("sun", &["city"])]);
        assert_eq!(
            found,
            ["sun imports city: both are on the floor Descriptions"]
        );
    }

    #[test]
    fn the_wings_never_meet() {
        for import in ["city", "+city"] {
            let found = findings(&[("render", &[import])]);
            assert_eq!(
                found,
                ["render imports city: the Light wing never imports the Sun wing"]
            );
        }
    }

    #[test]
    fn nothing_imports_the_yard() {
        let found = findings(&[("bench", &["+bench"])]);
        assert_eq!(
            found,
            ["bench imports bench: nothing imports what stands around the house"]
        );
    }

    #[test]
    fn a_crate_needs_a_row_that_tells_the_truth() {
        let found = findings(&[("attic", &["ground"]), ("server", &["facade"])]);
        assert_eq!(
            found,
            [
                "attic has no row: which floor is it on?",
                "server is there, but its row says planned",
            ]
        );
        let found = check(HOUSE, &graph(&[("ground", &[])]));
        assert!(found.contains(&"scene has a row, but is not there".to_owned()));
    }

    #[test]
    fn xtask_imports_nothing_of_the_house() {
        let all = graph(&[("xtask", &["ombra-geometry"])]);
        let found = check(TABLE, &all);
        assert!(found[0].starts_with("xtask imports ombra-geometry: xtask stands alone"));
    }

    #[test]
    fn no_crate_has_two_rows() {
        for (index, row) in TABLE.iter().enumerate() {
            let twin = TABLE[..index]
                .iter()
                .any(|other| other.package == row.package);
            assert!(!twin, "{} has two rows", row.package);
        }
    }

    #[test]
    fn the_workspace_keeps_to_the_table() {
        run().unwrap();
    }

    #[test]
    fn architecture_names_every_crate_of_the_table_and_marks_what_is_planned() {
        let text = std::fs::read_to_string(cargo::root().join("ARCHITECTURE.md")).unwrap();
        for row in TABLE {
            let name = format!("| `{}` |", row.package);
            let line = text.lines().find(|line| line.contains(&name));
            let line = line.unwrap_or_else(|| panic!("no table row holds {name}"));
            let says_planned = line.contains("(planned)");
            assert_eq!(says_planned, !row.built, "is {} there or not?", row.package);
        }
    }
}
