//! A bare list of polygons with heights, as the examples of deck.gl have it.

use ombra_city::{Crs, Draft};
use serde_json::{Map, Value};

use super::CityOptions;
use super::footprint::{Closing, Outline, add, name_among};
use super::json::{Each, parse_into};
use crate::error::FormatError;

pub(super) fn read(text: &[u8], options: &CityOptions) -> Result<Draft, FormatError> {
    let mut draft = Draft::new(options.crs.clone().unwrap_or_else(Crs::wgs84));
    parse_into(
        text,
        Each(|index, element| polygon(&mut draft, index, &element, options)),
    )?;
    Ok(draft)
}

fn polygon(draft: &mut Draft, index: usize, element: &Value, options: &CityOptions) {
    let place = format!("polygon {index}");
    let nothing = Map::new();
    let attributes = element.as_object().unwrap_or(&nothing);
    let Some(corners) = attributes.get("polygon") else {
        draft.notes.add(&place, "no \"polygon\" in it: left out");
        return;
    };
    // One ring, or a list of rings.
    let is_ring = corners[0][0].is_number();
    let outline = if is_ring {
        Outline::read(&Value::Array(vec![corners.clone()]))
    } else {
        Outline::read(corners)
    };
    match outline {
        Ok(outline) => {
            let named = (name_among(attributes), place);
            add(
                draft,
                vec![outline],
                named,
                attributes,
                Closing::Free,
                options,
            );
        }
        Err(what) => draft.notes.add(&place, format!("polygon {what}: left out")),
    }
}
