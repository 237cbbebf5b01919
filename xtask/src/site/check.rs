//! The links of the site as it is built: each leads to a file of it, and to an anchor there.

use std::collections::BTreeSet;
use std::path::Path;

use super::{Content, Files};
use crate::links::{is_elsewhere, normalised};
use crate::markdown::attributes;

/// The links that lead nowhere, a line each.
pub(super) fn check(files: &Files) -> Vec<String> {
    let mut findings = Vec::new();
    for (path, content) in files {
        let Content::Text(html) = content else {
            continue;
        };
        let targets: BTreeSet<_> = attributes(html).collect();
        for target in targets.into_iter().filter(|target| !is_elsewhere(target)) {
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = match file {
                "" => Some(path.clone()),
                file => normalised(&path.with_file_name(file)),
            };
            let there = file.and_then(|file| files.get(&file));
            let wrong = match there {
                None => "leads to no file of the site",
                Some(Content::Text(html)) if !has_anchor(html, anchor) => "names no anchor there",
                Some(_) => continue,
            };
            findings.push(format!("{}: the link \"{target}\" {wrong}", shown(path)));
        }
    }
    findings
}

fn has_anchor(html: &str, anchor: &str) -> bool {
    anchor.is_empty() || html.contains(&format!(" id=\"{anchor}\""))
}

fn shown(path: &Path) -> String {
    Path::new(super::FOLDER).join(path).display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_to_no_file_and_no_anchor_are_found_and_others_pass() {
        let page = "<h1 id=\"top\"></h1><a href=\"#top\"></a><a href=\"b.html#x\"></a>\
                    <img src=\"../p.png\"><a href=\"https://example.org\"></a>\
                    <a href=\"c.html\"></a><a href=\"b.html#y\"></a><a href=\"../../d\"></a>";
        let text = |text: &str| Content::Text(text.to_owned());
        let files = Files::from([
            ("docs/a.html".into(), text(page)),
            ("docs/b.html".into(), text("<p id=\"x\">")),
            ("p.png".into(), Content::Copy("p.png".into())),
        ]);
        assert_eq!(
            check(&files),
            [
                "target/docs/docs/a.html: the link \"../../d\" leads to no file of the site",
                "target/docs/docs/a.html: the link \"b.html#y\" names no anchor there",
                "target/docs/docs/a.html: the link \"c.html\" leads to no file of the site",
            ]
        );
    }
}
