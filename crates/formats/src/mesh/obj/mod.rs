//! Wavefront OBJ ("Advanced Visualizer Manual", appendix B1, Wavefront Technologies, 1992).
//!
//! Read are `v vt vn f s usemtl mtllib`; `o` and `g` only name things. Colours after the
//! coordinates of a vertex are tolerated. Other keywords are counted and passed over. Faults in
//! lines are collected, so that one run shows the first few.

mod corner;
mod parts;

use std::collections::HashMap;

use ombra_geometry::{Normal3, Point3};

use super::mtl::Library;
use super::{Model, ModelFormat};
use crate::error::{Fault, FormatError, Place, quoted};
use crate::input::Assets;
use crate::limits::Limits;
use crate::number::{Words, finite, finite_row, whole};
use crate::source::Source;

use corner::{Corner, Defined};
pub(super) use unused::Unused;

mod unused;

/// So many faults are shown.
const FAULTS_SHOWN: usize = 4;

pub(super) fn read(
    source: &mut Source<'_>,
    assets: &Assets<'_>,
    limits: &Limits,
) -> Result<Model, FormatError> {
    let mut content = Content::default();
    content.read_lines(source)?;
    content.check()?;
    let mut findings = Vec::new();
    std::mem::take(&mut content.unused).report(None, &mut findings);
    let library = Library::load(assets, &content.libraries, limits, &mut findings)?;
    parts::model(content, library, findings)
}

/// What the lines say.
#[derive(Default)]
struct Content {
    positions: Vec<Point3>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<Normal3>,
    /// The corners of all faces, one after another.
    corners: Vec<Corner>,
    /// Where each face's corners end.
    ends: Vec<usize>,
    /// Faces of one material and smoothing group that follow one another.
    runs: Vec<Run>,
    /// Names of materials, in the order of first use, and where that is.
    materials: Vec<(String, u64)>,
    material_numbers: HashMap<String, usize>,
    /// Names of materials files.
    libraries: Vec<String>,
    /// Whether the file says anything about smoothing.
    smoothing_given: bool,
    unused: Unused,
    small_faces: u64,
    /// Indices past what was defined at their line; it may be defined later.
    ahead: Vec<corner::Ahead>,
    faults: Vec<(Place, Fault)>,
    /// The state that the next face takes on.
    material: Option<usize>,
    smoothing: u32,
}

/// Faces from `first` on.
struct Run {
    first: usize,
    /// Which of the names of materials; `None` before the first `usemtl`.
    material: Option<usize>,
    /// 0 is flat.
    smoothing: u32,
}

impl Content {
    fn read_lines(&mut self, source: &mut Source<'_>) -> Result<(), FormatError> {
        while let Some(line) = source.joined_line()? {
            if let Err(fault) = self.read_line(line.bytes, line.number) {
                self.faults.push((Place::Line(line.number), fault));
                // One more than is shown tells that there are more.
                if self.faults.len() > FAULTS_SHOWN {
                    break;
                }
            }
        }
        Ok(())
    }

    fn read_line(&mut self, line: &[u8], number: u64) -> Result<(), Fault> {
        let mut words = Words(line);
        match words.next() {
            None => Ok(()),
            Some(b"v") => self.read_vertex(&mut words),
            Some(b"vt") => self.read_uv(&mut words),
            Some(b"vn") => {
                let normal = finite_row::<3>(&mut words, "normal component");
                let kept = normal.as_ref().copied().unwrap_or_default();
                self.normals.push(kept.into());
                normal.map(drop)
            }
            Some(b"f") => self.read_face(&mut words, number),
            Some(b"s") => self.read_smoothing(&mut words),
            Some(b"usemtl") => {
                self.use_material(&rest_of(words), number);
                Ok(())
            }
            Some(b"mtllib") => {
                let name = rest_of(words);
                // Some exporters repeat the line before every object.
                if self.libraries.last() != Some(&name) {
                    self.libraries.push(name);
                }
                Ok(())
            }
            Some(b"o" | b"g") => Ok(()),
            Some([b'#', ..]) => Ok(()),
            Some(keyword) => {
                self.unused.count(keyword, number);
                Ok(())
            }
        }
    }

    fn read_vertex(&mut self, words: &mut Words<'_>) -> Result<(), Fault> {
        let row = finite_row::<3>(words, "vertex coordinate");
        // A vertex that is wrong still counts, so that the faces after it mean the right ones.
        let kept = row.as_ref().copied().unwrap_or_default();
        self.positions.push(kept.into());
        row.map(drop)
    }

    fn read_uv(&mut self, words: &mut Words<'_>) -> Result<(), Fault> {
        let what = "texture coordinate";
        let row = finite_row::<1>(words, what).and_then(|[u]| {
            let v = words.next().map_or(Ok(0.0), |word| finite(word, what))?;
            Ok([u, v])
        });
        self.uvs.push(row.as_ref().copied().unwrap_or_default());
        row.map(drop)
    }

    fn read_face(&mut self, words: &mut Words<'_>, line: u64) -> Result<(), Fault> {
        let defined = Defined {
            vertices: self.positions.len(),
            uvs: self.uvs.len(),
            normals: self.normals.len(),
        };
        let start = self.corners.len();
        for word in words {
            if word.starts_with(b"#") {
                break;
            }
            match corner::parse(word, &defined, line, &mut self.ahead) {
                Ok(corner) => self.corners.push(corner),
                Err(fault) => {
                    self.corners.truncate(start);
                    return Err(fault);
                }
            }
        }
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            self.small_faces += 1;
            return Ok(());
        }
        let run = Run {
            first: self.ends.len(),
            material: self.material,
            smoothing: self.smoothing,
        };
        let state = |run: &Run| (run.material, run.smoothing);
        if self.runs.last().map(state) != Some(state(&run)) {
            self.runs.push(run);
        }
        self.ends.push(self.corners.len());
        Ok(())
    }

    fn read_smoothing(&mut self, words: &mut Words<'_>) -> Result<(), Fault> {
        self.smoothing_given = true;
        self.smoothing = match words.next() {
            Some(b"off" | b"null") | None => 0,
            Some(b"on") => 1,
            Some(word) => {
                let group = whole(word, "smoothing group")?;
                u32::try_from(group).map_err(|_| Fault::Unexpected {
                    found: quoted(word),
                    expected: "a smoothing group (0 to 4294967295), on or off",
                })?
            }
        };
        Ok(())
    }

    fn use_material(&mut self, name: &str, line: u64) {
        let known = self.material_numbers.get(name).copied();
        self.material = Some(known.unwrap_or_else(|| {
            let number = self.materials.len();
            self.materials.push((name.to_owned(), line));
            self.material_numbers.insert(name.to_owned(), number);
            number
        }));
    }

    /// All faults of the file as one error.
    fn check(&mut self) -> Result<(), FormatError> {
        let defined = Defined {
            vertices: self.positions.len(),
            uvs: self.uvs.len(),
            normals: self.normals.len(),
        };
        let never = self.ahead.iter().filter_map(|ahead| ahead.fault(&defined));
        let mut faults = std::mem::take(&mut self.faults);
        faults.extend(never.take(FAULTS_SHOWN + 1));
        if faults.is_empty() {
            return self.check_size();
        }
        faults.sort_by_key(|f| f.0);
        let more = faults.len() > FAULTS_SHOWN;
        faults.truncate(FAULTS_SHOWN);
        Err(FormatError::collected(faults, more))
    }

    fn check_size(&self) -> Result<(), FormatError> {
        let most = u32::MAX as usize - 1;
        for (what, count) in [
            ("vertices", self.positions.len()),
            ("texture coordinates", self.uvs.len()),
            ("normals", self.normals.len()),
            ("corners of faces", self.corners.len()),
        ] {
            if count > most {
                return Err(FormatError::file(Fault::TooMany { what }));
            }
        }
        if self.positions.is_empty() {
            let found = "no vertex (v x y z)".to_owned();
            let expected = "a model in OBJ";
            return Err(FormatError::file(Fault::Unexpected { found, expected }));
        }
        Ok(())
    }
}

/// What is left of a line as a name: names may hold blanks.
pub(super) fn rest_of(words: Words<'_>) -> String {
    String::from_utf8_lossy(words.0.trim_ascii()).into_owned()
}
