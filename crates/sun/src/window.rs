//! A window of a day, by the clock or by a sundial.

use std::str::FromStr;

use jiff::SignedDuration;

use crate::SunError;
use crate::position::DAY;

/// From one time of day to a later one, in seconds after midnight, 0 to 86 400.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    from: f64,
    to: f64,
}

impl Window {
    /// From seconds after midnight.
    ///
    /// # Errors
    /// Not in order, or not within a day.
    pub fn new(from: f64, to: f64) -> Result<Self, SunError> {
        if 0.0 <= from && from < to && to <= DAY {
            Ok(Self { from, to })
        } else {
            Err(SunError::WindowOrder(format!("{from} s - {to} s")))
        }
    }

    /// Several of them, with commas between: `09:00-12:00,13:00-15:30`. They may overlap.
    ///
    /// # Errors
    /// One that cannot be read, or none.
    pub fn list(text: &str) -> Result<Vec<Self>, SunError> {
        text.split(',').map(str::parse).collect()
    }

    /// Its first second after midnight.
    #[must_use]
    pub const fn from(&self) -> f64 {
        self.from
    }

    /// Its last.
    #[must_use]
    pub const fn to(&self) -> f64 {
        self.to
    }
}

/// `09:00-15:30`, `8-16` or `08:00:30-24:00`.
impl FromStr for Window {
    type Err = SunError;

    fn from_str(text: &str) -> Result<Self, SunError> {
        let text = text.trim();
        let read = || {
            let (from, to) = text.split_once(['-', '–'])?;
            Some((time_of_day(from)?, time_of_day(to)?))
        };
        let (from, to) = read().ok_or_else(|| SunError::Window(text.to_owned()))?;
        Self::new(from, to).map_err(|_| SunError::WindowOrder(text.to_owned()))
    }
}

/// `9`, `09:00` or `09:00:30`, up to `24:00`, in seconds.
fn time_of_day(text: &str) -> Option<f64> {
    let mut seconds = 0;
    let mut unit = 3600;
    for (place, digits) in text.trim().split(':').enumerate() {
        let least = if place == 0 { 1 } else { 2 };
        let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
        if place > 2 || !plain || !(least..=2).contains(&digits.len()) {
            return None;
        }
        let number: i32 = digits.parse().ok()?;
        if place > 0 && number > 59 {
            return None;
        }
        seconds += number * unit;
        unit /= 60;
    }
    (seconds <= 86_400).then_some(f64::from(seconds))
}

/// A length of time such as `90min`, `1h30min`, `1.5h` or `45s`, in seconds: 0 to 24 hours.
///
/// # Errors
/// Text of another kind, a negative or a longer time.
pub fn parse_duration(text: &str) -> Result<f64, SunError> {
    let refuse = || SunError::Duration(text.to_owned());
    let duration: SignedDuration = text.trim().parse().map_err(|_| refuse())?;
    let seconds = duration.as_secs_f64();
    if (0.0..=DAY).contains(&seconds) {
        Ok(seconds)
    } else {
        Err(refuse())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_from_text() {
        let window: Window = "09:00-15:30".parse().unwrap();
        assert_eq!((window.from(), window.to()), (32_400.0, 55_800.0));
        let list = Window::list("8-16, 22:00:30-24:00").unwrap();
        assert_eq!(list[0], Window::new(28_800.0, 57_600.0).unwrap());
        assert_eq!(list[1], Window::new(79_230.0, 86_400.0).unwrap());
    }

    #[test]
    fn bad_windows_are_named() {
        for text in [
            "",
            "9",
            "9-",
            "-9",
            "25:00-26:00",
            "9:0-10",
            "09:60-10",
            "a-b",
            "8-9-10",
            "9+1-10",
            "08:00:00:00-9",
            "00009-10",
            "24:00:01-24:00:02",
        ] {
            let error = text.parse::<Window>().unwrap_err();
            assert_eq!(error, SunError::Window(text.to_owned()), "{text}");
        }
        for text in ["09:00-09:00", "22:00-02:00"] {
            let error = text.parse::<Window>().unwrap_err();
            assert_eq!(error, SunError::WindowOrder(text.to_owned()));
        }
        assert!(Window::new(f64::NAN, 5.0).is_err());
        assert!(Window::new(0.0, 86_401.0).is_err());
        assert!(Window::list("9-10,").is_err());
    }

    #[test]
    fn durations_from_text() {
        for (text, seconds) in [
            ("90min", 5400.0),
            ("1h30min", 5400.0),
            ("1.5h", 5400.0),
            ("0s", 0.0),
            ("PT1H", 3600.0),
        ] {
            assert_eq!(parse_duration(text).unwrap(), seconds, "{text}");
        }
        for text in ["", "90", "-5min", "25h", "soon"] {
            assert!(parse_duration(text).is_err(), "{text}");
        }
    }
}
