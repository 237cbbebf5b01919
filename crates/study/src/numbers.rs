//! Numbers for people.

/// With three digits that count, and no more zeros than needed.
pub(crate) fn short(number: f64) -> String {
    let size = number.abs();
    match () {
        () if !number.is_finite() => "–".to_owned(),
        () if size >= 9999.5 => grouped(number.round() as u64),
        () if size >= 99.95 => format!("{number:.0}"),
        () if size >= 9.995 => format!("{number:.1}"),
        () if size >= 0.1 || size == 0.0 => format!("{number:.2}"),
        () if size >= 0.01 => format!("{number:.3}"),
        () if size >= 1e-7 => {
            // Two digits that count, written out.
            let places = (-size.log10()).ceil() as usize + 1;
            format!("{number:.places$}")
        }
        () => format!("{number:.1e}"),
    }
}

/// A whole number with a gap between its thousands.
#[must_use]
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

pub(crate) fn seconds(seconds: f64) -> String {
    match () {
        () if seconds >= 1.0 => format!("{} s", short(seconds)),
        () if seconds >= 1e-3 => format!("{} ms", short(seconds * 1e3)),
        () => format!("{} µs", short(seconds * 1e6)),
    }
}

pub(crate) fn bytes(bytes: f64) -> String {
    match () {
        () if bytes >= 1e9 => format!("{} GB", short(bytes / 1e9)),
        () if bytes >= 1e6 => format!("{} MB", short(bytes / 1e6)),
        () if bytes >= 1e3 => format!("{} kB", short(bytes / 1e3)),
        () => format!("{bytes:.0} B"),
    }
}

pub(crate) fn rate(per_second: f64) -> String {
    match () {
        () if per_second >= 1e5 => format!("{} Mrays/s", short(per_second / 1e6)),
        () => format!("{} krays/s", short(per_second / 1e3)),
    }
}

/// A ratio as people say it: "12 % more", "3.1 times".
pub(crate) fn percent(ratio: f64) -> String {
    let percent = (ratio - 1.0) * 100.0;
    // "−0 %" says less than "0 %".
    if percent.abs() < 0.5 {
        return "0 %".to_owned();
    }
    let sign = if percent > 0.0 { "+" } else { "−" };
    format!("{sign}{} %", percent.abs().round())
}

/// "a", "a and b", "a, b and c".
pub(crate) fn list<S: AsRef<str>>(items: &[S]) -> String {
    match items {
        [] => "none".to_owned(),
        [one] => one.as_ref().to_owned(),
        [all @ .., last] => {
            let all: Vec<_> = all.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", all.join(", "), last.as_ref())
        }
    }
}

/// "1 thread", "2 threads".
pub(crate) fn counted(count: u64, word: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{} {word}{ending}", grouped(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_count() {
        for (number, text) in [
            (0.0, "0.00"),
            (1234567.0, "1 234 567"),
            (123.4, "123"),
            (99.96, "100"),
            (12.34, "12.3"),
            (1.234, "1.23"),
            (0.0123, "0.012"),
            (0.00024, "0.00024"),
            (0.001, "0.0010"),
            (3e-9, "3.0e-9"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1 234 567");
    }

    #[test]
    fn units_fit_the_size() {
        assert_eq!(seconds(0.0123), "12.3 ms");
        assert_eq!(bytes(1.5e6), "1.50 MB");
        assert_eq!(rate(2.5e6), "2.50 Mrays/s");
        assert_eq!(percent(1.13), "+13 %");
        assert_eq!(percent(0.999), "0 %");
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
    }
}
