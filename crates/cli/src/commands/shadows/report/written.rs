//! A report as files: a table, JSON, and a page.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use ombra::formats::{can_write_whole, write_whole};
use serde_json::{Map, Value, json};

use super::super::output::VERSION;
use super::frame::{Report, Table};
use super::page;
use crate::commands::command;

/// Which files a report is written to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Outputs {
    csv: Option<PathBuf>,
    json: Option<PathBuf>,
    html: Option<PathBuf>,
}

impl Outputs {
    /// Of a name: one file if it has the ending of one, else all three.
    pub(super) fn of(output: Option<&Path>) -> Self {
        let Some(path) = output else {
            return Self::default();
        };
        let own = || Some(path.to_owned());
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match &*ending.to_ascii_lowercase() {
            "csv" => Self {
                csv: own(),
                ..Self::default()
            },
            "json" => Self {
                json: own(),
                ..Self::default()
            },
            "html" => Self {
                html: own(),
                ..Self::default()
            },
            _ => {
                // A point in the name is no ending.
                let with = |ending: &str| {
                    let mut name = path.as_os_str().to_owned();
                    name.push(ending);
                    Some(PathBuf::from(name))
                };
                Self {
                    csv: with(".csv"),
                    json: with(".json"),
                    html: with(".html"),
                }
            }
        }
    }

    pub(super) fn paths(&self) -> impl Iterator<Item = &Path> {
        let all = [&self.csv, &self.json, &self.html];
        all.into_iter().flatten().map(PathBuf::as_path)
    }

    /// What would fail in the end fails at once.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        self.paths().try_for_each(|path| Ok(can_write_whole(path)?))
    }

    pub(super) fn write(&self, report: &Report) -> anyhow::Result<()> {
        let command = command();
        let write = |path: &Option<PathBuf>, content: &dyn Fn() -> anyhow::Result<Vec<u8>>| {
            let Some(path) = path else { return Ok(()) };
            write_whole(path, &content()?).with_context(|| "the report")
        };
        write(&self.csv, &|| csv(&report.table))?;
        write(&self.json, &|| {
            let mut text = serde_json::to_vec_pretty(&json(report, &command))?;
            text.push(b'\n');
            Ok(text)
        })?;
        write(
            &self.html,
            &|| Ok(page::html(report, &command).into_bytes()),
        )
    }
}

/// A line for each row, after one with the keys of the columns.
fn csv(table: &Table) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(table.columns.iter().map(|column| column.key))?;
    for row in &table.rows {
        let fields = row.iter().map(|cell| match &cell.value {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        });
        writer.write_record(fields)?;
    }
    Ok(writer.into_inner()?)
}

/// All of it.
pub(super) fn json(report: &Report, command: &str) -> Value {
    let columns = &report.table.columns;
    let row = |row: &Vec<_>| -> Map<String, Value> {
        let cells = columns.iter().zip(row);
        let member = |(column, cell): (&super::frame::Column, &super::frame::Cell)| {
            (column.key.to_owned(), cell.value.clone())
        };
        cells.map(member).collect()
    };
    let mut all = Map::new();
    all.insert(
        "rule".to_owned(),
        json!({
            "title": report.rule.title,
            "sources": report.rule.sources,
            "conventions": report.rule.conventions,
        }),
    );
    all.insert("command".to_owned(), command.into());
    all.insert("version".to_owned(), VERSION.into());
    for fact in &report.facts {
        all.insert(fact.key.to_owned(), fact.cell.value.clone());
    }
    all.insert("summary".to_owned(), report.summary.clone().into());
    let rows: Vec<Value> = report
        .table
        .rows
        .iter()
        .map(|own| row(own).into())
        .collect();
    all.insert("rows".to_owned(), rows.into());
    all.insert("findings".to_owned(), report.findings.clone().into());
    all.extend(report.more.clone());
    all.into()
}

#[cfg(test)]
mod tests {
    use super::super::frame::{Cell, Column};
    use super::*;

    #[test]
    fn a_name_is_one_file_or_three() {
        let paths = |name: &str| {
            let outputs = Outputs::of(Some(Path::new(name)));
            let names = outputs.paths().map(|path| path.display().to_string());
            names.collect::<Vec<_>>()
        };
        assert_eq!(paths("out/a"), ["out/a.csv", "out/a.json", "out/a.html"]);
        assert_eq!(paths("a.v2"), ["a.v2.csv", "a.v2.json", "a.v2.html"]);
        assert_eq!(paths("a.CSV"), ["a.CSV"]);
        assert_eq!(paths("a.json"), ["a.json"]);
        assert_eq!(paths("a.html"), ["a.html"]);
        assert_eq!(Outputs::of(None), Outputs::default());
    }

    #[test]
    fn a_table_of_commas_and_quotes_is_one_that_can_be_read() {
        let column = |key| Column { key, head: key };
        let table = Table {
            name: "t",
            columns: vec![column("name"), column("hours"), column("is_so")],
            rows: vec![
                vec![
                    Cell::text("a, \"b\""),
                    Cell::number(1.25, 1),
                    Cell::yes(true),
                ],
                vec![Cell::text("c"), Cell::nothing(), Cell::yes(false)],
            ],
        };
        let text = String::from_utf8(csv(&table).unwrap()).unwrap();
        assert_eq!(
            text,
            "name,hours,is_so\n\"a, \"\"b\"\"\",1.2,true\nc,,false\n"
        );
    }
}
