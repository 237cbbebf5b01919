//! What no file of the checkout may hold, and what none may be called.
//!
//! A marker of unfinished work names the issue that will finish it, as in `…(#12)`; a file is called
//! after what is in it, and stays short enough to be read.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::cargo;

/// Files that are read by people.
const ENDINGS: [&str; 9] = [
    ".rs", ".md", ".toml", ".py", ".ts", ".js", ".wgsl", ".sh", ".ci/run",
];

/// Markers of unfinished work, spelt so that this file does not hold them.
const MARKERS: [&str; 4] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("XX", "X"),
    concat!("HA", "CK"),
];

/// Names that say nothing about what is in a file.
const EMPTY_NAMES: [&str; 8] = [
    "util", "utils", "common", "misc", "helper", "helpers", "manager", "stuff",
];

/// A source file with more lines than this is several files.
const LONGEST: usize = 800;

/// Checks all files.
///
/// # Errors
/// One message with everything that is wrong.
pub(crate) fn run() -> Result<()> {
    let files = cargo::tracked(&ENDINGS)?;
    let mut findings = Vec::new();
    for file in &files {
        let text = fs::read_to_string(cargo::root().join(file))
            .with_context(|| format!("cannot read {}", file.display()))?;
        findings.extend(check(file, &text));
    }
    if !findings.is_empty() {
        bail!("{}", findings.join("\n"));
    }
    println!("{} files keep to the house's words", files.len());
    Ok(())
}

/// What is wrong with a file, a line each.
fn check(file: &Path, text: &str) -> Vec<String> {
    let shown = file.display();
    let mut findings = Vec::new();
    for (index, line) in text.lines().enumerate() {
        for marker in MARKERS.iter().filter(|marker| is_bare(line, marker)) {
            findings.push(format!(
                "{shown}:{}: \"{marker}\" names no issue: finish it, or write {marker}(#NUMBER)",
                index + 1
            ));
        }
    }
    let of_source = file.extension().is_some_and(|extension| extension != "md");
    if of_source {
        let words = file.iter().map(|part| Path::new(part).file_stem());
        let empty = |name: &&str| EMPTY_NAMES.contains(name);
        let names = words.flatten().filter_map(|word| word.to_str());
        if let Some(name) = names.into_iter().find(|name| empty(name)) {
            findings.push(format!("{shown}: \"{name}\" does not say what is in it"));
        }
        let lines = text.lines().count();
        if lines > LONGEST {
            findings.push(format!("{shown}: {lines} lines; one file, one idea"));
        }
    }
    findings
}

/// Whether a line holds the marker as a word of its own that neither names an issue nor is quoted.
fn is_bare(line: &str, marker: &str) -> bool {
    line.match_indices(marker).any(|(start, _)| {
        let before = line[..start].chars().next_back();
        let after = &line[start + marker.len()..];
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let whole = !before.is_some_and(is_word) && !after.starts_with(is_word);
        let quoted = before == Some('`') && after.starts_with('`');
        let issue = after
            .strip_prefix("(#")
            .and_then(|rest| rest.split_once(')'));
        let named = issue.is_some_and(|(number, _)| number.parse::<u32>().is_ok());
        whole && !quoted && !named
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bare_marker_is_refused_and_one_with_an_issue_is_not() {
        let [marker, ..] = MARKERS;
        assert!(is_bare(&format!("// {marker}: later"), marker));
        assert!(is_bare(marker, marker));
        assert!(is_bare(&format!("// {marker}(someone)"), marker));
        assert!(!is_bare(&format!("// {marker}(#12): why"), marker));
        assert!(!is_bare(&format!("a bare `{marker}` is refused"), marker));
        assert!(!is_bare(&format!("{marker}S are METHODS"), marker));
        assert!(!is_bare("", marker));
    }

    #[test]
    fn a_name_that_says_nothing_is_refused_for_files_and_folders() {
        for name in ["src/utils.rs", "src/helpers/ray.rs"] {
            assert_eq!(check(Path::new(name), "").len(), 1, "{name}");
        }
        assert_eq!(check(Path::new("src/ray.rs"), ""), [""; 0]);
    }

    #[test]
    fn a_source_file_may_not_grow_without_end_but_a_page_may() {
        let long = "line\n".repeat(LONGEST + 1);
        assert_eq!(check(Path::new("a.rs"), &long).len(), 1);
        assert_eq!(check(Path::new("a.rs"), &"line\n".repeat(LONGEST)), [""; 0]);
        assert_eq!(check(Path::new("a.md"), &long), [""; 0]);
    }
}
