//! From a primitive of a mesh to triangles.

use std::collections::HashMap;

use ombra_geometry::{Normal3, Point3};

use super::accessor::{Accessor, Wanted};
use super::buffer::Buffers;
use super::document::{Document, PrimitiveSpec};
use super::mode::Mode;
use super::notes::Notes;
use super::wrong;
use crate::error::{FormatError, plural};
use crate::mesh::finish::{Mended, Raw};

/// What decides how a primitive looks but for its material: primitives that agree in it share one
/// geometry.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    mode: Mode,
    indices: Option<usize>,
    position: usize,
    normal: Option<usize>,
    uv: Option<usize>,
    colour: Option<usize>,
}

impl Key {
    /// Of a primitive whose material lays its textures out by the set `set`; `None`, with a note, if
    /// it makes no triangles.
    pub(super) fn of(
        spec: &PrimitiveSpec,
        set: u32,
        place: &str,
        notes: &mut Notes,
    ) -> Result<Option<Self>, FormatError> {
        let mode = match Mode::of(spec.mode) {
            Ok(mode) => mode,
            Err(Some(kind)) => {
                notes.add(
                    place,
                    format!("{kind} are left out: only triangles are seen"),
                );
                return Ok(None);
            }
            Err(None) => {
                let message = format!("is {}; 0 to 6 is right", spec.mode);
                return Err(wrong(format!("{place}.mode"), message));
            }
        };
        let attribute = |name: &str| spec.attributes.get(name).copied();
        let Some(position) = attribute("POSITION") else {
            notes.add(place, "without POSITION: left out");
            return Ok(None);
        };
        Ok(Some(Self {
            mode,
            indices: spec.indices,
            position,
            normal: attribute("NORMAL"),
            uv: attribute(&format!("TEXCOORD_{set}")),
            colour: attribute("COLOR_0"),
        }))
    }

    pub(super) const fn has_uv(&self) -> bool {
        self.uv.is_some()
    }
}

/// What reading primitives needs and counts.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) mended: Mended,
    /// How many triangles may still be made; see [`Budget`](super::budget::Budget).
    pub(super) triangles_left: u64,
    /// Vertices that primitives use, those that several share counted once for each.
    pub(super) vertices: u64,
}

impl<'a> Reader<'a> {
    /// The triangles of a primitive: only the vertices that they use are read. `called` is the name
    /// of its mesh.
    pub(super) fn read(
        &mut self,
        key: &Key,
        place: &str,
        called: Option<&str>,
        notes: &mut Notes,
    ) -> Result<Raw, FormatError> {
        let attribute = |name: &str| format!("{place}.attributes.{name}");
        let positions = self.accessor(key.position, &["VEC3"], &attribute("POSITION"))?;
        let count = positions.count;
        let normals = self.of_vertices(key.normal, &["VEC3"], &attribute("NORMAL"), count)?;
        let uvs = self.of_vertices(key.uv, &["VEC2"], &attribute("TEXCOORD"), count)?;
        let kinds = ["VEC3", "VEC4"];
        let colours = self.of_vertices(key.colour, &kinds, &attribute("COLOR_0"), count)?;
        let indices = match key.indices {
            None => None,
            Some(index) => {
                let wanted = Wanted {
                    kinds: &["SCALAR"],
                    indices: true,
                };
                let user = format!("{place}.indices");
                let (document, buffers) = (self.document, self.buffers);
                Some(Accessor::of(document, buffers, index, wanted, &user)?)
            }
        };
        let corners = indices.as_ref().map_or(count, |indices| indices.count);
        let triangles = key.mode.triangles(corners);
        self.spend(triangles, place)?;
        if key.mode == Mode::List && corners % 3 != 0 {
            notes.add(place, "vertices after the last whole triangle are left out");
        }
        let at = |corner: u64| match &indices {
            None => corner,
            Some(indices) => u64::from(indices.index(corner)),
        };
        let mut used = Used::new(count, triangles);
        let mut raw = Raw::default();
        let mut dropped = 0;
        for triangle in 0..triangles {
            let vertices = key.mode.corners(triangle).map(at);
            if let Some(index) = vertices.iter().find(|&&v| v >= count) {
                return Err(wrong(
                    format!("{place}.indices"),
                    format!("index {index}, but there {}", range(count)),
                ));
            }
            let finite = |v: &u64| positions.numbers::<3>(*v).iter().all(|x| x.is_finite());
            if vertices.iter().all(finite) {
                raw.triangles.push(vertices.map(|v| used.number(v)));
            } else {
                dropped += 1;
            }
        }
        let all = used.all;
        if dropped > 0 {
            let of = called.map_or(String::new(), |name| format!(" of {name:?}"));
            let triangles = plural("triangle", dropped);
            let message = format!(
                "{dropped} {triangles}{of} with a corner that is not finite (NaN or infinite) left out"
            );
            notes.add(place, message);
        }
        self.vertices += all.len() as u64;
        raw.positions = (all.iter())
            .map(|&v| Point3::from(positions.numbers::<3>(v)))
            .collect();
        raw.normals = normals.map(|normals| {
            let normal = |&v: &u64| Normal3::from(finite_or_zero(normals.numbers::<3>(v)));
            all.iter().map(normal).collect()
        });
        // v runs downward there and upward here.
        raw.uvs = uvs.map(|uvs| {
            let uv = |&v: &u64| {
                let [u, v] = finite_or_zero(uvs.numbers::<2>(v));
                [u, 1.0 - v]
            };
            all.iter().map(uv).collect()
        });
        raw.colours = colours
            .map(|colours| {
                let colour = |&v: &u64| finite_or_zero(colours.numbers::<3>(v)).map(|x| x.max(0.0));
                all.iter().map(colour).collect::<Vec<_>>()
            })
            .filter(|colours| colours.iter().any(|colour| *colour != [1.0; 3]));
        Ok(raw)
    }

    fn accessor(
        &self,
        index: usize,
        kinds: &[&str],
        user: &str,
    ) -> Result<Accessor<'a>, FormatError> {
        let wanted = Wanted {
            kinds,
            indices: false,
        };
        Accessor::of(self.document, self.buffers, index, wanted, user)
    }

    /// An attribute that has as many elements as there are vertices.
    fn of_vertices(
        &self,
        index: Option<usize>,
        kinds: &[&str],
        user: &str,
        vertices: u64,
    ) -> Result<Option<Accessor<'a>>, FormatError> {
        let Some(index) = index else {
            return Ok(None);
        };
        let accessor = self.accessor(index, kinds, user)?;
        if accessor.count == vertices {
            return Ok(Some(accessor));
        }
        let message = format!(
            "has {} elements (accessors[{index}]), but POSITION has {vertices}; one for each is right",
            accessor.count
        );
        Err(wrong(user, message))
    }

    fn spend(&mut self, triangles: u64, place: &str) -> Result<(), FormatError> {
        match self.triangles_left.checked_sub(triangles) {
            Some(left) if triangles <= u64::from(u32::MAX / 3) => {
                self.triangles_left = left;
                Ok(())
            }
            _ => Err(wrong(
                place,
                format!(
                    "makes {triangles} triangles, which is more than a file of this size is \
                     trusted with ({} are left)",
                    self.triangles_left
                ),
            )),
        }
    }
}

/// The vertices that triangles use, numbered in the order of first use.
struct Used {
    all: Vec<u64>,
    numbers: Numbers,
}

enum Numbers {
    /// One place for each vertex there is.
    Dense(Vec<u32>),
    /// For a few of very many.
    Few(HashMap<u64, u32>),
}

const NONE: u32 = u32::MAX;

impl Used {
    fn new(vertices: u64, triangles: u64) -> Self {
        let dense = vertices <= triangles.saturating_mul(12).saturating_add(1024);
        Self {
            all: Vec::new(),
            numbers: if dense {
                Numbers::Dense(vec![NONE; vertices as usize])
            } else {
                Numbers::Few(HashMap::new())
            },
        }
    }

    fn number(&mut self, vertex: u64) -> u32 {
        let next = self.all.len() as u32;
        let number = match &mut self.numbers {
            Numbers::Dense(numbers) => {
                let number = &mut numbers[vertex as usize];
                if *number == NONE {
                    *number = next;
                }
                *number
            }
            Numbers::Few(numbers) => *numbers.entry(vertex).or_insert(next),
        };
        if number == next {
            self.all.push(vertex);
        }
        number
    }
}

fn finite_or_zero<const N: usize>(numbers: [f32; N]) -> [f32; N] {
    numbers.map(|x| if x.is_finite() { x } else { 0.0 })
}

fn range(count: u64) -> String {
    match count {
        0 => "are no vertices".to_owned(),
        1 => "is only 1 vertex (0)".to_owned(),
        n => format!("are only {n} vertices (0 to {})", n - 1),
    }
}
