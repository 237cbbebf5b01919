//! What the checks and the site need to know of a Markdown page: its links, its headings, its commands.

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

/// A page, taken apart.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Page {
    /// Its first heading.
    pub(crate) title: String,
    /// Where its links lead.
    pub(crate) links: Vec<Item>,
    /// The anchors of its headings, as the usual hosts make them.
    pub(crate) anchors: Vec<String>,
    /// Commands in its shell blocks and in its inline code.
    pub(crate) commands: Vec<Item>,
}

/// A piece of a page and the line, from 1, on which it stands.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Item {
    pub(crate) line: usize,
    pub(crate) text: String,
}

/// The languages of code blocks that hold commands. A block that names none may hold some.
const SHELLS: [&str; 5] = ["", "sh", "bash", "shell", "console"];

/// The Markdown that the usual hosts know: tables, formulas.
pub(crate) fn parser(text: &str) -> Parser<'_> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH | Options::ENABLE_STRIKETHROUGH;
    Parser::new_ext(text, options)
}

impl Page {
    /// Takes a page apart.
    pub(crate) fn parse(text: &str) -> Self {
        let mut page = Self::default();
        let line = |byte: usize| 1 + text[..byte].matches('\n').count();
        let mut heading: Option<String> = None;
        // A block of commands: where its text begins, and the text.
        let mut block: Option<(usize, String)> = None;
        let parser = parser(text);
        let definitions = parser.reference_definitions().iter();
        let mut links: Vec<_> = definitions
            .map(|(_, link)| (link.span.start, link.dest.to_string()))
            .collect();
        for (event, range) in parser.into_offset_iter() {
            match event {
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => {
                    page.add_heading(&heading.take().unwrap_or_default());
                }
                Event::Start(Tag::CodeBlock(kind)) => {
                    let language = match &kind {
                        CodeBlockKind::Fenced(language) => language.trim(),
                        CodeBlockKind::Indented => "",
                    };
                    block = SHELLS
                        .contains(&language)
                        .then(|| (range.start, String::new()));
                }
                Event::End(TagEnd::CodeBlock) => {
                    if let Some((start, commands)) = block.take() {
                        page.add_block(line(start), &commands);
                    }
                }
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    links.push((range.start, dest_url.into_string()));
                }
                Event::Html(html) | Event::InlineHtml(html) => {
                    let targets = attributes(&html);
                    links.extend(targets.map(|target| (range.start, target.to_owned())));
                }
                Event::Code(code) => {
                    page.add_commands(line(range.start), &code);
                    heading
                        .iter_mut()
                        .for_each(|heading| heading.push_str(&code));
                }
                Event::Text(text) => {
                    heading
                        .iter_mut()
                        .for_each(|heading| heading.push_str(&text));
                    if let Some((start, commands)) = &mut block {
                        if commands.is_empty() {
                            *start = range.start;
                        }
                        commands.push_str(&text);
                    }
                }
                _ => {}
            }
        }
        links.sort();
        // A link by its label is the definition's.
        links.dedup();
        page.links = (links.into_iter())
            .map(|(start, text)| Item {
                line: line(start),
                text,
            })
            .collect();
        page
    }

    fn add_block(&mut self, first: usize, text: &str) {
        let mut command = String::new();
        for (index, line) in text.lines().enumerate() {
            command.push_str(line.trim().trim_start_matches("$ "));
            if command.ends_with('\\') {
                command.pop();
            } else {
                self.add_commands(first + index, &std::mem::take(&mut command));
            }
        }
    }

    fn add_heading(&mut self, heading: &str) {
        if self.title.is_empty() {
            self.title = heading.to_owned();
        }
        let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
        let slug: String = heading.to_lowercase().chars().filter(kept).collect();
        let slug = slug.replace(' ', "-");
        let twins = |s: &&String| **s == slug || s.rsplit_once('-').is_some_and(|(a, _)| a == slug);
        let anchor = match self.anchors.iter().filter(twins).count() {
            0 => slug,
            n => format!("{slug}-{n}"),
        };
        self.anchors.push(anchor);
    }

    /// Keeps those parts of a shell line that call `cargo` or `ombra`.
    fn add_commands(&mut self, line: usize, text: &str) {
        let text = text.split(" #").next().unwrap_or_default();
        for part in text.split(['|', ';']).flat_map(|part| part.split("&&")) {
            let is_setting = |word: &&str| word.contains('=') && !word.starts_with('-');
            let words: Vec<_> = part.split_whitespace().skip_while(is_setting).collect();
            if matches!(words.first(), Some(&("cargo" | "ombra"))) && words.len() > 1 {
                let text = words.join(" ");
                self.commands.push(Item { line, text });
            }
        }
    }
}

/// Where the links in a piece of HTML lead: `src="target"` and `href="target"`.
pub(crate) fn attributes(html: &str) -> impl Iterator<Item = &str> {
    let after = |opening| html.split(opening).skip(1);
    let rest = after(" src=\"").chain(after(" href=\""));
    rest.filter_map(|rest| rest.split_once('"').map(|(target, _)| target))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(items: &[Item]) -> Vec<&str> {
        items.iter().map(|item| item.text.as_str()).collect()
    }

    #[test]
    fn an_empty_page_has_nothing() {
        assert_eq!(Page::parse(""), Page::default());
    }

    #[test]
    fn links_of_every_form_are_found_but_not_those_in_code() {
        let page = Page::parse(
            "See [a](a.md) and ![b](b.png \"title\").\n\n\
             [c]: c.md\n\n\
             <img src=\"d.png\" width=\"3\"> `[not](this.md)`\n\
             ```rust\n[nor](that.md)\n```\n",
        );
        assert_eq!(texts(&page.links), ["a.md", "b.png", "c.md", "d.png"]);
        assert_eq!(page.links[2].line, 3);
    }

    #[test]
    fn headings_become_anchors() {
        let page = Page::parse("# The `kd` tree, twice!\n## Ties\n## Ties\n");
        assert_eq!(page.anchors, ["the-kd-tree-twice", "ties", "ties-1"]);
    }

    #[test]
    fn commands_are_found_in_shell_blocks_and_inline() {
        let page = Page::parse(
            "Run `cargo xtask test` or `let x = 1`.\n\
             ```sh\n\
             $ ombra render a.obj \\\n  --spp 4   # slowly\n\
             NAME=1 cargo run && ls | ombra info -\n\
             ```\n\
             ```rust\n// cargo nonsense\n```\n",
        );
        assert_eq!(
            texts(&page.commands),
            [
                "cargo xtask test",
                "ombra render a.obj --spp 4",
                "cargo run",
                "ombra info -",
            ]
        );
        assert_eq!(page.commands[1].line, 4);
    }
}
