//! From the content of an OBJ file to one mesh a material.

use std::collections::HashMap;

use ombra_geometry::{Normal3, Vector3};
use ombra_scene::Material;

use super::corner::{Corner, NONE};
use super::{Content, ModelFormat};
use crate::error::{Fault, FormatError};
use crate::finding::Finding;
use crate::mesh::finish::{Mended, Raw, area_normal, finish};
use crate::mesh::mtl::Library;
use crate::mesh::polygon::triangulate;
use crate::mesh::{Model, Part};

/// A triangle and the smoothing group that it is in.
#[derive(Clone, Copy)]
struct Triangle {
    corners: [Corner; 3],
    smoothing: u32,
}

impl Triangle {
    fn vertices(&self) -> [u32; 3] {
        self.corners.map(|c| c.vertex)
    }
}

pub(super) fn model(
    mut content: Content,
    mut library: Library<'_>,
    mut findings: Vec<Finding>,
) -> Result<Model, FormatError> {
    let vertices = content.positions.len() as u64;
    let groups = grouped(&content, &mut findings)?;
    content.corners = Vec::new();
    let (mut parts, mut materials) = (Vec::new(), Vec::new());
    let mut mended = Mended::default();
    let mut flat_faces = 0;
    let mut local = vec![NONE; content.positions.len()];
    let single = groups.len() == 1;
    for (used, mut triangles) in groups {
        let material = match used.map(|i| &content.materials[i]) {
            None => Material::default(),
            Some((name, line)) => library.take(name, *line, &mut findings)?,
        };
        flat_faces += complete_normals(&mut content, &mut triangles);
        let raw = if single && is_plain(&triangles) {
            Raw {
                positions: std::mem::take(&mut content.positions),
                triangles: triangles.iter().map(Triangle::vertices).collect(),
                ..Raw::default()
            }
        } else {
            indexed(&content, &triangles, &mut local)
        };
        drop(triangles);
        let (mesh, part_mended) = finish(raw)?;
        mended.add(part_mended);
        if !mesh.triangles().is_empty() {
            parts.push(Part {
                name: material.name.clone(),
                mesh,
                material: materials.len(),
            });
            materials.push(material);
        }
    }
    mended.report(&mut findings);
    if flat_faces > 0 {
        findings.push(Finding::FlatFaces { count: flat_faces });
    }
    if parts.is_empty() {
        findings.push(Finding::NoTriangles);
    }
    Ok(Model {
        format: ModelFormat::Obj,
        parts,
        materials,
        findings,
        files: library.into_files(),
        vertices,
        degenerate_triangles: mended.degenerate,
    })
}

type Group = (Option<usize>, Vec<Triangle>);

/// The triangles of each material, in the order of first use.
fn grouped(content: &Content, findings: &mut Vec<Finding>) -> Result<Vec<Group>, FormatError> {
    let mut groups: Vec<Group> = Vec::new();
    let mut group_of = HashMap::new();
    let mut places = Vec::new();
    let mut fanned = 0;
    for (i, run) in content.runs.iter().enumerate() {
        let group = *group_of.entry(run.material).or_insert_with(|| {
            groups.push((run.material, Vec::new()));
            groups.len() - 1
        });
        let triangles = &mut groups[group].1;
        let end = content
            .runs
            .get(i + 1)
            .map_or(content.ends.len(), |r| r.first);
        for face in run.first..end {
            let start = face.checked_sub(1).map_or(0, |before| content.ends[before]);
            let corners = &content.corners[start..content.ends[face]];
            places.clear();
            places.extend(corners.iter().map(|c| content.positions[c.vertex as usize]));
            fanned += u64::from(triangulate(&places, |t| {
                triangles.push(Triangle {
                    corners: t.map(|corner| corners[corner]),
                    smoothing: run.smoothing,
                });
            }));
        }
        // The vertices of a part are no more than its corners.
        if triangles.len() >= (u32::MAX / 3) as usize {
            return Err(FormatError::file(Fault::TooMany { what: "triangles" }));
        }
    }
    if fanned > 0 {
        findings.push(Finding::FannedPolygons { count: fanned });
    }
    if content.small_faces > 0 {
        let count = content.small_faces;
        findings.push(Finding::SmallFaces { count });
    }
    Ok(groups)
}

/// Whether the triangles have neither normals nor texture coordinates.
fn is_plain(triangles: &[Triangle]) -> bool {
    let mut corners = triangles.iter().flat_map(|t| t.corners);
    corners.all(|c| c.uv == NONE && c.normal == NONE)
}

/// Gives normals to the triangles of a part that have none, if the file says how they should look
/// (by smoothing groups) or other triangles of the part have them. Returns how many of the latter
/// kind there are.
fn complete_normals(content: &mut Content, triangles: &mut [Triangle]) -> u64 {
    let lacks = |t: &Triangle| t.corners.iter().any(|c| c.normal == NONE);
    let lacking = triangles.iter().filter(|t| lacks(t)).count();
    let some_have = lacking < triangles.len();
    if lacking == 0 || !(some_have || content.smoothing_given) {
        return 0;
    }
    let face = |t: &Triangle| area_normal(&content.positions, t.vertices());
    let mut smooth: HashMap<(u32, u32), Smooth> = HashMap::new();
    for triangle in triangles.iter().filter(|t| lacks(t) && t.smoothing > 0) {
        for vertex in triangle.vertices() {
            let at = smooth.entry((vertex, triangle.smoothing)).or_default();
            at.sum += face(triangle).unwrap_or_default();
        }
    }
    let normals = &mut content.normals;
    let mut push = |n: Vector3<f64>| {
        let unit = n.normalized().unwrap_or_default().cast::<f32>();
        normals.push(Normal3::from(unit.to_array()));
        (normals.len() - 1) as u32
    };
    for triangle in triangles.iter_mut().filter(|t| lacks(t)) {
        let own = area_normal(&content.positions, triangle.vertices());
        let group = triangle.smoothing;
        let mut flat = Smooth {
            sum: own.unwrap_or_default(),
            normal: None,
        };
        for corner in triangle.corners.iter_mut().filter(|c| c.normal == NONE) {
            let Smooth { sum, normal } = match group {
                0 => &mut flat,
                _ => smooth.entry((corner.vertex, group)).or_default(),
            };
            corner.normal = *normal.get_or_insert_with(|| push(*sum));
        }
    }
    if content.smoothing_given {
        0
    } else {
        lacking as u64
    }
}

/// The normal of a smoothing group at a vertex.
#[derive(Default)]
struct Smooth {
    /// The sum of its triangles' normals, weighted by their areas.
    sum: Vector3<f64>,
    /// Its number among all normals once it has one.
    normal: Option<u32>,
}

/// The vertices that triangles use, one for each combination of position, texture coordinates and
/// normal. `local` is as long as the positions and holds nothing before and after.
fn indexed(content: &Content, triangles: &[Triangle], local: &mut [u32]) -> Raw {
    let has = |of: fn(&Corner) -> u32| {
        let mut corners = triangles.iter().flat_map(|t| &t.corners);
        corners.any(|c| of(c) != NONE)
    };
    let mut raw = Raw {
        normals: has(|c| c.normal).then(Vec::new),
        uvs: has(|c| c.uv).then(Vec::new),
        ..Raw::default()
    };
    let plain = raw.normals.is_none() && raw.uvs.is_none();
    let mut vertices: HashMap<Corner, u32> = HashMap::new();
    raw.triangles.reserve_exact(triangles.len());
    for triangle in triangles {
        let corners = triangle.corners.map(|corner| {
            let next = raw.positions.len() as u32;
            let index = if plain {
                let index = &mut local[corner.vertex as usize];
                if *index == NONE {
                    *index = next;
                }
                *index
            } else {
                *vertices.entry(corner).or_insert(next)
            };
            if index == next {
                raw.positions
                    .push(content.positions[corner.vertex as usize]);
                if let Some(normals) = &mut raw.normals {
                    normals.push(attribute(&content.normals, corner.normal));
                }
                if let Some(uvs) = &mut raw.uvs {
                    uvs.push(attribute(&content.uvs, corner.uv));
                }
            }
            index
        });
        raw.triangles.push(corners);
    }
    if plain {
        for triangle in triangles {
            for vertex in triangle.vertices() {
                local[vertex as usize] = NONE;
            }
        }
    }
    raw
}

fn attribute<T: Copy + Default>(values: &[T], index: u32) -> T {
    values.get(index as usize).copied().unwrap_or_default()
}
