//! What all pages that ombra writes have in common: one file each, which needs nothing else.

use std::fmt::Write as _;

/// The look of a page: text, tables, figures, in light and dark as the reader's system has it.
pub const STYLE: &str = "
:root { color-scheme: light dark; --line: #8886; }
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 72rem; padding: 1rem; }
h1 { font-size: 1.4rem; margin: 0 0 .5rem; }
h2 { font-size: 1.1rem; margin: 1.5rem 0 .5rem; }
dl { margin: 0; } dt { font-size: .9rem; opacity: .8; } dd { margin: 0 0 .6rem; font-weight: 600; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .9rem; }
th, td { padding: .25rem .6rem; border-bottom: 1px solid var(--line); text-align: right;
  font-variant-numeric: tabular-nums; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
figure { margin: 1rem 0 0; }
";

/// A whole page. `style` is added to [`STYLE`]; `content` stands in `<main>`, `script` at the end
/// where there is one.
#[must_use]
pub fn document(title: &str, style: &str, content: &str, script: Option<&str>) -> String {
    let title = escaped(title);
    let script = script.map_or(String::new(), |script| {
        format!("<script>{script}</script>\n")
    });
    format!(
        "<!doctype html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<title>{title}</title>
<style>{STYLE}{style}</style>
</head>
<body>
<main>
{content}</main>
{script}</body>
</html>
"
    )
}

/// A table that scrolls sideways where it does not fit: its name, the heads of its columns, and rows
/// whose first cell is their head. Cells are text.
#[must_use]
pub fn table(name: &str, heads: &[&str], rows: &[Vec<String>]) -> String {
    let mut text = format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">\n<table>\n<thead><tr>",
        escaped(name)
    );
    // Writing to a string does not fail.
    for head in heads {
        let _ = write!(text, "<th scope=\"col\">{}</th>", escaped(head));
    }
    text += "</tr></thead>\n<tbody>\n";
    for row in rows {
        text += "<tr>";
        for (column, cell) in row.iter().enumerate() {
            let cell = escaped(cell);
            let _ = match column {
                0 => write!(text, "<th scope=\"row\">{cell}</th>"),
                _ => write!(text, "<td>{cell}</td>"),
            };
        }
        text += "</tr>\n";
    }
    text + "</tbody>\n</table>\n</div>\n"
}

/// Text that means itself in HTML and XML, also within quotes; what XML cannot hold becomes a space.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&#39;",
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_end_what_it_stands_in() {
        assert_eq!(escaped("a<b>&\"c'\u{1}"), "a&lt;b&gt;&amp;&quot;c&#39; ");
        let table = table(
            "a\"b",
            &["<", ">"],
            &[vec!["<b>".to_owned(), "&".to_owned()]],
        );
        assert!(table.contains("aria-label=\"a&quot;b\""), "{table}");
        assert!(table.contains("<td>&amp;</td>"), "{table}");
        assert!(!table.contains("<b>"), "{table}");
    }
}
