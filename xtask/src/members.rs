//! One version, one edition, one licence, one set of lints: every crate takes them from the root.

use std::fs;

use anyhow::{Context, Result, bail};
use toml::{Table, Value};

use crate::cargo;

/// What `[package]` takes from the workspace.
const INHERITED: [&str; 6] = [
    "version",
    "edition",
    "rust-version",
    "license",
    "authors",
    "publish",
];

/// Checks the manifests of all crates.
///
/// # Errors
/// One message with everything that is wrong.
pub(crate) fn run() -> Result<()> {
    let metadata = cargo::metadata()?;
    let packages = metadata.workspace_packages();
    let mut findings = Vec::new();
    for package in &packages {
        let text = fs::read_to_string(&package.manifest_path)
            .with_context(|| format!("cannot read {}", package.manifest_path))?;
        let manifest = text
            .parse::<Table>()
            .with_context(|| format!("{} is not TOML", package.manifest_path))?;
        for finding in check(&manifest) {
            findings.push(format!("{}: {finding}", package.name));
        }
    }
    if !findings.is_empty() {
        bail!("{}", findings.join("\n"));
    }
    println!(
        "{} crates share one version and one set of lints",
        packages.len()
    );
    Ok(())
}

/// What is wrong with a manifest, a line each.
fn check(manifest: &Table) -> Vec<String> {
    let mut findings = Vec::new();
    let of = |table: &str, key: &str| manifest.get(table)?.get(key).cloned();
    let inherits = |value: Option<Value>| {
        let own = value.as_ref().and_then(|value| value.get("workspace"));
        own.and_then(Value::as_bool) == Some(true)
    };
    for key in INHERITED {
        if !inherits(of("package", key)) {
            findings.push(format!("[package] must say `{key}.workspace = true`"));
        }
    }
    if of("lints", "workspace") != Some(Value::Boolean(true)) {
        findings.push("[lints] must say `workspace = true`".into());
    }
    if of("package", "description").is_none_or(|line| line.as_str().is_none_or(str::is_empty)) {
        findings.push("[package] needs a description".into());
    }
    for section in ["dependencies", "dev-dependencies", "build-dependencies"] {
        let dependencies = manifest.get(section).and_then(Value::as_table);
        for (name, value) in dependencies.into_iter().flatten() {
            if !inherits(Some(value.clone())) {
                findings.push(format!("[{section}] must say `{name}.workspace = true`"));
            }
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
        [package]
        name = "good"
        description = "All as it should be"
        version.workspace = true
        edition.workspace = true
        rust-version.workspace = true
        license.workspace = true
        authors.workspace = true
        publish.workspace = true
        [dependencies]
        serde.workspace = true
        rayon = { workspace = true, optional = true }
        [lints]
        workspace = true
    "#;

    fn findings(manifest: &str) -> Vec<String> {
        check(&manifest.parse().unwrap())
    }

    #[test]
    fn a_manifest_that_inherits_everything_passes() {
        assert_eq!(findings(GOOD), [""; 0]);
    }

    #[test]
    fn a_version_or_a_lint_set_of_its_own_is_refused() {
        let own = GOOD.replace(
            "version.workspace = true\n        edition",
            "version = \"9.9.9\"\nedition",
        );
        assert_eq!(
            findings(&own),
            ["[package] must say `version.workspace = true`"]
        );
        let (unlinted, _) = GOOD.split_once("[lints]").unwrap();
        assert_eq!(findings(unlinted), ["[lints] must say `workspace = true`"]);
    }

    #[test]
    fn a_dependency_with_a_version_of_its_own_is_refused() {
        let own = GOOD.replace("serde.workspace = true", "serde = \"1\"");
        assert_eq!(
            findings(&own),
            ["[dependencies] must say `serde.workspace = true`"]
        );
    }

    #[test]
    fn an_empty_manifest_is_refused_on_every_count() {
        assert_eq!(findings("").len(), INHERITED.len() + 2);
    }

    #[test]
    fn every_crate_of_the_workspace_inherits() {
        run().unwrap();
    }
}
