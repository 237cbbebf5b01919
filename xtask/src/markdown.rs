//! What the checks need to know of a Markdown page: its links, its headings, its commands.

/// A page, taken apart.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Page {
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

impl Page {
    /// Takes a page apart.
    pub(crate) fn parse(text: &str) -> Self {
        let mut page = Self::default();
        let mut block: Option<&str> = None;
        let mut command = String::new();
        for (index, line) in text.lines().enumerate() {
            let number = index + 1;
            let trimmed = line.trim();
            if let Some(fence) = trimmed.strip_prefix("```") {
                block = if block.is_some() {
                    None
                } else {
                    Some(fence.trim())
                };
                continue;
            }
            match block {
                Some(language) if SHELLS.contains(&language) => {
                    command.push_str(trimmed.trim_start_matches("$ "));
                    if command.ends_with('\\') {
                        command.pop();
                    } else {
                        page.add_commands(number, &std::mem::take(&mut command));
                    }
                }
                Some(_) => {}
                None => page.prose(number, line),
            }
        }
        page
    }

    fn prose(&mut self, number: usize, line: &str) {
        if line.starts_with('#') {
            self.add_heading(line.trim_start_matches('#').trim());
        }
        // Every second piece between backticks is code.
        let mut prose = String::new();
        for (index, piece) in line.split('`').enumerate() {
            if index % 2 == 0 {
                prose.push_str(piece);
            } else {
                self.add_commands(number, piece);
            }
        }
        for target in targets(&prose) {
            self.links.push(Item {
                line: number,
                text: target.to_owned(),
            });
        }
    }

    fn add_heading(&mut self, heading: &str) {
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

/// Where the links of a line lead: `[text](target)`, `[label]: target`, `src="target"` and
/// `href="target"`.
fn targets(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for (opening, closing) in [("](", ')'), ("src=\"", '"'), ("href=\"", '"')] {
        for rest in line.split(opening).skip(1) {
            if let Some((target, _)) = rest.split_once(closing) {
                // A title may follow the target.
                found.extend(target.split_whitespace().next());
            }
        }
    }
    if line.starts_with('[')
        && let Some((_, target)) = line.split_once("]: ")
    {
        found.extend(target.split_whitespace().next());
    }
    found
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
            "See [a](a.md) and ![b](b.png \"title\").\n\
             [c]: c.md\n\
             <img src=\"d.png\" width=\"3\"> `[not](this.md)`\n\
             ```rust\n[nor](that.md)\n```\n",
        );
        assert_eq!(texts(&page.links), ["a.md", "b.png", "c.md", "d.png"]);
        assert_eq!(page.links[2].line, 2);
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
