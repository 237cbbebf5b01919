//! A scene of the contest: spheres, some of which shine, in the dialect of C that `ray.h` is in.

use std::path::Path;

use super::words::{Word, Words};
use crate::error::{Fault, FormatError};
use crate::number::{finite, whole};
use crate::scene::text_of;

/// A scene of the contest.
#[derive(Clone, Debug, PartialEq)]
pub struct Contest {
    /// How deep the tree of rays is, 1 to 129: 1 are camera rays alone, and what lies beyond is black.
    pub depth: u32,
    /// Pixels each way, 2 to 65,536.
    pub size: u32,
    /// The angle of view across the picture, in degrees, above 0 and below 180.
    pub angle_of_view: f32,
    /// Light that is everywhere, and what is seen where there is nothing.
    pub ambient: [f32; 3],
    /// The spheres.
    pub spheres: Vec<ContestSphere>,
}

/// A sphere of the contest; the names are the contest's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContestSphere {
    /// Its centre. The eye is at the origin and looks along +y; x is right and z is up.
    pub centre: [f32; 3],
    /// Its colour.
    pub colour: [f32; 3],
    /// Its radius, above 0.
    pub radius: f32,
    /// How much light it scatters.
    pub kd: f32,
    /// How much it mirrors.
    pub ks: f32,
    /// How much it lets through.
    pub kt: f32,
    /// How much it shines.
    pub kl: f32,
    /// Its index of refraction, above 0.
    pub ir: f32,
}

/// Reads a scene of the contest.
///
/// # Errors
/// When the file cannot be read or does not say what `ray.h` says; the error names the file, the
/// line, what is wrong and what would be right.
pub fn read_contest(path: impl AsRef<Path>) -> Result<Contest, FormatError> {
    let path = path.as_ref();
    text_of(path)
        .and_then(|text| parse_contest(text.as_bytes()))
        .map_err(|error| error.in_file(path))
}

/// Reads a scene of the contest from the text of its `ray.h`.
///
/// # Errors
/// See [`read_contest`].
pub fn parse_contest(text: &[u8]) -> Result<Contest, FormatError> {
    let mut header = Header::default();
    let mut words = Words::new(text);
    while let Some(word) = words.next()? {
        match word.text {
            b"#" => header.definition(&mut words)?,
            b"AMBIENT" => header.ambient = Some(ambient(&word, &mut words)?),
            b"SPHERE" => header.spheres = Some(spheres(&word, &mut words)?),
            b";" => {}
            _ => {
                return Err(word.instead_of("#define, AMBIENT = {...} or SPHERE = {...}"));
            }
        }
    }
    header.finish(words.line())
}

/// What has been read so far.
#[derive(Debug, Default)]
struct Header {
    depth: Option<u32>,
    size: Option<u32>,
    angle_of_view: Option<f32>,
    count: Option<(u32, u64)>,
    ambient: Option<[f32; 3]>,
    spheres: Option<Vec<ContestSphere>>,
}

impl Header {
    /// What follows `#`.
    fn definition(&mut self, words: &mut Words<'_>) -> Result<(), FormatError> {
        let define = words.needed("define")?;
        if define.text != b"define" {
            return Err(define.instead_of("define"));
        }
        let name = words.needed("DEPTH, SIZE, AOV or NSPHERE")?;
        let value = words.needed("a number")?;
        match name.text {
            b"DEPTH" => self.depth = Some(count("DEPTH", value, 1..=129)?),
            b"SIZE" => self.size = Some(count("SIZE", value, 2..=65_536)?),
            b"NSPHERE" => {
                let number = count("NSPHERE", value, 0..=u32::MAX)?;
                self.count = Some((number, value.line));
            }
            b"AOV" => {
                let degrees = number("AOV", value)?;
                if !(degrees > 0.0 && degrees < 180.0) {
                    return Err(value.instead_of("an angle above 0 and below 180 degrees"));
                }
                self.angle_of_view = Some(degrees);
            }
            _ => return Err(name.instead_of("DEPTH, SIZE, AOV or NSPHERE")),
        }
        Ok(())
    }

    fn finish(self, last_line: u64) -> Result<Contest, FormatError> {
        let missing = |what: &str| {
            let message = format!("{what} is missing");
            FormatError::line(last_line, Fault::Description(message))
        };
        let spheres = self.spheres.ok_or_else(|| missing("SPHERE = {...}"))?;
        if let Some((count, line)) = self.count
            && count as usize != spheres.len()
        {
            let there = spheres.len();
            let message = format!("NSPHERE is {count}, but SPHERE has {there}");
            return Err(FormatError::line(line, Fault::Description(message)));
        }
        Ok(Contest {
            depth: self.depth.ok_or_else(|| missing("#define DEPTH"))?,
            size: self.size.ok_or_else(|| missing("#define SIZE"))?,
            angle_of_view: self.angle_of_view.ok_or_else(|| missing("#define AOV"))?,
            ambient: self.ambient.ok_or_else(|| missing("AMBIENT = {...}"))?,
            spheres,
        })
    }
}

fn ambient(name: &Word<'_>, words: &mut Words<'_>) -> Result<[f32; 3], FormatError> {
    let numbers = list("AMBIENT", words)?;
    let light: [f32; 3] = numbers
        .iter()
        .map(|&(number, _)| number)
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|_| wrong_count(name.line, "AMBIENT", numbers.len(), "3 are needed"))?;
    for (number, line) in numbers {
        at_least_zero("a component of AMBIENT", number, line)?;
    }
    Ok(light)
}

fn spheres(name: &Word<'_>, words: &mut Words<'_>) -> Result<Vec<ContestSphere>, FormatError> {
    const NUMBERS: usize = 12;
    let numbers = list("SPHERE", words)?;
    if numbers.len() % NUMBERS != 0 {
        let right = "12 a sphere are needed: centre, colour, radius, kd, ks, kt, kl, ir";
        return Err(wrong_count(name.line, "SPHERE", numbers.len(), right));
    }
    numbers.chunks_exact(NUMBERS).map(sphere).collect()
}

fn sphere(numbers: &[(f32, u64)]) -> Result<ContestSphere, FormatError> {
    let at = |i: usize| numbers[i].0;
    let light = |i: usize, what| {
        let (number, line) = numbers[i];
        at_least_zero(what, number, line)
    };
    let above_zero = |i: usize, what: &'static str| {
        let (number, line) = numbers[i];
        if number > 0.0 {
            return Ok(number);
        }
        let message = format!("{what} is {number}; a number above 0 is needed");
        Err(FormatError::line(line, Fault::Description(message)))
    };
    Ok(ContestSphere {
        centre: [at(0), at(1), at(2)],
        colour: [light(3, "red")?, light(4, "green")?, light(5, "blue")?],
        radius: above_zero(6, "the radius")?,
        kd: light(7, "kd")?,
        ks: light(8, "ks")?,
        kt: light(9, "kt")?,
        kl: light(10, "kl")?,
        ir: above_zero(11, "ir")?,
    })
}

/// `= { number, number, … };` with the line of each number.
fn list(what: &'static str, words: &mut Words<'_>) -> Result<Vec<(f32, u64)>, FormatError> {
    let equals = words.needed("\"=\"")?;
    if equals.text != b"=" {
        return Err(equals.instead_of("\"=\""));
    }
    let open = words.needed("\"{\"")?;
    if open.text != b"{" {
        return Err(open.instead_of("\"{\""));
    }
    let mut numbers = Vec::new();
    // How deep in braces: rows may have some of their own.
    let mut depth = 1_u32;
    while depth > 0 {
        let word = words.needed("a number or \"}\"")?;
        match word.text {
            b"," => {}
            b"{" => depth += 1,
            b"}" => depth -= 1,
            _ => numbers.push((number(what, word)?, word.line)),
        }
    }
    Ok(numbers)
}

fn number(what: &'static str, word: Word<'_>) -> Result<f32, FormatError> {
    // C lets a number say that it is single precision.
    let digits = word.text.strip_suffix(b"f").unwrap_or(word.text);
    finite(digits, what).map_err(|fault| FormatError::line(word.line, fault))
}

fn count(
    what: &'static str,
    word: Word<'_>,
    range: std::ops::RangeInclusive<u32>,
) -> Result<u32, FormatError> {
    let number = whole(word.text, what).map_err(|fault| FormatError::line(word.line, fault))?;
    let fitting = u32::try_from(number).ok().filter(|n| range.contains(n));
    fitting.ok_or_else(|| {
        let (from, to) = range.into_inner();
        let message = format!("{what} is {number}; {from} to {to} is needed");
        FormatError::line(word.line, Fault::Description(message))
    })
}

fn at_least_zero(what: &str, number: f32, line: u64) -> Result<f32, FormatError> {
    if number >= 0.0 {
        return Ok(number);
    }
    let message = format!("{what} is {number}; 0 or more is needed");
    Err(FormatError::line(line, Fault::Description(message)))
}

fn wrong_count(line: u64, what: &str, found: usize, right: &str) -> FormatError {
    let message = format!("{what} has {found} numbers; {right}");
    FormatError::line(line, Fault::Description(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = "#define DEPTH 2\n#define SIZE 9\n#define AOV 30\n#define NSPHERE 1\n\
        AMBIENT = {.5, 0, 1.};\nSPHERE = {\n 0, 5, 0,  1, .5, 0,  1,  .5, .25, .25, 0,  1.5,\n};\n";

    #[test]
    fn a_header_is_read() {
        let contest = parse_contest(SMALL.as_bytes()).unwrap();
        assert_eq!((contest.depth, contest.size), (2, 9));
        assert_eq!(contest.angle_of_view, 30.0);
        assert_eq!(contest.ambient, [0.5, 0.0, 1.0]);
        let [sphere] = contest.spheres[..] else {
            panic!("one sphere")
        };
        assert_eq!(sphere.centre, [0.0, 5.0, 0.0]);
        assert_eq!((sphere.radius, sphere.kt, sphere.ir), (1.0, 0.25, 1.5));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let cases = [
            (
                "#define DEPTH 2",
                "#define DEPTH 0",
                "1",
                "DEPTH is 0; 1 to 129",
            ),
            (
                "#define SIZE 9",
                "#define SIZE 1",
                "2",
                "SIZE is 1; 2 to 65536",
            ),
            ("AOV 30", "AOV 180", "3", "below 180 degrees"),
            (
                "NSPHERE 1",
                "NSPHERE 2",
                "4",
                "NSPHERE is 2, but SPHERE has 1",
            ),
            (".5, 0, 1.}", ".5, 0}", "5", "AMBIENT has 2 numbers; 3"),
            ("1.5,\n}", "}", "6", "SPHERE has 11 numbers; 12 a sphere"),
            ("1.5,\n}", "nan,\n}", "7", "finite number"),
            (" 1,  .5, .25", " 0,  .5, .25", "7", "radius is 0"),
            (".25, .25, 0", ".25, -1, 0", "7", "kt is -1; 0 or more"),
            ("SPHERE =", "SPHERES =", "6", "SPHERE = {...}"),
            (
                "AMBIENT = {.5, 0, 1.};",
                "",
                "9",
                "AMBIENT = {...} is missing",
            ),
            ("\n};", "", "8", "the end of the file"),
        ];
        for (right, wrong, line, message) in cases {
            let text = SMALL.replacen(right, wrong, 1);
            let error = parse_contest(text.as_bytes()).unwrap_err();
            let error = error.in_file("ray.h".as_ref()).to_string();
            assert!(
                error.contains(&format!("ray.h:{line}: ")) && error.contains(message),
                "{wrong:?}: {error}"
            );
        }
    }
}
