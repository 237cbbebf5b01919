//! The order of the pages, and the frame that each stands in: what leads to the others.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use pulldown_cmark::{Event, Tag, TagEnd};

use super::{escaped, place, relative};
use crate::links::{is_elsewhere, normalised};
use crate::markdown::{Page, parser};

/// Where the order is written down.
const INDEX: &str = "docs/README.md";

/// The pages in their order.
#[derive(Debug)]
pub(super) struct Order {
    parts: Vec<Part>,
}

/// A part of the index: a heading and the pages under it.
#[derive(Debug, Default)]
struct Part {
    name: String,
    pages: Vec<Entry>,
}

/// A page and what it is called in the index.
#[derive(Debug)]
struct Entry {
    path: PathBuf,
    name: String,
}

impl Order {
    /// Reads the index.
    ///
    /// # Errors
    /// When it is not there.
    pub(super) fn read(file: &Path, pages: &BTreeMap<PathBuf, Page>) -> Result<Self> {
        let text = std::fs::read_to_string(file)
            .with_context(|| format!("cannot read {}", file.display()))?;
        Ok(Self::parse(&text, |path| pages.contains_key(path)))
    }

    fn parse(text: &str, is_page: impl Fn(&Path) -> bool) -> Self {
        let entry = |path: &str, name: &str| Entry {
            path: path.into(),
            name: name.to_owned(),
        };
        let mut parts = vec![Part {
            name: String::new(),
            pages: vec![entry("README.md", "ombra"), entry(INDEX, "All pages")],
        }];
        let mut words: Option<String> = None;
        let mut target = None;
        for event in parser(text) {
            match event {
                Event::Start(Tag::Heading { .. }) => words = Some(String::new()),
                Event::Start(Tag::Link { dest_url, .. }) => {
                    words = Some(String::new());
                    target = Some(dest_url);
                }
                Event::Text(text) | Event::Code(text) => {
                    words.iter_mut().for_each(|words| words.push_str(&text));
                }
                Event::End(TagEnd::Heading(level)) => {
                    let name = words.take().unwrap_or_default();
                    if level != pulldown_cmark::HeadingLevel::H1 {
                        let pages = Vec::new();
                        parts.push(Part { name, pages });
                    }
                }
                Event::End(TagEnd::Link) => {
                    let name = words.take().unwrap_or_default();
                    let path = target.take().filter(|target| !is_elsewhere(target));
                    let path =
                        path.and_then(|path| normalised(&Path::new(INDEX).with_file_name(&*path)));
                    let known = |path: &Path| {
                        let mut all = parts.iter().flat_map(|part: &Part| &part.pages);
                        all.any(|entry| entry.path == path)
                    };
                    if let Some(path) = path.filter(|path| is_page(path) && !known(path))
                        && let Some(part) = parts.last_mut()
                    {
                        part.pages.push(Entry { path, name });
                    }
                }
                _ => {}
            }
        }
        parts.retain(|part| !part.pages.is_empty());
        Self { parts }
    }

    /// The whole page at `path` of the checkout around its content.
    pub(super) fn frame(&self, path: &Path, title: &str, content: &str) -> String {
        let at = place(path);
        let to = |target: &Path| relative(&at, target);
        let mut menu = String::new();
        for part in &self.parts {
            if !part.name.is_empty() {
                menu += &format!("<h2>{}</h2>\n", escaped(&part.name));
            }
            menu += "<ol>\n";
            for entry in &part.pages {
                let here = if entry.path == path {
                    " aria-current=\"page\""
                } else {
                    ""
                };
                let (href, name) = (to(&place(&entry.path)), escaped(&entry.name));
                menu += &format!("<li><a href=\"{href}\"{here}>{name}</a></li>\n");
            }
            menu += "</ol>\n";
        }
        let title = match title {
            "" => path.display().to_string(),
            title => title.to_owned(),
        };
        let title = match title.as_str() {
            "ombra" => title,
            other => format!("{} · ombra", escaped(other)),
        };
        let (style, home) = (to(Path::new("style.css")), to(Path::new("index.html")));
        let turn = self.turn(path);
        format!(
            "<!doctype html>\n<html lang=\"en-GB\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<link rel=\"stylesheet\" href=\"{style}\">\n</head>\n<body>\n\
             <header><a class=\"home\" href=\"{home}\">ombra</a><a class=\"to-menu\" href=\"#menu\">\
             All pages</a></header>\n<main>\n{content}\n{turn}</main>\n\
             <nav id=\"menu\" aria-label=\"All pages\">\n{menu}</nav>\n</body>\n</html>\n"
        )
    }

    /// The links to the page before and the page after.
    fn turn(&self, path: &Path) -> String {
        let all: Vec<_> = self.parts.iter().flat_map(|part| &part.pages).collect();
        let Some(here) = all.iter().position(|entry| entry.path == path) else {
            return String::new();
        };
        let link = |entry: Option<&&Entry>, rel: &str, word: &str| {
            entry.map_or(String::new(), |entry| {
                let href = relative(&place(path), &place(&entry.path));
                let name = escaped(&entry.name);
                format!("<a rel=\"{rel}\" href=\"{href}\"><small>{word}</small> {name}</a>")
            })
        };
        let before = here.checked_sub(1).and_then(|before| all.get(before));
        let (before, after) = (
            link(before, "prev", "Previous"),
            link(all.get(here + 1), "next", "Next"),
        );
        format!("<nav class=\"turn\" aria-label=\"Previous and next\">{before}{after}</nav>\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_gives_the_order_and_every_page_leads_to_its_neighbours() {
        let index = "# Pages\n1. [One](one.md): text.\n2. [Two](two.md), [again](one.md)\n\n\
                     ## Else\n- [Three](../THREE.md) [code](../a.rs) [far](https://example.org)\n";
        let order = Order::parse(index, |path| path.extension().is_some_and(|e| e == "md"));
        let page = order.frame(Path::new("docs/two.md"), "Two & more", "<p>text</p>");
        assert!(
            page.contains("<title>Two &amp; more · ombra</title>"),
            "{page}"
        );
        assert!(
            page.contains("rel=\"prev\" href=\"../docs/one.html\""),
            "{page}"
        );
        assert!(
            page.contains("rel=\"next\" href=\"../THREE.html\""),
            "{page}"
        );
        assert!(page.contains("<h2>Else</h2>"), "{page}");
        assert_eq!(page.matches("<li>").count(), 5, "{page}");
        assert_eq!(page.matches("aria-current").count(), 1, "{page}");
        let first = order.frame(Path::new("README.md"), "ombra", "");
        assert!(!first.contains("rel=\"prev\""), "{first}");
        assert!(first.contains("<title>ombra</title>"), "{first}");
    }
}
