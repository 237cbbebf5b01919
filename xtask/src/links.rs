//! Links in Markdown files lead to files and headings that are there.
//!
//! Links to other sites are not followed: a check must not fail because somebody else's server does.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::cargo;
use crate::markdown::Page;

/// Every Markdown file of the checkout, taken apart.
///
/// # Errors
/// When one cannot be read.
pub(crate) fn pages() -> Result<BTreeMap<PathBuf, Page>> {
    let mut pages = BTreeMap::new();
    for file in cargo::tracked(&[".md"])? {
        let text = fs::read_to_string(cargo::root().join(&file))
            .with_context(|| format!("cannot read {}", file.display()))?;
        pages.insert(file, Page::parse(&text));
    }
    Ok(pages)
}

/// Checks all links.
///
/// # Errors
/// One message with every link that leads nowhere.
pub(crate) fn run() -> Result<()> {
    let pages = pages()?;
    let exists = |path: &Path| cargo::root().join(path).exists();
    let mut findings = check(&pages, exists);
    findings.extend(unlisted(&pages));
    if !findings.is_empty() {
        bail!("{}", findings.join("\n"));
    }
    let links: usize = pages.values().map(|page| page.links.len()).sum();
    println!("{links} links in {} pages lead somewhere", pages.len());
    Ok(())
}

/// The links that lead nowhere, a line each.
fn check(pages: &BTreeMap<PathBuf, Page>, exists: impl Fn(&Path) -> bool) -> Vec<String> {
    let mut findings = Vec::new();
    for (file, page) in pages {
        for link in &page.links {
            if is_elsewhere(&link.text) {
                continue;
            }
            let (path, anchor) = match link.text.split_once('#') {
                Some((path, anchor)) => (path, Some(anchor)),
                None => (link.text.as_str(), None),
            };
            let target = match path {
                "" => Some(file.clone()),
                path => normalised(&file.with_file_name(path)),
            };
            let wrong = match target {
                None => Some("leads out of the checkout"),
                Some(target) if !exists(&target) => Some("leads to no file"),
                Some(target) => anchor.and_then(|anchor| {
                    let page = pages.get(&target)?;
                    let there = page.anchors.iter().any(|there| there == anchor);
                    (!there).then_some("names no heading there")
                }),
            };
            if let Some(wrong) = wrong {
                let (file, line) = (file.display(), link.line);
                findings.push(format!("{file}:{line}: the link \"{}\" {wrong}", link.text));
            }
        }
    }
    findings
}

/// The pages of docs/ that its index does not name, a line each.
fn unlisted(pages: &BTreeMap<PathBuf, Page>) -> Vec<String> {
    let index = Path::new("docs/README.md");
    let named = |name: &str| {
        let page = pages.get(index);
        page.is_some_and(|page| page.links.iter().any(|link| link.text == name))
    };
    pages
        .keys()
        .filter(|page| page.starts_with("docs") && *page != index)
        .filter_map(|page| page.strip_prefix("docs").ok()?.to_str())
        .filter(|name| !named(name))
        .map(|name| format!("docs/README.md does not name docs/{name}"))
        .collect()
}

/// Whether a link leads to another site.
pub(crate) fn is_elsewhere(target: &str) -> bool {
    target.contains("://") || target.starts_with("mailto:")
}

/// A path without `.` and `..`; `None` if it leaves the root.
pub(crate) fn normalised(path: &Path) -> Option<PathBuf> {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::Normal(name) => result.push(name),
            Component::CurDir => {}
            Component::ParentDir => {
                if !result.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn findings(text: &str) -> Vec<String> {
        let pages = [
            ("docs/page.md", text),
            ("README.md", "# Ombra\n## What it can do"),
        ];
        let pages = pages.map(|(file, text)| (PathBuf::from(file), Page::parse(text)));
        let there = ["docs/page.md", "README.md", "docs/picture.png"];
        check(&pages.into(), |path| {
            there.iter().any(|file| Path::new(file) == path)
        })
    }

    #[test]
    fn good_links_pass() {
        let text = "# Top\n[a](picture.png) [b](../README.md#what-it-can-do) [c](#top)\n\
                    [d](https://example.org/nowhere) [e](mailto:nobody@example.org)";
        assert_eq!(findings(text), [""; 0]);
    }

    #[test]
    fn a_missing_file_a_missing_heading_and_a_way_out_are_named() {
        let text = "[a](missing.md)\n[b](../README.md#nothing) [c](../../outside.md)";
        assert_eq!(
            findings(text),
            [
                "docs/page.md:1: the link \"missing.md\" leads to no file",
                "docs/page.md:2: the link \"../README.md#nothing\" names no heading there",
                "docs/page.md:2: the link \"../../outside.md\" leads out of the checkout",
            ]
        );
    }

    #[test]
    fn a_page_that_the_index_does_not_name_is_found() {
        let pages = [
            ("docs/README.md", "[Structures](structures.md)"),
            ("docs/structures.md", ""),
            ("docs/lost.md", ""),
            ("README.md", ""),
        ];
        let pages = pages.map(|(file, text)| (PathBuf::from(file), Page::parse(text)));
        assert_eq!(
            unlisted(&pages.into()),
            ["docs/README.md does not name docs/lost.md"]
        );
    }

    #[test]
    fn the_links_of_this_checkout_lead_somewhere() {
        run().unwrap();
    }
}
