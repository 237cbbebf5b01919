//! The words of a C header, as far as scenes of the contest need them: names, numbers and the signs
//! between them, without comments.

use crate::error::{Fault, FormatError, quoted};

/// A word and its line, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Word<'a> {
    pub(super) text: &'a [u8],
    pub(super) line: u64,
}

impl Word<'_> {
    /// The error that something else is needed here.
    pub(super) fn instead_of(&self, expected: &'static str) -> FormatError {
        let found = quoted(self.text);
        FormatError::line(self.line, Fault::Unexpected { found, expected })
    }
}

/// Takes a text apart.
#[derive(Clone, Debug)]
pub(super) struct Words<'a> {
    rest: &'a [u8],
    line: u64,
}

impl<'a> Words<'a> {
    pub(super) const fn new(text: &'a [u8]) -> Self {
        Self {
            rest: text,
            line: 1,
        }
    }

    /// The line of what comes next, or that of the end.
    pub(super) const fn line(&self) -> u64 {
        self.line
    }

    /// The next word; `None` at the end.
    ///
    /// # Errors
    /// When a comment has no end.
    pub(super) fn next(&mut self) -> Result<Option<Word<'a>>, FormatError> {
        self.skip()?;
        let Some(&first) = self.rest.first() else {
            return Ok(None);
        };
        let length = if is_inner(first) {
            let end = self.rest.iter().position(|&b| !is_inner(b));
            end.unwrap_or(self.rest.len())
        } else {
            1
        };
        let (text, rest) = self.rest.split_at(length);
        self.rest = rest;
        let line = self.line;
        Ok(Some(Word { text, line }))
    }

    /// The next word, which must be there.
    pub(super) fn needed(&mut self, expected: &'static str) -> Result<Word<'a>, FormatError> {
        self.next()?.ok_or_else(|| {
            let found = "the end of the file".to_owned();
            FormatError::line(self.line, Fault::Unexpected { found, expected })
        })
    }

    /// Passes over blanks and comments.
    fn skip(&mut self) -> Result<(), FormatError> {
        loop {
            match self.rest {
                [b'\n', ..] => {
                    self.line += 1;
                    self.pass(1);
                }
                [b'\\', b'\n', ..] => {
                    self.line += 1;
                    self.pass(2);
                }
                [b, ..] if *b <= b' ' => self.pass(1),
                [b'/', b'/', ..] => {
                    let end = self.rest.iter().position(|&b| b == b'\n');
                    self.pass(end.unwrap_or(self.rest.len()));
                }
                [b'/', b'*', ..] => {
                    let inside = &self.rest[2..];
                    let end = inside.windows(2).position(|w| w == b"*/").ok_or_else(|| {
                        let found = "a comment without an end".to_owned();
                        let expected = "\"*/\"";
                        FormatError::line(self.line, Fault::Unexpected { found, expected })
                    })?;
                    let lines = inside[..end].iter().filter(|&&b| b == b'\n').count();
                    self.line += lines as u64;
                    self.pass(end + 4);
                }
                _ => return Ok(()),
            }
        }
    }

    fn pass(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes..];
    }
}

/// Whether a byte is a part of a name or of a number.
const fn is_inner(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.' | b'+' | b'-' | 0x80..)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_no_words_and_lines_are_counted() {
        let text = b"a /* b\n c */ -.5,// d\n\n}";
        let mut words = Words::new(text);
        let mut found = Vec::new();
        while let Some(Word { text, line }) = words.next().unwrap() {
            found.push((str::from_utf8(text).unwrap(), line));
        }
        assert_eq!(found, [("a", 1), ("-.5", 2), (",", 2), ("}", 4)]);
    }

    #[test]
    fn a_comment_needs_an_end() {
        let mut words = Words::new(b"\n/* and so on");
        let error = words.next().unwrap_err().to_string();
        assert!(error.contains("comment without an end"), "{error}");
    }
}
