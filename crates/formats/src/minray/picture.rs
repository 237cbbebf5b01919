//! A picture of the contest: "xsize ysize", then "r g b" for each pixel, row by row from the top. A
//! component is 255 times the light, and may be more than 255. There is no magic number.

use std::fmt;
use std::path::Path;

use ombra_scene::Rgb;

use crate::error::{Fault, FormatError};
use crate::input::Input;
use crate::limits::{Limits, take_pixels};
use crate::number::{Words, finite, whole};
use crate::source::Source;

/// A picture of the contest. Shown, it is the text of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct ContestPicture {
    width: u32,
    height: u32,
    /// 255 is white.
    pixels: Vec<[f32; 3]>,
}

impl ContestPicture {
    /// From linear light, of which 1 is white, row by row from the top; as the contest's programs do,
    /// components are rounded to whole numbers.
    ///
    /// # Panics
    /// When there are not as many pixels as the size says.
    #[must_use]
    pub fn from_light(width: u32, height: u32, light: &[Rgb]) -> Self {
        assert_eq!(light.len() as u64, u64::from(width) * u64::from(height));
        let whole = |x: f32| (x * 255.0).round();
        Self {
            width,
            height,
            pixels: light.iter().map(|p| p.to_array().map(whole)).collect(),
        }
    }

    /// Pixels in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row from the top; 255 is white.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }
}

impl fmt::Display for ContestPicture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} {}", self.width, self.height)?;
        for [r, g, b] in &self.pixels {
            writeln!(f, "{r} {g} {b}")?;
        }
        Ok(())
    }
}

/// Reads a picture of the contest.
///
/// # Errors
/// When the file cannot be read, or does not hold as many numbers as it says.
pub fn read_contest_picture(
    path: impl AsRef<Path>,
    limits: &Limits,
) -> Result<ContestPicture, FormatError> {
    read_input(&Input::on_disk(path.as_ref()), limits)
}

/// Reads a picture of the contest that is in memory; `name` is for messages.
///
/// # Errors
/// As those of [`read_contest_picture`].
pub fn read_contest_picture_bytes(
    name: impl AsRef<Path>,
    bytes: &[u8],
    limits: &Limits,
) -> Result<ContestPicture, FormatError> {
    read_input(&Input::in_memory(name.as_ref(), bytes), limits)
}

fn read_input(input: &Input<'_>, limits: &Limits) -> Result<ContestPicture, FormatError> {
    (input.source(limits))
        .and_then(|source| read(source, limits))
        .map_err(|error| error.in_file(input.name()))
}

fn read(mut source: Source<'_>, limits: &Limits) -> Result<ContestPicture, FormatError> {
    let mut size = Vec::new();
    let mut numbers: Vec<f32> = Vec::new();
    let mut needed = None;
    let mut last = 1;
    while let Some(line) = source.line()? {
        last = line.number;
        for word in Words(line.bytes) {
            let fail = |fault| FormatError::line(last, fault);
            match needed {
                None => {
                    if size.is_empty() && word.first().is_some_and(|b| !b.is_ascii_digit()) {
                        let found = crate::error::quoted(word);
                        let expected = "the contest's format, \"xsize ysize\" and then \"r g b\" for each pixel,";
                        return Err(fail(Fault::Unexpected { found, expected }));
                    }
                    let side = whole(word, "a side of the picture").map_err(fail)?;
                    let side = u32::try_from(side)
                        .ok()
                        .filter(|n| (1..=65_536).contains(n));
                    size.push(side.ok_or_else(|| {
                        let found = crate::error::quoted(word);
                        let expected = "a side of the picture, 1 to 65536 pixels,";
                        fail(Fault::Unexpected { found, expected })
                    })?);
                    if let [width, height] = size[..] {
                        take_pixels(&mut limits.clone(), width, height)?;
                        needed = Some(3 * width as usize * height as usize);
                    }
                }
                Some(needed) if numbers.len() == needed => {
                    let found = crate::error::quoted(word);
                    let expected = "the end of the picture";
                    return Err(fail(Fault::Unexpected { found, expected }));
                }
                Some(_) => numbers.push(finite(word, "a component").map_err(fail)?),
            }
        }
    }
    let [width, height] = size[..] else {
        let found = "the end of the file".to_owned();
        let expected = "the size of the picture, such as \"32 32\",";
        return Err(FormatError::line(
            last,
            Fault::Unexpected { found, expected },
        ));
    };
    let pixels: Vec<_> = numbers
        .chunks_exact(3)
        .map(|c| [c[0], c[1], c[2]])
        .collect();
    let rows = u64::from(width) * u64::from(height);
    if pixels.len() as u64 != rows {
        let found = match pixels.len() {
            0 => "the end of the file after its size, without a pixel".to_owned(),
            there => format!("the end of the file after {there} of {rows} pixels"),
        };
        let expected = "\"r g b\" for each pixel";
        return Err(FormatError::line(
            last,
            Fault::Unexpected { found, expected },
        ));
    }
    Ok(ContestPicture {
        width,
        height,
        pixels,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<ContestPicture, FormatError> {
        read(Source::from_bytes(text.as_bytes()), &Limits::default())
    }

    #[test]
    fn what_is_written_is_read_back() {
        let light = [Rgb::new(0.0, 0.5, 1.0), Rgb::new(2.0, 0.1, 0.0)];
        let picture = ContestPicture::from_light(2, 1, &light);
        assert_eq!(picture.to_string(), "2 1\n0 128 255\n510 26 0\n");
        assert_eq!(parse(&picture.to_string()).unwrap(), picture);
    }

    #[test]
    fn lines_may_break_anywhere_and_fractions_are_numbers() {
        let picture = parse("1\n2 1.5\n2 3 4 5\n\n6").unwrap();
        assert_eq!((picture.width(), picture.height()), (1, 2));
        assert_eq!(picture.pixels(), [[1.5, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        for (text, message) in [
            ("", "the size of the picture"),
            ("2", "the size of the picture"),
            ("0 1", "1 to 65536 pixels"),
            ("65536 65536", "over the limit"),
            ("1 1\n1 2", "without a pixel"),
            ("1 2\n1 2 3 4", "after 1 of 2 pixels"),
            ("1 1\n1 2 x", "\"x\", which is not a number"),
            ("1 1\n1 2 3 4", "the end of the picture"),
            ("1 1\n1 nan 3", "finite"),
        ] {
            let error = parse(text).unwrap_err().to_string();
            assert!(error.contains(message), "{text:?}: {error}");
        }
    }
}
