//! What is kept of the rows, whatever they were encoded in.

use ombra_geometry::{Normal3, Point3};

use super::header::{Element, Kind};
use crate::error::{Fault, FormatError, IndexBase};
use crate::finding::Finding;
use crate::mesh::finish::Raw;
use crate::mesh::polygon::triangulate;
use crate::source::Source;

/// x y z, nx ny nz, u v.
pub(super) const SLOTS: usize = 8;

/// What the numbers in the slots are, for messages.
pub(super) const fn slot_name(slot: usize) -> &'static str {
    match slot {
        0..3 => "vertex coordinate",
        3..6 => "normal component",
        _ => "texture coordinate",
    }
}

/// What an element is to a model.
pub(super) enum Role {
    /// For each property, which slot it fills, if any.
    Vertices {
        slots: Vec<Option<usize>>,
        normals: bool,
        uvs: bool,
    },
    /// Which property lists the corners of a polygon.
    Faces { corners: usize },
    /// Which property lists the corners of strips of triangles, −1 between them.
    Strips { corners: usize },
    /// None.
    Unused,
}

impl Role {
    pub(super) fn of(element: &Element, findings: &mut Vec<Finding>) -> Self {
        // Both names are in use, in place of one another.
        let names = ["vertex_indices", "vertex_index"];
        let corners = || {
            (element.properties.iter()).position(|p| {
                matches!(p.kind, Kind::List { .. }) && names.contains(&p.name.as_str())
            })
        };
        let role = match element.name.as_str() {
            "vertex" => vertex_role(element),
            "face" => corners().map_or(Self::Unused, |corners| Self::Faces { corners }),
            "tristrips" => corners().map_or(Self::Unused, |corners| Self::Strips { corners }),
            _ => Self::Unused,
        };
        let mut unused = |what, name: &str| {
            findings.push(Finding::Unused {
                what,
                name: name.to_owned(),
                count: 1,
                file: None,
                line: None,
            });
        };
        if matches!(role, Self::Unused) {
            unused("element", &element.name);
        }
        for (i, property) in element.properties.iter().enumerate() {
            let used = match &role {
                Self::Vertices { slots, .. } => slots[i].is_some(),
                Self::Faces { corners } | Self::Strips { corners } => i == *corners,
                Self::Unused => true,
            };
            if !used {
                unused("property", &property.name);
            }
        }
        role
    }
}

fn vertex_role(element: &Element) -> Role {
    let scalar = |name: &str| {
        (element.properties.iter())
            .position(|p| matches!(p.kind, Kind::Scalar(_)) && p.name == name)
    };
    let mut slots = vec![None; element.properties.len()];
    let mut fill = |first: usize, names: &[&str]| {
        let columns: Option<Vec<_>> = names.iter().map(|n| scalar(n)).collect();
        for (slot, &column) in columns.iter().flatten().enumerate() {
            slots[column] = Some(first + slot);
        }
        columns.is_some()
    };
    if !fill(0, &["x", "y", "z"]) {
        return Role::Unused;
    }
    let normals = fill(3, &["nx", "ny", "nz"]);
    let uvs = ([["u", "v"], ["s", "t"], ["texture_u", "texture_v"]].iter()).any(|n| fill(6, n));
    Role::Vertices {
        slots,
        normals,
        uvs,
    }
}

#[derive(Default)]
pub(super) struct Collected {
    declared_vertices: u64,
    positions: Vec<Point3>,
    normals: Option<Vec<Normal3>>,
    uvs: Option<Vec<[f32; 2]>>,
    /// The corners of all polygons, one after another.
    corners: Vec<u32>,
    /// Where each polygon's corners end.
    ends: Vec<usize>,
    /// The same of strips of triangles.
    strips: Vec<u32>,
    strip_ends: Vec<usize>,
}

impl Collected {
    pub(super) fn new(declared_vertices: u64) -> Self {
        Self {
            declared_vertices,
            ..Self::default()
        }
    }

    pub(super) fn reserve(&mut self, role: &Role, source: &Source<'_>, element: &Element) {
        let rows = source.rows_to_reserve(element.count, element.properties.len() as u64);
        match role {
            Role::Vertices { normals, uvs, .. } => {
                self.positions.reserve(rows);
                self.normals = normals.then(|| Vec::with_capacity(rows));
                self.uvs = uvs.then(|| Vec::with_capacity(rows));
            }
            Role::Faces { .. } => {
                self.corners.reserve(rows * 3);
                self.ends.reserve(rows);
            }
            Role::Strips { .. } | Role::Unused => {}
        }
    }

    pub(super) fn push_vertex(&mut self, row: [f32; SLOTS]) {
        let [x, y, z, nx, ny, nz, u, v] = row;
        self.positions.push(Point3::new(x, y, z));
        if let Some(normals) = &mut self.normals {
            normals.push(Normal3::new(nx, ny, nz));
        }
        if let Some(uvs) = &mut self.uvs {
            uvs.push([u, v]);
        }
    }

    /// A corner of the polygon that is being read.
    #[inline]
    pub(super) fn push_corner(&mut self, index: i64) -> Result<(), Fault> {
        let corner = self.checked(index)?;
        self.corners.push(corner);
        Ok(())
    }

    pub(super) fn end_face(&mut self) {
        self.ends.push(self.corners.len());
    }

    /// A corner of a strip; −1 ends it.
    pub(super) fn push_strip_corner(&mut self, index: i64) -> Result<(), Fault> {
        if index == -1 {
            self.end_strip();
        } else {
            let corner = self.checked(index)?;
            self.strips.push(corner);
        }
        Ok(())
    }

    pub(super) fn end_strip(&mut self) {
        self.strip_ends.push(self.strips.len());
    }

    fn checked(&self, index: i64) -> Result<u32, Fault> {
        match u32::try_from(index) {
            Ok(corner) if u64::from(corner) < self.declared_vertices => Ok(corner),
            _ => Err(Fault::IndexOutOfRange {
                attribute: "vertex",
                index,
                defined: self.declared_vertices,
                base: IndexBase::Zero,
            }),
        }
    }

    /// The same with all polygons cut into triangles.
    pub(super) fn triangulated(self, findings: &mut Vec<Finding>) -> Result<Raw, FormatError> {
        if (self.positions.len() as u64) < self.declared_vertices {
            return Err(FormatError::file(Fault::Unexpected {
                found: "an element vertex without x, y and z".to_owned(),
                expected: "one with them",
            }));
        }
        let mut triangles = Vec::with_capacity(self.ends.len());
        let (mut small, mut fanned) = (0, 0);
        let mut places = Vec::new();
        for corners in pieces(&self.corners, &self.ends) {
            match *corners {
                [a, b, c] => triangles.push([a, b, c]),
                [] | [_] | [_, _] => small += 1,
                _ => {
                    places.clear();
                    places.extend(corners.iter().map(|&i| self.positions[i as usize]));
                    fanned += u64::from(triangulate(&places, |t| {
                        triangles.push(t.map(|i| corners[i]));
                    }));
                }
            }
        }
        for strip in pieces(&self.strips, &self.strip_ends) {
            triangles.extend(strip.windows(3).enumerate().map(|(i, w)| {
                let [a, b] = if i % 2 == 0 {
                    [w[0], w[1]]
                } else {
                    [w[1], w[0]]
                };
                [a, b, w[2]]
            }));
        }
        if triangles.len() >= u32::MAX as usize {
            return Err(FormatError::file(Fault::TooMany { what: "triangles" }));
        }
        if small > 0 {
            findings.push(Finding::SmallFaces { count: small });
        }
        if fanned > 0 {
            findings.push(Finding::FannedPolygons { count: fanned });
        }
        Ok(Raw {
            positions: self.positions,
            normals: self.normals,
            uvs: self.uvs,
            triangles,
            ..Raw::default()
        })
    }
}

fn pieces<'a>(items: &'a [u32], ends: &'a [usize]) -> impl Iterator<Item = &'a [u32]> {
    ends.iter().scan(0, |start, &end| {
        let piece = &items[*start..end];
        *start = end;
        Some(piece)
    })
}
