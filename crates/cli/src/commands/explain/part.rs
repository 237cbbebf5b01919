//! Where two trees part: the first ray that is not the same in both.

use serde_json::Value;

use super::document::{Ray, Sample};
use super::text::children;

/// What a ray costs, and which of several obstacles a shadow ray was shown, differs between
/// structures that have the same answers.
const OF_THE_STRUCTURE: [&str; 3] = ["nodes_visited", "tests_made", "crossed"];

/// What follows from the ray's children: looked at once they are found to be the same.
const OUTCOMES: [&str; 1] = ["radiance"];

/// What is told first, for the rest follows from it.
const FIRST: [&str; 9] = [
    "kind",
    "light",
    "origin",
    "direction",
    "t_min",
    "t_max",
    "weight",
    "weight_in_pixel",
    "end",
];

/// A value that is not the same.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Differing {
    /// The field, with dots between the levels.
    pub(crate) field: String,
    pub(crate) a: Value,
    pub(crate) b: Value,
}

/// Where two samples part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parting {
    /// The rays from the camera ray to the one that differs, in A and in B; at the last one, one of
    /// the two may have no such ray.
    pub(crate) path: Vec<[Option<usize>; 2]>,
    /// What differs; nothing where only one of them has the ray.
    pub(crate) values: Vec<Differing>,
}

/// The first ray, in the order in which rays are sent, that differs between two samples.
///
/// A ray differs if it starts, goes or ends elsewhere, counts for something else, or has other parts
/// of its own; or, when all rays below it are the same, if it brings something else for all that.
pub(crate) fn parting(a: &Sample, b: &Sample) -> anyhow::Result<Option<Parting>> {
    let below = [children(a), children(b)];
    let mut path = Vec::new();
    let roots = [a.rays.first().map(|_| 0), b.rays.first().map(|_| 0)];
    let values = descend([a, b], &below, roots, &mut path)?;
    Ok(values.map(|values| Parting { path, values }))
}

/// What differs at a ray or below it; then `path` leads there. As deep as rays are nested.
fn descend(
    samples: [&Sample; 2],
    below: &[Vec<Vec<usize>>; 2],
    rays: [Option<usize>; 2],
    path: &mut Vec<[Option<usize>; 2]>,
) -> anyhow::Result<Option<Vec<Differing>>> {
    path.push(rays);
    let [Some(a), Some(b)] = rays else {
        if rays == [None, None] {
            path.pop();
            return Ok(None);
        }
        return Ok(Some(Vec::new()));
    };
    let pair = [&samples[0].rays[a], &samples[1].rays[b]];
    let mut differing = compared(pair)?;
    let outcome = |one: &Differing| OUTCOMES.iter().any(|name| one.field.starts_with(name));
    if differing.iter().any(|one| !outcome(one)) {
        return Ok(Some(differing));
    }
    let [of_a, of_b] = [&below[0][a], &below[1][b]];
    for place in 0..of_a.len().max(of_b.len()) {
        let next = [of_a.get(place).copied(), of_b.get(place).copied()];
        if let Some(values) = descend(samples, below, next, path)? {
            return Ok(Some(values));
        }
    }
    if differing.is_empty() {
        path.pop();
        return Ok(None);
    }
    differing.truncate(16);
    Ok(Some(differing))
}

fn compared([a, b]: [&Ray; 2]) -> anyhow::Result<Vec<Differing>> {
    let mut differing = Vec::new();
    let (x, y) = (serde_json::to_value(a)?, serde_json::to_value(b)?);
    compare("", &x, &y, &mut differing);
    // Where both are free, what dims the light is the same for all structures.
    let free = a.end == "free" && b.end == "free";
    differing.retain(|one| {
        let field = one.field.split(['.', '[']).next().unwrap_or("");
        let of_the_structure = OF_THE_STRUCTURE.contains(&field) && !(field == "crossed" && free);
        // A number of a ray differs only after another ray was sent or not.
        let number = field == "ray" || field == "parent" || one.field.ends_with(".ray");
        !of_the_structure && !number
    });
    let place = |one: &Differing| {
        let of = FIRST.iter().position(|name| one.field == *name);
        of.unwrap_or(FIRST.len())
    };
    differing.sort_by_key(place);
    Ok(differing)
}

fn compare(field: &str, a: &Value, b: &Value, differing: &mut Vec<Differing>) {
    match (a, b) {
        (Value::Object(x), Value::Object(y)) => {
            let dot = if field.is_empty() { "" } else { "." };
            for (name, value) in x {
                let other = y.get(name).unwrap_or(&Value::Null);
                compare(&format!("{field}{dot}{name}"), value, other, differing);
            }
        }
        (Value::Array(x), Value::Array(y))
            if x.len() == y.len() && x.iter().any(|one| !one.is_number()) =>
        {
            for (index, (one, other)) in x.iter().zip(y).enumerate() {
                compare(&format!("{field}[{index}]"), one, other, differing);
            }
        }
        _ if a == b => {}
        _ => differing.push(Differing {
            field: field.to_owned(),
            a: shortest(a),
            b: shortest(b),
        }),
    }
}

/// The same with numbers as short as single precision has them.
fn shortest(value: &Value) -> Value {
    match value {
        Value::Array(values) => values.iter().map(shortest).collect(),
        Value::Object(fields) => {
            let fields = fields.iter();
            let fields = fields.map(|(name, value)| (name.clone(), shortest(value)));
            Value::Object(fields.collect())
        }
        Value::Number(number) if number.is_f64() => {
            let single = number.as_f64().map(|x| x as f32);
            let text = single.map(|x| x.to_string());
            let parsed = text.and_then(|text| text.parse::<f64>().ok());
            parsed.map_or_else(|| value.clone(), Value::from)
        }
        other => other.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_as_single_precision_has_them() {
        let value = serde_json::json!({ "x": [f64::from(0.1_f32), 3, "inf"] });
        let expected = serde_json::json!({ "x": [0.1, 3, "inf"] });
        assert_eq!(shortest(&value), expected);
    }
}
