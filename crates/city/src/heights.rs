//! How tall a building is, as files tell it.
//!
//! Of the attributes of a building the first one that is known ([`HEIGHTS`]) and has a usable value
//! counts; capitals do not matter. A height is told from the ground to the top, so that a part that
//! hangs in the air ([`BASES`]) reaches from its base to its height, as in OpenStreetMap.
//!
//! A value is a number or a text with or without a unit: `12`, `"12 m"`, `"40 ft"`, `"40'6\""`,
//! `"12,5"`. A comma followed by three digits could be that of thousands as well and is refused.
//! Heights above 0 up to [`TALLEST`] metres are believed; all others are findings.

mod names;
mod text;

use crate::finding::Notes;
pub use names::Names;
use text::metres_told;

/// Metres of one level (storey).
pub const LEVEL: f64 = 3.0;

/// Metres of one foot.
pub const FOOT: f64 = 0.3048;

/// Nothing built is taller, in metres; the Jeddah Tower is to reach 1,008 m.
pub const TALLEST: f64 = 1200.0;

/// What a number without a unit counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Metres.
    Metres,
    /// Feet of 0.3048 m.
    Feet,
    /// Levels of [`LEVEL`] metres.
    Levels,
}

impl Unit {
    /// How many metres one of it is.
    #[must_use]
    pub const fn metres(self) -> f64 {
        match self {
            Self::Metres => 1.0,
            Self::Feet => FOOT,
            Self::Levels => LEVEL,
        }
    }
}

/// The value of an attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// A number.
    Number(f64),
    /// A text.
    Text(&'a str),
    /// It is there, but null.
    Null,
    /// Something that can be no height, by its kind: "a list".
    Other(&'static str),
}

/// The attributes that tell heights above the ground, the most trusted first, and what their
/// numbers count. A name says its unit, or it is that of a well-known data set.
pub const HEIGHTS: &[(&str, Unit)] = &[
    // OpenStreetMap, Overture Maps and most others.
    ("height", Unit::Metres),
    ("render_height_m", Unit::Metres),
    // OpenMapTiles.
    ("render_height", Unit::Metres),
    ("height_m", Unit::Metres),
    // CityGML and CityJSON.
    ("measuredHeight", Unit::Metres),
    ("building:height", Unit::Metres),
    ("building_height", Unit::Metres),
    ("buildingHeight", Unit::Metres),
    // IGN BD TOPO.
    ("hauteur", Unit::Metres),
    // NYC Open Data, new and old.
    ("height_roof", Unit::Feet),
    ("heightroof", Unit::Feet),
    ("height_ft", Unit::Feet),
    ("levels", Unit::Levels),
    ("building:levels", Unit::Levels),
    ("building_levels", Unit::Levels),
    // Overture Maps.
    ("num_floors", Unit::Levels),
    ("floors", Unit::Levels),
    ("floor", Unit::Levels),
    ("storeysAboveGround", Unit::Levels),
    ("storeys", Unit::Levels),
    ("stories", Unit::Levels),
];

/// The attributes that tell how far above the ground a part begins.
pub const BASES: &[(&str, Unit)] = &[
    ("min_height", Unit::Metres),
    ("building:min_height", Unit::Metres),
    ("render_min_height", Unit::Metres),
    ("min_level", Unit::Levels),
    ("building:min_level", Unit::Levels),
    ("min_floor", Unit::Levels),
];

/// The attribute that counts levels without those in the roof, and the attributes that tell how high
/// the roof is on top of them, as OpenStreetMap has it. A height in metres has the roof in it.
pub const WITHOUT_ROOF: &str = "building:levels";
/// See [`WITHOUT_ROOF`].
pub const ROOFS: &[(&str, Unit)] = &[("roof:height", Unit::Metres), ("roof:levels", Unit::Levels)];

/// The attributes that tell how high above the sea the ground of a building lies. They raise
/// nothing: on a flat map the ground beside the building would stay below.
pub const GROUNDS: &[(&str, Unit)] = &[
    ("render_base_m", Unit::Metres),
    // NYC Open Data, new and old.
    ("ground_elevation", Unit::Feet),
    ("groundelev", Unit::Feet),
    ("TerrainHeight", Unit::Metres),
];

/// How heights are to be read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heights {
    /// The one attribute that tells heights, instead of those of [`HEIGHTS`].
    pub attribute: Option<String>,
    /// What its numbers count; if nothing is said, what [`HEIGHTS`] says of it, or metres.
    pub unit: Option<Unit>,
    /// Metres for what has no usable height; otherwise it is left out.
    pub default: Option<f64>,
}

/// How tall a building or a part of it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// Metres from the ground to the top: above 0, at most [`TALLEST`].
    pub height: f64,
    /// Metres from the ground to where it begins: 0 unless it hangs in the air, below `height`.
    pub base: f64,
    /// Metres above the sea of its ground, if that is told.
    pub ground_elevation: Option<f64>,
}

impl Heights {
    /// What the attributes of a building say; `None` for one that is to be left out. `attribute`
    /// looks one up, whatever its capitals. What is unusable is noted.
    pub fn read<'a>(
        &self,
        attribute: impl Fn(&str) -> Option<Value<'a>>,
        place: &str,
        notes: &mut Notes,
    ) -> Option<Told> {
        let height = self.height(&attribute, place, notes)?;
        let base = first(BASES, &attribute, place, notes, |metres| {
            (metres < 0.0).then_some("is below the ground")
        });
        let base = base.unwrap_or(0.0);
        if base >= height {
            notes.add_kind(
                "base",
                place,
                format!("begins at {base} m, above its height of {height} m: left out"),
            );
            return None;
        }
        let ground_elevation = ground_elevation(attribute, place, notes);
        Some(Told {
            height,
            base,
            ground_elevation,
        })
    }

    fn height<'a>(
        &self,
        attribute: &impl Fn(&str) -> Option<Value<'a>>,
        place: &str,
        notes: &mut Notes,
    ) -> Option<f64> {
        let wrong = |metres: f64| {
            if metres < 0.0 {
                Some("is negative")
            } else if metres == 0.0 {
                Some("is zero")
            } else if metres > TALLEST {
                Some("is taller than anything built")
            } else {
                None
            }
        };
        let found = match &self.attribute {
            Some(name) => {
                let known = HEIGHTS.iter().find(|h| h.0.eq_ignore_ascii_case(name));
                let unit = self.unit.or(known.map(|h| h.1)).unwrap_or(Unit::Metres);
                first_named(&[(name, unit)], attribute, place, notes, wrong)
            }
            None => first_named(HEIGHTS, attribute, place, notes, wrong),
        };
        match (found, self.default) {
            (Some((name, metres)), _) if name.eq_ignore_ascii_case(WITHOUT_ROOF) => {
                let negative = |metres: f64| (metres < 0.0).then_some("is negative");
                let roof = first(ROOFS, attribute, place, notes, negative).unwrap_or(0.0);
                Some(if metres + roof <= TALLEST {
                    metres + roof
                } else {
                    metres
                })
            }
            (Some((_, metres)), _) => Some(metres),
            (None, Some(metres)) => {
                notes.add(place, format!("no usable height: {metres} m assumed"));
                Some(metres)
            }
            (None, None) => {
                notes.add(
                    place,
                    "no usable height: left out (--default-height gives one)",
                );
                None
            }
        }
    }
}

/// Metres above the sea of a building's ground, if an attribute tells them ([`GROUNDS`]).
pub fn ground_elevation<'a>(
    attribute: impl Fn(&str) -> Option<Value<'a>>,
    place: &str,
    notes: &mut Notes,
) -> Option<f64> {
    first(GROUNDS, &attribute, place, notes, |_| None)
}

/// The first of some attributes that has a usable value, in metres. `wrong` says what is wrong with
/// a length.
fn first<'a>(
    names: &[(&str, Unit)],
    attribute: &impl Fn(&str) -> Option<Value<'a>>,
    place: &str,
    notes: &mut Notes,
    wrong: impl Fn(f64) -> Option<&'static str>,
) -> Option<f64> {
    first_named(names, attribute, place, notes, wrong).map(|(_, metres)| metres)
}

/// The same with its name.
fn first_named<'a, 'n>(
    names: &[(&'n str, Unit)],
    attribute: &impl Fn(&str) -> Option<Value<'a>>,
    place: &str,
    notes: &mut Notes,
    wrong: impl Fn(f64) -> Option<&'static str>,
) -> Option<(&'n str, f64)> {
    for &(name, unit) in names {
        let metres = match attribute(name) {
            None | Some(Value::Null) => continue,
            Some(Value::Number(number)) => number * unit.metres(),
            Some(Value::Text(text)) => match metres_told(text, unit) {
                Ok(told) => {
                    if told.has_comma {
                        let read = told.number;
                        notes.add(
                            place,
                            format!("{name} {text:?} has a decimal comma: read as {read}"),
                        );
                    }
                    told.metres
                }
                Err(reason) => {
                    notes.add(place, format!("{name} {:?} {reason}", shortened(text)));
                    continue;
                }
            },
            Some(Value::Other(kind)) => {
                notes.add(place, format!("{name} is {kind}, and no number or text"));
                continue;
            }
        };
        let reason = if metres.is_finite() {
            wrong(metres)
        } else {
            Some("is not finite")
        };
        match reason {
            None => return Some((name, metres)),
            Some(reason) => {
                let kind = format!("{name} {reason}");
                notes.add_kind(&kind, place, format!("{kind} ({metres} m)"));
            }
        }
    }
    None
}

fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(heights: &Heights, attributes: &[(&str, Value<'_>)]) -> (Option<Told>, Vec<String>) {
        let mut notes = Notes::default();
        let find = |name: &str| {
            let found = attributes.iter().find(|a| a.0.eq_ignore_ascii_case(name));
            found.map(|a| a.1)
        };
        let told = heights.read(find, "feature 0", &mut notes);
        let notes = notes
            .into_findings()
            .iter()
            .map(ToString::to_string)
            .collect();
        (told, notes)
    }

    #[test]
    fn the_most_trusted_usable_attribute_counts() {
        use Value::{Number, Text};
        for (attributes, height) in [
            (
                &[("height", Number(12.0)), ("building:levels", Number(9.0))][..],
                12.0,
            ),
            (
                &[("height", Text("unknown")), ("building:levels", Text("4"))][..],
                12.0,
            ),
            (&[("HEIGHTROOF", Number(100.0))][..], 30.48),
            (
                &[
                    ("height_roof", Text("100")),
                    ("render_height_m", Number(31.0)),
                ][..],
                31.0,
            ),
            (&[("Floor", Number(2.0))][..], 6.0),
            (
                &[("measuredheight", Number(7.5)), ("height", Value::Null)][..],
                7.5,
            ),
        ] {
            let (told, _) = read(&Heights::default(), attributes);
            assert_eq!(told.map(|t| t.height), Some(height), "{attributes:?}");
        }
    }

    #[test]
    fn a_named_attribute_is_the_only_one() {
        let named = Heights {
            attribute: Some("hoogte".to_owned()),
            unit: Some(Unit::Feet),
            default: None,
        };
        let (told, _) = read(
            &named,
            &[
                ("hoogte", Value::Number(10.0)),
                ("height", Value::Number(9.0)),
            ],
        );
        assert_eq!(told.unwrap().height, 3.048);
        let (told, notes) = read(&named, &[("height", Value::Number(9.0))]);
        assert_eq!(told, None);
        assert_eq!(
            notes,
            ["feature 0: no usable height: left out (--default-height gives one)"]
        );
        let named = Heights {
            default: Some(9.0),
            ..named
        };
        let (told, notes) = read(&named, &[]);
        assert_eq!(told.unwrap().height, 9.0);
        assert_eq!(notes, ["feature 0: no usable height: 9 m assumed"]);
    }

    #[test]
    fn what_cannot_be_is_noted() {
        for (value, told) in [
            (
                Value::Number(-30.0),
                "feature 0: height is negative (-30 m)",
            ),
            (Value::Number(0.0), "feature 0: height is zero (0 m)"),
            (
                Value::Number(1e9),
                "feature 0: height is taller than anything built (1000000000 m)",
            ),
            (
                Value::Number(f64::NAN),
                "feature 0: height is not finite (NaN m)",
            ),
            (
                Value::Other("a list"),
                "feature 0: height is a list, and no number or text",
            ),
            (Value::Text(""), "feature 0: height \"\" is empty"),
        ] {
            let (found, notes) = read(&Heights::default(), &[("height", value)]);
            assert_eq!(found, None);
            assert_eq!(
                notes,
                [
                    told,
                    "feature 0: no usable height: left out (--default-height gives one)"
                ]
            );
        }
    }

    #[test]
    fn levels_of_a_roof_stand_on_the_others_and_metres_are_of_the_whole() {
        use Value::Text;
        for (attributes, height) in [
            (
                &[("building:levels", Text("4")), ("roof:levels", Text("1"))][..],
                15.0,
            ),
            (
                &[
                    ("building:levels", Text("4")),
                    ("roof:height", Text("2.5 m")),
                    ("roof:levels", Text("1")),
                ][..],
                14.5,
            ),
            (
                &[("height", Text("12")), ("roof:height", Text("2.5"))][..],
                12.0,
            ),
            (
                &[
                    ("building:levels", Text("4")),
                    ("roof:height", Text("9999")),
                ][..],
                12.0,
            ),
        ] {
            let (told, notes) = read(&Heights::default(), attributes);
            assert_eq!(told.map(|t| t.height), Some(height), "{attributes:?}");
            assert!(notes.is_empty());
        }
    }

    #[test]
    fn parts_that_hang_in_the_air_begin_there() {
        use Value::Number;
        let (told, notes) = read(
            &Heights::default(),
            &[
                ("height", Number(20.0)),
                ("building:min_level", Number(2.0)),
            ],
        );
        assert_eq!(told.unwrap().base, 6.0);
        assert!(notes.is_empty());
        let (told, notes) = read(
            &Heights::default(),
            &[("height", Number(20.0)), ("min_height", Number(30.0))],
        );
        assert_eq!(told, None);
        assert_eq!(
            notes,
            ["feature 0: begins at 30 m, above its height of 20 m: left out"]
        );
        let (told, _) = read(
            &Heights::default(),
            &[
                ("height", Number(20.0)),
                ("ground_elevation", Value::Text("10")),
            ],
        );
        let told = told.unwrap();
        assert_eq!((told.base, told.ground_elevation), (0.0, Some(3.048)));
    }
}
