//! STL, as text and binary (3D Systems, "StereoLithography Interface Specification", 1989).
//!
//! Equal corners become one vertex. The normals of an STL file are those of its triangles, which
//! their winding gives as well, so they are not read.

use std::collections::HashMap;

use ombra_geometry::Point3;

use super::finish::Raw;
use super::{Model, ModelFormat};
use crate::error::{Fault, FormatError, Place, quoted};
use crate::finding::Finding;
use crate::number::{Words, finite_row};
use crate::source::{Size, Source};

/// 80 bytes of free text and the number of triangles.
const HEADER: usize = 84;
/// A normal, three corners, and two bytes that mean nothing.
const ROW: usize = 50;
const COORDINATE: &str = "vertex coordinate";

pub(super) fn read(source: &mut Source<'_>) -> Result<Model, FormatError> {
    if is_binary(source)? {
        read_binary(source)
    } else {
        read_ascii(source)
    }
}

/// Many binary files begin with "solid", too, so that word is not what decides: a size that fits
/// the declared number of triangles makes a file binary, and so does anything that is not text.
fn is_binary(source: &mut Source<'_>) -> Result<bool, FormatError> {
    let size = source.size();
    let head = source.peek(1024)?;
    if let (Some(count), Size::Exactly(size)) = (declared(head), size)
        && size == HEADER as u64 + count * ROW as u64
    {
        return Ok(true);
    }
    let text = head.trim_ascii_start();
    let is_solid = text.len() >= 5 && text[..5].eq_ignore_ascii_case(b"solid");
    Ok(!is_solid || head.contains(&0))
}

fn declared(head: &[u8]) -> Option<u64> {
    let count = head.get(80..HEADER)?.first_chunk()?;
    Some(u64::from(u32::from_le_bytes(*count)))
}

/// Triangles whose equal corners are one vertex.
#[derive(Default)]
struct Soup {
    raw: Raw,
    vertices: HashMap<[u32; 3], u32>,
}

impl Soup {
    fn vertex(&mut self, p: Point3) -> u32 {
        let Soup { raw, vertices } = self;
        // Adding 0 makes −0 and 0 the same.
        let key = p.to_array().map(|x| (x + 0.0).to_bits());
        *vertices.entry(key).or_insert_with(|| {
            raw.positions.push(p);
            (raw.positions.len() - 1) as u32
        })
    }

    fn push(&mut self, corners: [Point3; 3]) -> Result<(), FormatError> {
        // So many triangles cannot have more vertices than fit an index either.
        if self.raw.triangles.len() >= (u32::MAX / 3) as usize {
            return Err(FormatError::file(Fault::TooMany { what: "triangles" }));
        }
        let triangle = corners.map(|p| self.vertex(p));
        self.raw.triangles.push(triangle);
        Ok(())
    }
}

fn read_binary(source: &mut Source<'_>) -> Result<Model, FormatError> {
    let count = declared(source.peek(HEADER)?).ok_or_else(|| {
        FormatError::file(Fault::Unexpected {
            found: "a shorter file".to_owned(),
            expected: "text that begins with \"solid\", or a binary header of 84 bytes",
        })
    })?;
    source.take(HEADER)?;
    let (needed, available) = (count * ROW as u64, source.most_left());
    if needed > available {
        return Err(FormatError::file(Fault::TooShort {
            what: "triangles".to_owned(),
            rows: count,
            needed,
            available,
            at_most: matches!(source.size(), Size::AtMost(_)),
        }));
    }
    let mut soup = Soup::default();
    let reserve = source.rows_to_reserve(count, ROW as u64);
    soup.raw.triangles.reserve(reserve);
    for row in 1..=count {
        let place = source.place();
        let bytes = source.take(ROW)?.ok_or_else(|| {
            let element = "triangle".to_owned();
            let rows = count;
            FormatError::new(place, Fault::UnexpectedEnd { element, row, rows })
        })?;
        soup.push(corners(bytes).map_err(|fault| {
            let element = "triangle".to_owned();
            let fault = Box::new(fault);
            FormatError::new(
                place,
                Fault::Row {
                    element,
                    row,
                    fault,
                },
            )
        })?)?;
    }
    let mut findings = Vec::new();
    if !source.peek(1)?.is_empty() {
        findings.push(Finding::TrailingData);
    }
    Model::of_one_part(ModelFormat::StlBinary, soup.raw, findings)
}

/// The corners in a row of 50 bytes.
fn corners(row: &[u8]) -> Result<[Point3; 3], Fault> {
    let mut corners = [Point3::ORIGIN; 3];
    for (corner, bytes) in corners.iter_mut().zip(row[12..48].as_chunks::<12>().0) {
        let mut p = [0.0; 3];
        for (x, bytes) in p.iter_mut().zip(bytes.as_chunks().0) {
            *x = f32::from_le_bytes(*bytes);
            if !x.is_finite() {
                let found = x.to_string();
                let what = COORDINATE;
                return Err(Fault::NotFinite { what, found });
            }
        }
        *corner = p.into();
    }
    Ok(corners)
}

fn read_ascii(source: &mut Source<'_>) -> Result<Model, FormatError> {
    let mut soup = Soup::default();
    let mut corners = Vec::with_capacity(3);
    while let Some(line) = source.line()? {
        let mut words = Words(line.bytes);
        let at_line = |fault| FormatError::line(line.number, fault);
        let Some(keyword) = words.next() else {
            continue;
        };
        match keyword.to_ascii_lowercase().as_slice() {
            b"vertex" => {
                let p = finite_row::<3>(&mut words, COORDINATE).map_err(at_line)?;
                corners.push(Point3::from(p));
                if corners.len() > 3 {
                    return Err(at_line(unexpected(
                        keyword,
                        "the end of a loop of 3 vertices",
                    )));
                }
            }
            b"endloop" => match corners[..] {
                [a, b, c] => {
                    soup.push([a, b, c])?;
                    corners.clear();
                }
                _ => return Err(at_line(unexpected(keyword, "a loop of 3 vertices"))),
            },
            b"facet" | b"outer" | b"endfacet" | b"solid" | b"endsolid" if corners.is_empty() => {}
            _ => {
                let expected = if corners.is_empty() {
                    "facet, outer loop, vertex, endloop, endfacet or endsolid"
                } else {
                    "a loop of 3 vertices and endloop"
                };
                return Err(at_line(unexpected(keyword, expected)));
            }
        }
    }
    if !corners.is_empty() {
        let place = Place::Line(source.lines_read());
        let found = "the end of the file".to_owned();
        let expected = "a loop of 3 vertices and endloop";
        return Err(FormatError::new(
            place,
            Fault::Unexpected { found, expected },
        ));
    }
    Model::of_one_part(ModelFormat::StlAscii, soup.raw, Vec::new())
}

fn unexpected(found: &[u8], expected: &'static str) -> Fault {
    Fault::Unexpected {
        found: quoted(found),
        expected,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn binary(header: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const TWO: [[[f32; 3]; 3]; 2] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
        [[-0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    ];

    const TEXT: &str = "solid two\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  \
        vertex 1 1 0\n endloop\nendfacet\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  \
        VERTEX 1e0 1 0\n  vertex 0 1 0\n endloop\nendfacet\nendsolid two\n";

    fn read_bytes(bytes: &[u8]) -> Result<Model, FormatError> {
        read(&mut Source::from_bytes(bytes))
    }

    #[test]
    fn text_and_binary_give_the_same_mesh_with_shared_vertices() {
        let text = read_bytes(TEXT.as_bytes()).unwrap();
        let bytes = read_bytes(&binary(b"made by a test", &TWO)).unwrap();
        assert_eq!(text.format, ModelFormat::StlAscii);
        assert_eq!(bytes.format, ModelFormat::StlBinary);
        assert_eq!(text.parts[0].mesh, bytes.parts[0].mesh);
        assert_eq!(text.vertices, 4);
        assert_eq!(text.triangles(), 2);
    }

    #[test]
    fn a_binary_file_that_begins_with_solid_is_binary() {
        let model = read_bytes(&binary(b"solid as a rock", &TWO)).unwrap();
        assert_eq!(model.format, ModelFormat::StlBinary);
        // Nor does a wrong size make it text.
        let mut cut = binary(b"solid as a rock", &TWO);
        cut.pop();
        let error = read_bytes(&cut).unwrap_err().to_string();
        assert_eq!(
            error,
            "file too short: 2 triangles are declared, which need at least 100 bytes, but only 99 follow"
        );
    }

    #[test]
    fn nothing_is_an_empty_model_and_more_is_reported() {
        let nothing = read_bytes(&binary(b"", &[])).unwrap();
        assert_eq!(nothing.findings, [Finding::NoTriangles]);
        let mut long = binary(b"", &TWO);
        long.push(7);
        let long = read_bytes(&long).unwrap();
        assert_eq!(long.findings, [Finding::TrailingData]);
    }

    #[test]
    fn faults_are_named_with_their_place() {
        let mut nan = TWO;
        nan[1][2][1] = f32::NAN;
        let error = read_bytes(&binary(b"", &nan)).unwrap_err().to_string();
        assert!(error.starts_with("byte 134: element triangle, row 2: vertex coordinate is NaN"));
        for (from, to, expected) in [
            (
                "VERTEX 1e0 1 0",
                "vertex 1e0 1",
                "line 12: vertex coordinate has 2 numbers, but needs 3",
            ),
            (
                "VERTEX 1e0 1 0\n",
                "",
                "line 13: \"endloop\" found where a loop of 3 vertices is expected",
            ),
            (
                "endloop\nendfacet\nendsolid two\n",
                "",
                "line 14: the end of the file found where",
            ),
            (
                "facet normal",
                "facette normal",
                "line 2: \"facette\" found where facet,",
            ),
        ] {
            let error = read_bytes(TEXT.replacen(from, to, 1).as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with(expected), "{error}");
        }
        assert!(read_bytes(b"solid").is_ok());
        assert!(read_bytes(b"short").is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn no_bytes_make_it_panic(
            bytes in prop::collection::vec(any::<u8>(), 0..300),
            cut in 0..400_usize,
            at in 0..400_usize,
        ) {
            let _ = read_bytes(&bytes);
            let mut text = TEXT.as_bytes()[..cut.min(TEXT.len())].to_vec();
            if let Some(byte) = text.get_mut(at) {
                *byte = bytes.first().copied().unwrap_or(0);
            }
            let _ = read_bytes(&text);
        }
    }
}
