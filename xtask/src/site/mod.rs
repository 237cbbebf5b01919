//! The website: every Markdown page of the checkout as HTML, with the pictures and the source files
//! that they link to, in `target/docs/`. It needs no network and no script.
//!
//! A page keeps its place: `docs/sphere.md` becomes `docs/sphere.html`, and a README the `index.html`
//! of its folder. The order of the pages is that of the links in `docs/README.md`.

mod check;
mod order;
mod page;
mod sources;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};

use crate::cargo;
use crate::links;
use crate::markdown::Page;

use order::Order;

/// Where it goes, under the root of the checkout.
const FOLDER: &str = "target/docs";

/// What all pages look like.
const STYLE: &str = include_str!("style.css");

/// A file of the site, by its path in it.
type Files = BTreeMap<PathBuf, Content>;

/// What a file of the site holds.
#[derive(Debug)]
enum Content {
    /// These characters.
    Text(String),
    /// What this file of the checkout holds.
    Copy(PathBuf),
}

/// Builds the site, checks the links in it and writes it.
///
/// # Errors
/// When a formula is wrong, a link leads nowhere or a file cannot be written.
pub(crate) fn run() -> Result<()> {
    let pages = links::pages()?;
    let files = build(&pages)?;
    let findings = check::check(&files);
    ensure!(findings.is_empty(), "{}", findings.join("\n"));
    write(&files)?;
    println!(
        "{} pages and {} files beside them are in {FOLDER}/index.html",
        pages.len(),
        files.len() - pages.len()
    );
    Ok(())
}

fn build(pages: &BTreeMap<PathBuf, Page>) -> Result<Files> {
    let root = cargo::root();
    let tracked = cargo::tracked(&[""])?;
    let order = Order::read(&root.join("docs/README.md"), pages)?;
    let mut linked = Vec::new();
    let mut files = Files::new();
    for (path, page) in pages {
        let text = fs::read_to_string(root.join(path))?;
        let html = page::html(path, &text, page, &mut linked)
            .with_context(|| path.display().to_string())?;
        let html = order.frame(path, &page.title, &html);
        files.insert(place(path), Content::Text(html));
    }
    sources::add(&linked, &tracked, &order, &mut files)?;
    files.insert("style.css".into(), Content::Text(STYLE.to_owned()));
    Ok(files)
}

/// Where a file of the checkout is on the site.
fn place(path: &Path) -> PathBuf {
    let ending = path.extension().and_then(|ending| ending.to_str());
    match ending {
        Some("md") if path.file_stem().is_some_and(|stem| stem == "README") => {
            path.with_file_name("index.html")
        }
        Some("md") => path.with_extension("html"),
        Some("png" | "jpg" | "svg" | "html" | "css" | "glb") => path.to_owned(),
        // Source files keep their ending: `ray.rs` is not `ray.md`.
        Some(ending) => path.with_extension(format!("{ending}.html")),
        None if cargo::root().join(path).is_dir() => path.join("index.html"),
        None => path.with_extension("html"),
    }
}

/// How a page at `from` names the file at `to`, both paths in the site.
fn relative(from: &Path, to: &Path) -> String {
    let depth = from.parent().map_or(0, |folder| folder.iter().count());
    let up = "../".repeat(depth);
    let names: Vec<_> = to.iter().map(|name| name.to_string_lossy()).collect();
    up + &names.join("/")
}

/// Text as HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// Writes all files, in the place of those of the last time.
fn write(files: &Files) -> Result<()> {
    let folder = cargo::root().join(FOLDER);
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| format!("cannot replace {FOLDER}"))?;
    }
    for (path, content) in files {
        let to = folder.join(path);
        let written = || -> std::io::Result<()> {
            fs::create_dir_all(to.parent().unwrap_or(&folder))?;
            match content {
                Content::Text(text) => fs::write(&to, text),
                Content::Copy(from) => fs::copy(cargo::root().join(from), &to).map(drop),
            }
        };
        written().with_context(|| format!("cannot write {}", to.display()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_has_its_place() {
        let place = |path: &str| place(Path::new(path)).display().to_string();
        assert_eq!(place("README.md"), "index.html");
        assert_eq!(place("docs/README.md"), "docs/index.html");
        assert_eq!(place("docs/sphere.md"), "docs/sphere.html");
        assert_eq!(place("docs/pictures/a.png"), "docs/pictures/a.png");
        assert_eq!(place("xtask/src/main.rs"), "xtask/src/main.rs.html");
        assert_eq!(place("xtask/src"), "xtask/src/index.html");
        assert_eq!(place("LICENSE-MIT"), "LICENSE-MIT.html");
    }

    #[test]
    fn a_page_names_others_from_where_it_is() {
        let relative = |from: &str, to: &str| relative(Path::new(from), Path::new(to));
        assert_eq!(relative("index.html", "docs/a.html"), "docs/a.html");
        assert_eq!(relative("docs/a.html", "docs/b.html"), "../docs/b.html");
        assert_eq!(relative("a/b/c.html", "style.css"), "../../style.css");
    }

    #[test]
    fn the_pages_of_this_checkout_make_a_site_whose_links_lead_somewhere() {
        let files = build(&links::pages().unwrap()).unwrap();
        assert_eq!(check::check(&files), [""; 0]);
        for page in ["index.html", "docs/index.html", "docs/structures.html"] {
            assert!(files.contains_key(Path::new(page)), "{page}");
        }
    }
}
