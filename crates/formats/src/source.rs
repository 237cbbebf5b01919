//! Bytes of a file, unpacked on the way, by lines or by pieces, through one bounded buffer.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::error::{Fault, FormatError, Place};
use crate::limits::Limits;

const BUFFER: usize = 256 << 10;
/// No deflate stream unpacks to more than this many times its size (RFC 1951: a match of 258 bytes
/// takes at least two bits).
const DEFLATE_RATIO: u64 = 1032;

/// A file that is read from front to back.
pub(crate) struct Source<'a> {
    reader: Box<dyn Read + 'a>,
    buffer: Vec<u8>,
    start: usize,
    end: usize,
    at_end: bool,
    consumed: u64,
    line: u64,
    line_end: Option<u8>,
    joined: Vec<u8>,
    size: Size,
    limits: Limits,
}

/// How many bytes a file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Size {
    /// So many.
    Exactly(u64),
    /// No more than so many; how many is known once it is unpacked.
    AtMost(u64),
}

/// A line without its end.
#[derive(Clone, Copy)]
pub(crate) struct Line<'s> {
    /// From 1.
    pub(crate) number: u64,
    pub(crate) bytes: &'s [u8],
}

impl Source<'static> {
    /// Opens a file, unpacking it if it is a gzip file (which its first bytes tell).
    pub(crate) fn open(path: &Path, limits: &Limits) -> Result<Self, FormatError> {
        let cannot = |action| move |source| FormatError::file(Fault::Io { action, source });
        let file = File::open(path).map_err(cannot("be opened"))?;
        let metadata = file.metadata().map_err(cannot("be read"))?;
        if metadata.is_dir() {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(cannot("be read")(source));
        }
        Source::new(file, metadata.len(), limits)
    }
}

impl<'a> Source<'a> {
    #[cfg(test)]
    pub(crate) fn from_bytes(bytes: &'a [u8]) -> Self {
        Source::new(bytes, bytes.len() as u64, &Limits::default()).expect("memory can be read")
    }

    pub(crate) fn new(
        mut reader: impl Read + 'a,
        size: u64,
        limits: &Limits,
    ) -> Result<Self, FormatError> {
        let mut magic = Vec::with_capacity(2);
        reader
            .by_ref()
            .take(2)
            .read_to_end(&mut magic)
            .map_err(|e| read_error(e, 0))?;
        let packed = magic == [0x1f, 0x8b];
        let whole = io::Cursor::new(magic).chain(reader);
        let (reader, size): (Box<dyn Read + 'a>, _) = if packed {
            let most = size.saturating_mul(DEFLATE_RATIO);
            (
                Box::new(MultiGzDecoder::new(io::BufReader::new(whole))),
                Size::AtMost(most.min(limits.decompressed_bytes)),
            )
        } else {
            (Box::new(whole), Size::Exactly(size))
        };
        Ok(Self {
            reader,
            buffer: vec![0; BUFFER],
            start: 0,
            end: 0,
            at_end: false,
            consumed: 0,
            line: 0,
            line_end: None,
            joined: Vec::new(),
            size,
            limits: limits.clone(),
        })
    }

    /// The place of the next byte.
    pub(crate) fn place(&self) -> Place {
        Place::Byte(self.consumed)
    }

    /// How many lines have been handed out.
    pub(crate) fn lines_read(&self) -> u64 {
        self.line
    }

    /// How many bytes the file has in all.
    pub(crate) fn size(&self) -> Size {
        self.size
    }

    /// How many bytes can follow, at most.
    pub(crate) fn most_left(&self) -> u64 {
        let (Size::Exactly(size) | Size::AtMost(size)) = self.size;
        size.saturating_sub(self.consumed)
    }

    /// A capacity to reserve for `count` rows of at least `row` bytes each: what the rest of the
    /// file can hold, and no more than a start that growth takes over from.
    pub(crate) fn rows_to_reserve(&self, count: u64, row: u64) -> usize {
        const START: u64 = 1 << 20;
        count.min(self.most_left() / row.max(1)).min(START) as usize
    }

    /// The next bytes, up to `count`, without taking them; fewer at the end of the file.
    pub(crate) fn peek(&mut self, count: usize) -> Result<&[u8], FormatError> {
        self.fill(count)?;
        Ok(&self.buffer[self.start..self.end.min(self.start + count)])
    }

    /// The next `count` bytes; `None` if the file has not so many left.
    pub(crate) fn take(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError> {
        self.fill(count)?;
        if self.end - self.start < count {
            return Ok(None);
        }
        let from = self.start;
        self.start += count;
        self.consumed += count as u64;
        Ok(Some(&self.buffer[from..self.start]))
    }

    /// All bytes that follow.
    pub(crate) fn rest(&mut self) -> Result<Vec<u8>, FormatError> {
        let mut rest = Vec::new();
        loop {
            let piece = self.peek(BUFFER)?;
            let length = piece.len();
            if length == 0 {
                return Ok(rest);
            }
            rest.extend_from_slice(piece);
            self.take(length)?;
        }
    }

    /// Passes over `count` bytes; false if the file has not so many left.
    pub(crate) fn skip(&mut self, mut count: u64) -> Result<bool, FormatError> {
        while count > 0 {
            let piece = count.min(BUFFER as u64);
            if self.take(piece as usize)?.is_none() {
                return Ok(false);
            }
            count -= piece;
        }
        Ok(true)
    }

    /// The next line; `None` at the end of the file.
    ///
    /// Lines end with LF or CR LF; in a file whose first line ends with a lone CR, with CR.
    pub(crate) fn line(&mut self) -> Result<Option<Line<'_>>, FormatError> {
        let range = self.line_range()?;
        let number = self.line;
        Ok(range.map(|r| Line {
            number,
            bytes: &self.buffer[r],
        }))
    }

    /// The next line together with those that a `\` at its end joins to it, under the first one's
    /// number. Comments (from `#`) are not continued: paths in them end with `\` now and then.
    pub(crate) fn joined_line(&mut self) -> Result<Option<Line<'_>>, FormatError> {
        let Some(range) = self.line_range()? else {
            return Ok(None);
        };
        let number = self.line;
        let bytes = &self.buffer[range.clone()];
        if !continues(bytes) {
            let bytes = &self.buffer[range];
            return Ok(Some(Line { number, bytes }));
        }
        let mut joined = std::mem::take(&mut self.joined);
        joined.clear();
        joined.extend_from_slice(&bytes[..bytes.len() - 1]);
        while let Some(range) = self.line_range()? {
            let bytes = &self.buffer[range];
            let more = bytes.ends_with(b"\\");
            joined.push(b' ');
            joined.extend_from_slice(&bytes[..bytes.len() - usize::from(more)]);
            if joined.len() > self.limits.line_bytes {
                return Err(self.line_too_long());
            }
            if !more {
                break;
            }
        }
        self.joined = joined;
        Ok(Some(Line {
            number,
            bytes: &self.joined,
        }))
    }

    fn line_range(&mut self) -> Result<Option<Range<usize>>, FormatError> {
        let mut searched = 0;
        loop {
            if let Some(end) = self.line_end() {
                let unread = &self.buffer[self.start + searched..self.end];
                if let Some(at) = unread.iter().position(|&b| b == end) {
                    let length = searched + at;
                    return Ok(Some(self.take_line(length, length + 1)));
                }
                searched += unread.len();
            }
            let held = self.end - self.start;
            if held > self.limits.line_bytes {
                self.line += 1;
                return Err(self.line_too_long());
            }
            if self.at_end {
                return Ok((held > 0).then(|| self.take_line(held, held)));
            }
            // Growing by half and more keeps the search linear in the line's length.
            self.fill(held + held / 2 + 1)?;
        }
    }

    /// Which byte ends the lines: decided once, by the first end that is seen. `None` while there
    /// is none, or only a CR that an LF may follow.
    fn line_end(&mut self) -> Option<u8> {
        if self.line_end.is_none() {
            let unread = &self.buffer[self.start..self.end];
            let at = unread.iter().position(|b| b"\r\n".contains(b))?;
            self.line_end = match (unread[at], unread.get(at + 1)) {
                (b'\r', None) if !self.at_end => None,
                (b'\r', next) if next != Some(&b'\n') => Some(b'\r'),
                _ => Some(b'\n'),
            };
        }
        self.line_end
    }

    fn take_line(&mut self, length: usize, with_end: usize) -> Range<usize> {
        let from = self.start;
        self.start += with_end;
        self.consumed += with_end as u64;
        self.line += 1;
        let cr = self.buffer[from..from + length].ends_with(b"\r");
        from..from + length - usize::from(cr)
    }

    fn line_too_long(&self) -> FormatError {
        let limit = self.limits.line_bytes as u64;
        FormatError::line(
            self.line,
            Fault::TooLarge {
                what: "line",
                limit,
            },
        )
    }

    /// Reads on until `want` bytes lie in the buffer or the file ends.
    fn fill(&mut self, want: usize) -> Result<(), FormatError> {
        if self.end - self.start >= want || self.at_end {
            return Ok(());
        }
        self.buffer.copy_within(self.start..self.end, 0);
        self.end -= self.start;
        self.start = 0;
        if self.buffer.len() < want {
            self.buffer.resize(want.next_power_of_two(), 0);
        }
        while self.end < want {
            let held = self.consumed + self.end as u64;
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(0) => {
                    self.at_end = true;
                    break;
                }
                Ok(read) => self.end += read,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(read_error(e, held)),
            }
            let limit = self.limits.decompressed_bytes;
            if matches!(self.size, Size::AtMost(_)) && self.consumed + self.end as u64 > limit {
                let what = "unpacked content";
                return Err(FormatError::file(Fault::TooLarge { what, limit }));
            }
        }
        Ok(())
    }
}

fn continues(line: &[u8]) -> bool {
    line.ends_with(b"\\") && !line.trim_ascii_start().starts_with(b"#")
}

fn read_error(source: io::Error, at: u64) -> FormatError {
    let action = "be read to its end";
    FormatError::new(Place::Byte(at), Fault::Io { action, source })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(bytes: &[u8]) -> Vec<(u64, Vec<u8>)> {
        let mut source = Source::from_bytes(bytes);
        let mut lines = Vec::new();
        while let Some(line) = source.joined_line().unwrap() {
            lines.push((line.number, line.bytes.to_vec()));
        }
        lines
    }

    #[test]
    fn every_kind_of_line_end_is_understood() {
        let expected = vec![(1, b"a".to_vec()), (2, b"".to_vec()), (3, b"b".to_vec())];
        for text in [&b"a\n\nb"[..], b"a\r\n\r\nb\r\n", b"a\r\rb\r"] {
            assert_eq!(lines(text), expected);
        }
        assert_eq!(lines(b""), vec![]);
    }

    #[test]
    fn a_backslash_joins_lines_but_not_comments() {
        let expected = vec![(1, b"f 1  2  3".to_vec()), (4, b"v".to_vec())];
        assert_eq!(lines(b"f 1 \\\n2 \\\n3\nv"), expected);
        assert_eq!(lines(b"# c:\\\nv").len(), 2);
        assert_eq!(lines(b"v \\"), vec![(1, b"v ".to_vec())]);
    }

    #[test]
    fn a_line_longer_than_the_buffer_is_whole() {
        let mut text = vec![b'x'; 3 * BUFFER + 17];
        text.extend_from_slice(b"\nend");
        let found = lines(&text);
        assert_eq!(found[0].1.len(), 3 * BUFFER + 17);
        assert_eq!(found[1], (2, b"end".to_vec()));
    }

    #[test]
    fn unpacked_content_is_limited() {
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        io::Write::write_all(&mut packed, &[b'\n'; 1 << 20]).unwrap();
        let packed = packed.finish().unwrap();
        let limits = Limits {
            decompressed_bytes: 1 << 19,
            ..Limits::default()
        };
        let mut source = Source::new(&packed[..], packed.len() as u64, &limits).unwrap();
        let error = loop {
            match source.line() {
                Ok(line) => assert!(line.is_some(), "the limit must be met before the end"),
                Err(error) => break error,
            }
        };
        assert_eq!(
            error.to_string(),
            "unpacked content exceeds the limit of 524288 bytes"
        );
    }
}
