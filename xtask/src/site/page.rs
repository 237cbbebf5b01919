//! A Markdown page as HTML: formulas set, links led to their places on the site, headings with
//! anchors.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use pulldown_cmark::{CodeBlockKind, CowStr, Event, Tag, TagEnd, html};

use super::{place, relative};
use crate::formula::{Display, mathml};
use crate::links::{is_elsewhere, normalised};
use crate::markdown::{Page, parser};

/// The HTML of a page's content. Files that it links to are added to `linked`.
///
/// # Errors
/// The first formula that cannot be set.
pub(super) fn html(
    path: &Path,
    text: &str,
    page: &Page,
    linked: &mut Vec<PathBuf>,
) -> Result<String> {
    let mut events = Vec::new();
    let mut anchors = page.anchors.iter();
    // The anchor of the heading that is open, and the formula that is a block of its own.
    let mut anchor = "";
    let mut formula: Option<String> = None;
    for (event, range) in parser(text).into_offset_iter() {
        let line = || format!("line {}", 1 + text[..range.start].matches('\n').count());
        let set = |latex: &str, display| mathml(latex, display).with_context(line);
        match event {
            Event::Start(Tag::Heading { level, classes, .. }) => {
                anchor = anchors.next().map_or("", String::as_str);
                events.push(Event::Start(Tag::Heading {
                    level,
                    id: Some(anchor.into()),
                    classes,
                    attrs: Vec::new(),
                }));
            }
            Event::End(TagEnd::Heading(level)) => {
                let link = format!(
                    " <a class=\"anchor\" href=\"#{anchor}\" aria-label=\"Link to this part\">#</a>"
                );
                events.push(Event::InlineHtml(link.into()));
                events.push(Event::End(TagEnd::Heading(level)));
            }
            Event::Start(Tag::Link {
                link_type,
                dest_url,
                title,
                id,
            }) => {
                let dest_url = led(path, dest_url, linked);
                events.push(Event::Start(Tag::Link {
                    link_type,
                    dest_url,
                    title,
                    id,
                }));
            }
            Event::Start(Tag::Image {
                link_type,
                dest_url,
                title,
                id,
            }) => {
                let dest_url = led(path, dest_url, linked);
                events.push(Event::Start(Tag::Image {
                    link_type,
                    dest_url,
                    title,
                    id,
                }));
            }
            Event::Start(Tag::Table(columns)) => {
                events.push(Event::Html("<div class=\"table\">".into()));
                events.push(Event::Start(Tag::Table(columns)));
            }
            Event::End(TagEnd::Table) => {
                events.push(Event::End(TagEnd::Table));
                events.push(Event::Html("</div>\n".into()));
            }
            Event::InlineMath(latex) => {
                events.push(Event::InlineHtml(set(&latex, Display::Inline)?.into()));
            }
            Event::DisplayMath(latex) => {
                events.push(Event::InlineHtml(set(&latex, Display::Block)?.into()));
            }
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language)))
                if &*language == "math" =>
            {
                formula = Some(String::new());
            }
            Event::Text(latex) if formula.is_some() => {
                formula
                    .iter_mut()
                    .for_each(|formula| formula.push_str(&latex));
            }
            Event::End(TagEnd::CodeBlock) if formula.is_some() => {
                let latex = formula.take().unwrap_or_default();
                events.push(Event::Html(set(&latex, Display::Block)?.into()));
            }
            event => events.push(event),
        }
    }
    let mut content = String::with_capacity(text.len() * 2);
    html::push_html(&mut content, events.into_iter());
    Ok(content)
}

/// Where a link leads on the site.
fn led<'a>(path: &Path, target: CowStr<'a>, linked: &mut Vec<PathBuf>) -> CowStr<'a> {
    if is_elsewhere(&target) || target.starts_with('#') {
        return target;
    }
    let (file, anchor) = match target.split_once('#') {
        Some((file, anchor)) => (file, format!("#{anchor}")),
        None => (&*target, String::new()),
    };
    match normalised(&path.with_file_name(file)) {
        Some(file) => {
            let to = relative(&place(path), &place(&file)) + &anchor;
            linked.push(file);
            to.into()
        }
        // The check of the links in the checkout says that it leads out of it.
        None => target,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn content(text: &str) -> String {
        let page = Page::parse(text);
        html(Path::new("docs/a.md"), text, &page, &mut Vec::new()).unwrap()
    }

    #[test]
    fn headings_have_anchors_and_links_lead_to_pages() {
        let html =
            content("# Top `b`\n[x](sphere.md#one) [y](../README.md) [z](../xtask/src/main.rs)");
        assert!(html.contains("<h1 id=\"top-b\">"), "{html}");
        assert!(html.contains("href=\"../docs/sphere.html#one\""), "{html}");
        assert!(html.contains("href=\"../index.html\""), "{html}");
        assert!(
            html.contains("href=\"../xtask/src/main.rs.html\""),
            "{html}"
        );
    }

    #[test]
    fn formulas_are_set_in_a_line_and_on_their_own() {
        let html = content("A $t$ and\n\n$$\n\\frac{1}{2}\n$$\n\n```math\nx^2\n```\n");
        assert_eq!(html.matches("<math").count(), 3, "{html}");
        assert_eq!(html.matches("display=\"block\"").count(), 2, "{html}");
        assert!(!html.contains('$'), "{html}");
    }

    #[test]
    fn a_formula_that_is_wrong_is_named_with_its_line() {
        let text = "a\n\nb $\\nosuchcommand$\n";
        let error = html(Path::new("a.md"), text, &Page::parse(text), &mut Vec::new()).unwrap_err();
        assert!(
            format!("{error:#}").contains("line 3: the formula"),
            "{error:#}"
        );
    }
}
