//! What all reports have in common: a rule, facts about the run, a table, findings, maps.

use serde_json::{Map, Value};

/// A rule and where it stands.
pub(super) struct RuleText {
    pub(super) title: &'static str,
    /// Titles, editions, sections.
    pub(super) sources: &'static [&'static str],
    /// What the rule leaves open, or is read as here.
    pub(super) conventions: Vec<String>,
}

/// A finished report.
pub(super) struct Report {
    pub(super) rule: RuleText,
    /// What was measured and how: a key for programs, a name for people, and what is so.
    pub(super) facts: Vec<Fact>,
    pub(super) table: Table,
    /// What a reader should know: resources without places, areas that are built over.
    pub(super) findings: Vec<String>,
    /// In one sentence each, what came out.
    pub(super) summary: Vec<String>,
    pub(super) figures: Vec<Figure>,
    /// What else the JSON holds.
    pub(super) more: Map<String, Value>,
}

/// Something that is so of the whole run.
pub(super) struct Fact {
    pub(super) key: &'static str,
    pub(super) name: &'static str,
    pub(super) cell: Cell,
}

/// A map as SVG, and what it shows.
pub(super) struct Figure {
    pub(super) caption: String,
    pub(super) svg: String,
}

/// Rows of cells under columns.
pub(super) struct Table {
    pub(super) name: &'static str,
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Vec<Cell>>,
}

/// What a column is called: by programs, with its unit, and by people. What has no name for people is for programs alone.
pub(super) struct Column {
    pub(super) key: &'static str,
    pub(super) head: &'static str,
}

/// A value for programs, and as people read it.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub(super) value: Value,
    pub(super) shown: String,
}

impl Cell {
    pub(super) fn text(text: impl Into<String>) -> Self {
        let shown = text.into();
        Self {
            value: shown.clone().into(),
            shown,
        }
    }

    /// Shown otherwise than it is.
    pub(super) fn shown(value: impl Into<Value>, shown: impl Into<String>) -> Self {
        Self {
            value: value.into(),
            shown: shown.into(),
        }
    }

    /// To so many digits after the point.
    pub(super) fn number(value: f64, digits: usize) -> Self {
        let text = format!("{value:.digits$}");
        Self {
            value: rounded(value, digits),
            shown: grouped(&text),
        }
    }

    /// A share of one, as percent to so many digits after the point.
    pub(super) fn percent(share: f64, digits: usize) -> Self {
        Self::number(100.0 * share, digits)
    }

    pub(super) fn count(count: usize) -> Self {
        Self {
            value: count.into(),
            shown: grouped(&count.to_string()),
        }
    }

    pub(super) fn yes(is_so: bool) -> Self {
        Self::shown(is_so, if is_so { "yes" } else { "no" })
    }

    /// Nothing to be told.
    pub(super) fn nothing() -> Self {
        Self::shown(Value::Null, "–")
    }

    /// The cell of what there is.
    pub(super) fn of<T>(value: Option<T>, cell: impl FnOnce(T) -> Self) -> Self {
        value.map_or_else(Self::nothing, cell)
    }
}

/// A number without digits that mean nothing, so that files stay the same where rounding does not.
pub(super) fn rounded(value: f64, digits: usize) -> Value {
    let text = format!("{value:.digits$}");
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
    // No negative zero.
    value.map_or(Value::Null, |value| (value + 0.0).into())
}

/// With a thin gap between thousands.
fn grouped(text: &str) -> String {
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let (sign, digits) = whole.split_at(usize::from(whole.starts_with('-')));
    let mut shown = sign.to_owned();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index) % 3 == 0 && digits.len() > 4 {
            shown.push('\u{202f}');
        }
        shown.push(digit);
    }
    shown + rest
}

/// Feet of a metre, and square feet of a square metre: the international foot is 0.3048 m.
pub(super) const SQUARE_FEET: f64 = 1.0 / (0.3048 * 0.3048);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_and_grouped() {
        let shown = |value, digits| Cell::number(value, digits).shown;
        assert_eq!(shown(1_234_567.891, 1), "1\u{202f}234\u{202f}567.9");
        assert_eq!(shown(1234.0, 0), "1234");
        assert_eq!(shown(-12_345.0, 0), "-12\u{202f}345");
        assert_eq!(shown(0.0, 2), "0.00");
        assert_eq!(Cell::number(0.125_49, 3).value, 0.125);
        assert_eq!(Cell::number(-0.000_01, 2).value.to_string(), "0.0");
        assert_eq!(Cell::number(f64::NAN, 2).value, Value::Null);
    }
}
