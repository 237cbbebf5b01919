//! Numbers written in text.

use crate::error::{Fault, quoted};

/// The words of a line, between blanks.
pub(crate) struct Words<'a>(pub(crate) &'a [u8]);

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let from = self.0.iter().position(|&b| !is_blank(b))?;
        let rest = &self.0[from..];
        let length = rest.iter().position(|&b| is_blank(b));
        let (word, rest) = rest.split_at(length.unwrap_or(rest.len()));
        self.0 = rest;
        Some(word)
    }
}

#[inline]
fn is_blank(byte: u8) -> bool {
    // Control characters below the space separate words as well: tabs, and stray line ends.
    byte <= b' '
}

/// A finite single-precision number.
#[inline]
pub(crate) fn finite(word: &[u8], what: &'static str) -> Result<f32, Fault> {
    let number = str::from_utf8(word)
        .ok()
        .and_then(|s| s.parse::<f32>().ok());
    match number {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(Fault::NotFinite {
            what,
            found: quoted(word),
        }),
        None => Err(Fault::NotANumber {
            what,
            found: quoted(word),
        }),
    }
}

/// A whole number of up to 18 digits, with or without a sign.
#[inline]
pub(crate) fn whole(word: &[u8], what: &'static str) -> Result<i64, Fault> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    let plain = !digits.is_empty() && digits.len() <= 18 && digits.iter().all(u8::is_ascii_digit);
    if !plain {
        let found = quoted(word);
        return Err(Fault::NotANumber { what, found });
    }
    let size = digits.iter().fold(0, |n, d| n * 10 + i64::from(d - b'0'));
    Ok(if negative { -size } else { size })
}

/// `N` finite numbers from the front of `words`.
pub(crate) fn finite_row<'a, const N: usize>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    what: &'static str,
) -> Result<[f32; N], Fault> {
    let mut row = [0.0; N];
    for (found, slot) in row.iter_mut().enumerate() {
        let word = words.next().ok_or(Fault::TooFewNumbers {
            what,
            found: found as u64,
            needed: N as u64,
        })?;
        *slot = finite(word, what)?;
    }
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_lie_between_blanks() {
        let words: Vec<_> = Words(b"  v\t1.5  -2 \r").collect();
        assert_eq!(words, [&b"v"[..], b"1.5", b"-2"]);
        assert_eq!(Words(b"   ").next(), None);
    }

    #[test]
    fn only_finite_numbers_are_numbers() {
        assert_eq!(finite(b"-1.5e2", "x").unwrap(), -150.0);
        for bad in ["nan", "inf", "1e39", "-infinity"] {
            assert!(matches!(
                finite(bad.as_bytes(), "x"),
                Err(Fault::NotFinite { .. })
            ));
        }
        for bad in ["", "1,5", "0x10", "1.0f", "--1"] {
            assert!(matches!(
                finite(bad.as_bytes(), "x"),
                Err(Fault::NotANumber { .. })
            ));
        }
    }

    #[test]
    fn whole_numbers_do_not_overflow() {
        assert_eq!(whole(b"-50", "x").unwrap(), -50);
        assert_eq!(
            whole(b"999999999999999999", "x").unwrap(),
            999_999_999_999_999_999
        );
        for bad in ["9999999999999999999", "", "-", "1.0", "1e3"] {
            assert!(whole(bad.as_bytes(), "x").is_err(), "{bad}");
        }
    }
}
