//! Lengths in words.

use super::{FOOT, Unit};

/// A length that a text tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TextLength {
    /// In metres.
    pub(super) metres: f64,
    /// As it is written.
    pub(super) number: f64,
    /// Whether a comma was read as that of decimals.
    pub(super) has_comma: bool,
}

/// Reads a number with or without a unit; without, it counts `unit`. An error says why not, so that
/// it reads on after the text.
pub(super) fn metres_told(text: &str, unit: Unit) -> Result<TextLength, &'static str> {
    let text = text.trim();
    if text.is_empty() {
        return Err("is empty");
    }
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+')))
        .unwrap_or(text.len());
    let (number, has_comma) = number(&text[..end])?;
    let told = |metres| TextLength {
        metres,
        number,
        has_comma,
    };
    let rest = text[end..].trim();
    // Feet and inches: 40'6".
    if let Some(inches) = rest.strip_prefix(['\'', '′']) {
        let inches = inches.trim();
        let inches = inches.strip_suffix(['"', '″']).unwrap_or(inches);
        let inches: f64 = match inches.trim() {
            "" => 0.0,
            word => word.parse().map_err(|_| "is not a height")?,
        };
        if !(0.0..12.0).contains(&inches) {
            return Err("is not a height");
        }
        return Ok(told((number + inches / 12.0) * FOOT));
    }
    let metres = match rest.trim_end_matches('.').to_ascii_lowercase().as_str() {
        "" => unit.metres(),
        "m" | "metre" | "metres" | "meter" | "meters" | "mtr" => 1.0,
        "ft" | "foot" | "feet" => FOOT,
        "cm" => 0.01,
        _ => return Err("is not a height"),
    };
    Ok(told(number * metres))
}

fn number(text: &str) -> Result<(f64, bool), &'static str> {
    let parse = |text: &str| text.parse::<f64>().map_err(|_| "is not a height");
    let Some((whole, decimals)) = text.split_once(',') else {
        return Ok((parse(text)?, false));
    };
    if decimals.len() == 3 {
        return Err("may have a comma of decimals or of thousands");
    }
    if decimals.is_empty() || !decimals.bytes().all(|b| b.is_ascii_digit()) || whole.contains('.') {
        return Err("is not a height");
    }
    Ok((parse(&format!("{whole}.{decimals}"))?, true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_tell_metres() {
        for (text, metres) in [
            ("12", 12.0),
            (" 12.5 ", 12.5),
            ("12 m", 12.0),
            ("12m", 12.0),
            ("12,5", 12.5),
            ("12,50 m", 12.5),
            ("40'", 40.0 * FOOT),
            ("40 ft", 40.0 * FOOT),
            ("40 ft.", 40.0 * FOOT),
            ("40 Feet", 40.0 * FOOT),
            ("40'6\"", 40.5 * FOOT),
            ("-3", -3.0),
            ("250 cm", 2.5),
        ] {
            let told = metres_told(text, Unit::Metres).unwrap();
            assert!((told.metres - metres).abs() < 1e-12, "{text}: {told:?}");
            assert_eq!(told.has_comma, text.contains(','));
        }
        assert_eq!(metres_told("4", Unit::Levels).unwrap().metres, 12.0);
        assert_eq!(metres_told("10", Unit::Feet).unwrap().metres, 3.048);
        assert_eq!(metres_told("10 m", Unit::Feet).unwrap().metres, 10.0);
    }

    #[test]
    fn what_is_no_length_is_refused() {
        for text in [
            "", "  ", "tall", "~30", "12 yards", "1,234", "1,2,3", "1.2,5", "12,", "4;5", "3-4",
            "inf", "NaN", "1e3", "40'13\"", "m", "'", "--3", "１２",
        ] {
            assert!(metres_told(text, Unit::Metres).is_err(), "{text}");
        }
    }
}
