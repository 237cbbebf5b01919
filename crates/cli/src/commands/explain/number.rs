//! Numbers in the tree: whole in JSON, short for people.

use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number as JSON knows none: finite ones are numbers, the others the texts `inf`, `-inf`, `nan`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number(pub(crate) f32);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            x if x.is_finite() => serializer.serialize_f32(x),
            x if x.is_nan() => serializer.serialize_str("nan"),
            x if x > 0.0 => serializer.serialize_str("inf"),
            _ => serializer.serialize_str("-inf"),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Finite(f32),
            Other(String),
        }
        match Written::deserialize(deserializer)? {
            Written::Finite(x) => Ok(Self(x)),
            Written::Other(text) => match text.as_str() {
                "nan" => Ok(Self(f32::NAN)),
                "inf" => Ok(Self(f32::INFINITY)),
                "-inf" => Ok(Self(f32::NEG_INFINITY)),
                other => Err(Error::invalid_value(
                    Unexpected::Str(other),
                    &"a number, \"inf\", \"-inf\" or \"nan\"",
                )),
            },
        }
    }
}

/// Several at once.
pub(crate) fn numbers<const N: usize>(of: [f32; N]) -> [Number; N] {
    of.map(Number)
}

/// A length, a coordinate or a share: three places after the point, powers of ten where these do not
/// do.
pub(crate) fn short(x: f32) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0.000".to_owned()
    } else if !x.is_finite() {
        if x.is_nan() {
            "NaN".to_owned()
        } else if x > 0.0 {
            "∞".to_owned()
        } else {
            "-∞".to_owned()
        }
    } else if (5e-4..1e5).contains(&size) {
        format!("{x:.3}")
    } else {
        format!("{x:.2e}")
    }
}

/// A place or a direction.
pub(crate) fn triple(numbers: &[Number; 3]) -> String {
    let [x, y, z] = numbers.map(|number| short(number.0));
    format!("({x}, {y}, {z})")
}

/// A colour, in columns.
pub(crate) fn colour(numbers: &[Number; 3]) -> String {
    let [r, g, b] = numbers.map(|number| {
        let x = number.0;
        if x == 0.0 || (5e-5..1e4).contains(&x.abs()) {
            format!("{x:.4}")
        } else if x.is_finite() {
            format!("{x:.0e}")
        } else {
            short(x)
        }
    });
    format!("{r:>6} {g:>6} {b:>6}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_survive_json_to_the_last_bit() {
        for x in [
            0.1_f32,
            -0.0,
            f32::MIN_POSITIVE,
            1e-45,
            f32::MAX,
            1.0 / 3.0,
            16_777_217.0,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NAN,
        ] {
            let text = serde_json::to_string(&Number(x)).unwrap();
            let read: Number = serde_json::from_str(&text).unwrap();
            assert_eq!(read.0.to_bits(), x.to_bits(), "{text}");
        }
        assert!(serde_json::from_str::<Number>("\"many\"").is_err());
    }

    #[test]
    fn short_numbers_are_short() {
        for (x, text) in [
            (0.0, "0.000"),
            (1.0, "1.000"),
            (-0.1234, "-0.123"),
            (1e-7, "1.00e-7"),
            (2e9, "2.00e9"),
            (f32::INFINITY, "∞"),
            (f32::NAN, "NaN"),
        ] {
            assert_eq!(short(x), text);
        }
    }
}
