//! Outlines of buildings with attributes, as JSON has them.

use ombra_city::heights::Value as Attribute;
use ombra_city::{Draft, DraftBuilding, DraftPart};
use serde_json::{Map, Value};

use super::CityOptions;

/// No ground lies higher above the sea, or lower below it, in metres.
const HIGHEST_GROUND: f64 = 9000.0;

/// A polygon as a file has it: an outer ring and holes, and the lowest z of its corners, if they
/// have any.
#[derive(Clone, Debug, Default)]
pub(super) struct Outline {
    pub(super) rings: Vec<Vec<[f64; 2]>>,
    lowest: Option<f64>,
}

/// Whether the rings of a format repeat their first corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Closing {
    /// They must.
    Asked,
    /// They may.
    Free,
}

impl Outline {
    /// Out of a list of rings. An error says what it is instead, so that it reads on after
    /// "polygon".
    pub(super) fn read(rings: &Value) -> Result<Self, &'static str> {
        let rings = rings.as_array().ok_or("without a list of rings")?;
        if rings.is_empty() {
            return Err("without rings");
        }
        let mut outline = Self::default();
        for ring in rings {
            let places = ring.as_array().ok_or("with a ring that is no list")?;
            let mut corners = Vec::with_capacity(places.len());
            for place in places {
                let numbers = place.as_array().map_or(&[][..], Vec::as_slice);
                let [x, y, rest @ ..] = numbers else {
                    return Err("with a corner that is no pair of numbers");
                };
                let (Some(x), Some(y)) = (x.as_f64(), y.as_f64()) else {
                    return Err("with a corner that is no pair of numbers");
                };
                corners.push([x, y]);
                if let Some(z) = rest.first().and_then(Value::as_f64) {
                    outline.lowest = Some(outline.lowest.map_or(z, |low| low.min(z)));
                }
            }
            outline.rings.push(corners);
        }
        Ok(outline)
    }
}

/// Adds a building of these outlines, if its attributes tell its height.
pub(super) fn add(
    draft: &mut Draft,
    outlines: Vec<Outline>,
    (id, place): (Option<String>, String),
    attributes: &Map<String, Value>,
    closing: Closing,
    options: &CityOptions,
) {
    let names = attributes.keys().map(String::as_str);
    draft.names.look(&options.heights, names);
    let find = |name: &str| attribute(attributes, name);
    let Some(told) = options.heights.read(find, &place, &mut draft.notes) else {
        return;
    };
    let metres = draft.crs.metres_of_height();
    let lowest = outlines
        .iter()
        .filter_map(|outline| outline.lowest)
        .reduce(f64::min);
    let ground = match lowest.map(|z| z * metres) {
        Some(z) if z.abs() <= HIGHEST_GROUND => z,
        Some(z) => {
            let message = format!("z of its corners cannot be ({z} m): 0 is used");
            draft.notes.add_kind("z", &place, message);
            0.0
        }
        None => 0.0,
    };
    if closing == Closing::Asked {
        for ring in outlines.iter().flat_map(|outline| &outline.rings) {
            if ring.len() > 2 && ring.first() != ring.last() {
                draft.notes.add(&place, "ring is not closed: closed");
            }
        }
    }
    let (base, top) = (ground + told.base, ground + told.height);
    let part = |outline: Outline| DraftPart::Footprint {
        rings: outline.rings,
        base,
        top,
    };
    draft.buildings.push(DraftBuilding {
        id,
        place,
        parts: outlines.into_iter().map(part).collect(),
        ground,
        ground_elevation: told.ground_elevation,
    });
}

/// An attribute by its name; if there is none, by its name in other capitals.
pub(super) fn attribute<'a>(
    attributes: &'a Map<String, Value>,
    name: &str,
) -> Option<Attribute<'a>> {
    let other = || {
        let mut all = attributes.iter();
        all.find(|(key, _)| key.eq_ignore_ascii_case(name))
            .map(|(_, value)| value)
    };
    Some(match attributes.get(name).or_else(other)? {
        Value::Null => Attribute::Null,
        Value::Number(number) => Attribute::Number(number.as_f64().unwrap_or(f64::NAN)),
        Value::String(text) => Attribute::Text(text),
        Value::Bool(_) => Attribute::Other("true or false"),
        Value::Array(_) => Attribute::Other("a list"),
        Value::Object(_) => Attribute::Other("an object"),
    })
}

/// A name that is a text or a number.
pub(super) fn name(value: Option<&Value>) -> Option<String> {
    match value? {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    }
}
