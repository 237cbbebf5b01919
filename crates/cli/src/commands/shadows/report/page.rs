//! The page of a report: one file that needs nothing else, on a screen and on paper.

use std::fmt::Write as _;

use ombra_study::html::{document, escaped, table};

use super::super::output::VERSION;
use super::frame::Report;

const STYLE: &str = "
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: 0 1.5rem; }
.facts dd { overflow-wrap: anywhere; }
.wide th, .wide td { white-space: normal; vertical-align: top; }
.wide thead th { vertical-align: bottom; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 1rem; }
figure { break-inside: avoid; } figure svg { width: 100%; height: auto; display: block; border: 1px solid var(--line); }
figcaption { font-size: .9rem; margin-top: .3rem; }
code { overflow-wrap: anywhere; }
.findings { border-left: 4px solid #c60; padding-left: 1rem; }
@media print {
  @page { size: landscape; margin: 12mm; }
  :root { color-scheme: light; }
  body { font-size: 10pt; max-width: none; padding: 0; }
  table { font-size: 8pt; } thead { display: table-header-group; } tr { break-inside: avoid; }
  th, td { padding: .15rem .3rem; } .wide { overflow: visible; }
  h2 { break-after: avoid; }
}
";

/// The page, with the command that makes it again.
pub(super) fn html(report: &Report, command: &str) -> String {
    let columns = &report.table.columns;
    let is_shown = |index: &usize| !columns[*index].head.is_empty();
    let shown: Vec<usize> = (0..columns.len()).filter(is_shown).collect();
    let heads: Vec<&str> = shown.iter().map(|&index| columns[index].head).collect();
    let row = |row: &Vec<super::frame::Cell>| {
        let cells = shown.iter().map(|&index| row[index].shown.clone());
        cells.collect::<Vec<_>>()
    };
    let rows: Vec<Vec<String>> = report.table.rows.iter().map(row).collect();
    let fact = |key| report.facts.iter().find(|fact| fact.key == key);
    let own = fact("title").map(|title| title.cell.shown.as_str());
    let title = own.unwrap_or(report.rule.title);
    let mut content = format!("<h1>{}</h1>\n", escaped(title));
    // What it is by, if that is not the title, and what of.
    let rule = own.map(|_| report.rule.title);
    let about = ["city", "change", "when"].into_iter().filter_map(fact);
    let about = about.map(|fact| fact.cell.shown.as_str());
    let about: Vec<&str> = rule.into_iter().chain(about).collect();
    let _ = writeln!(content, "<p>{}</p>", escaped(&about.join(" · ")));
    content += &list("", &report.summary);
    if !report.findings.is_empty() {
        let findings = list("", &report.findings);
        let _ = write!(
            content,
            "<section class=\"findings\" aria-label=\"Findings\">\n<h2>To be known</h2>\n{findings}</section>\n"
        );
    }
    let _ = write!(
        content,
        "<h2>{}</h2>\n{}",
        escaped(report.table.name),
        table(report.table.name, &heads, &rows)
    );
    if !report.figures.is_empty() {
        content += "<h2>Maps</h2>\n<div class=\"figures\">\n";
        for figure in &report.figures {
            let _ = write!(
                content,
                "<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
                figure.svg,
                escaped(&figure.caption)
            );
        }
        content += "</div>\n";
    }
    content += "<h2>How it was measured</h2>\n<dl class=\"facts\">\n";
    for fact in &report.facts {
        let _ = writeln!(
            content,
            "<div><dt>{}</dt><dd>{}</dd></div>",
            escaped(fact.name),
            escaped(&fact.cell.shown)
        );
    }
    let _ = write!(
        content,
        "</dl>\n<h2>The rule</h2>\n{}{}<h2>The command</h2>\n<p><code>{}</code></p>\n<p>{}</p>\n",
        list("Sources", report.rule.sources),
        list("As it is read here", &report.rule.conventions),
        escaped(command),
        escaped(VERSION),
    );
    document(title, STYLE, &content, None)
}

fn list(name: &str, items: &[impl AsRef<str>]) -> String {
    if items.is_empty() {
        return String::new();
    }
    let mut text = String::new();
    if !name.is_empty() {
        let _ = writeln!(text, "<h3>{}</h3>", escaped(name));
    }
    text += "<ul>\n";
    for item in items {
        let _ = writeln!(text, "<li>{}</li>", escaped(item.as_ref()));
    }
    text + "</ul>\n"
}
