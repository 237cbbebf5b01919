//! What a reader met and went on from.

use std::fmt;

use serde::Serialize;

use crate::error::{plural, shown};

/// Something in a file that its user should hear of, though the file could be read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "finding", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Finding {
    /// Triangles of area zero were left out.
    DegenerateTriangles {
        /// How many.
        count: u64,
    },
    /// Faces with fewer than three corners were left out.
    SmallFaces {
        /// How many.
        count: u64,
    },
    /// Concave polygons with too many corners for ear clipping were cut as fans.
    FannedPolygons {
        /// How many.
        count: u64,
    },
    /// Normals of length zero gave way to that of a face.
    ZeroNormals {
        /// How many.
        count: u64,
    },
    /// Faces without normals in a part whose other faces have them were made flat.
    FlatFaces {
        /// How many triangles.
        count: u64,
    },
    /// Vertices that no triangle uses were left out.
    UnusedVertices {
        /// How many.
        count: u64,
    },
    /// There are vertices, but no triangle.
    NoTriangles,
    /// A keyword, property or element that this reader does not use.
    Unused {
        /// "keyword", "property", "element" or "map option".
        what: &'static str,
        /// Its name.
        name: String,
        /// How often it occurs.
        count: u64,
        /// The file that holds it, if it is not the model itself.
        file: Option<String>,
        /// Where it occurs first, if the file has lines.
        line: Option<u64>,
    },
    /// Something follows the end of the declared content.
    TrailingData,
    /// A materials file or a texture that is not there.
    MissingFile {
        /// "materials file" or "texture".
        what: &'static str,
        /// The name as the model gives it.
        name: String,
    },
    /// A reference that leads out of the model's folder; it was not opened.
    OutsideFolder {
        /// "materials file" or "texture".
        what: &'static str,
        /// The name as the model gives it.
        name: String,
    },
    /// A material that no materials file defines; the default grey stands in.
    UndefinedMaterial {
        /// Its name.
        name: String,
        /// Where it is used first.
        line: u64,
    },
    /// Something in a document (glTF) that is not used or not as the file has it.
    InDocument {
        /// Where it is met first, such as `meshes[0].primitives[0]`.
        place: String,
        /// What there is to hear of it.
        message: String,
        /// How often it is met.
        count: u64,
    },
    /// Something in a model that a scene file refers to.
    InModel {
        /// The model's name as the scene file gives it.
        file: String,
        /// What there is to hear of it.
        about: Box<Finding>,
    },
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DegenerateTriangles { count } => write!(
                f,
                "{count} degenerate {} (area zero) ignored",
                plural("triangle", *count)
            ),
            Self::SmallFaces { count } => write!(
                f,
                "{count} {} with fewer than 3 corners ignored",
                plural("face", *count)
            ),
            Self::FannedPolygons { count } => write!(
                f,
                "{count} concave {} with more than {} corners cut as fans",
                plural("polygon", *count),
                crate::mesh::MOST_CLIPPED_CORNERS
            ),
            Self::ZeroNormals { count } => write!(
                f,
                "{count} {} of length zero replaced by that of a face",
                plural("normal", *count)
            ),
            Self::FlatFaces { count } => write!(
                f,
                "{count} {} without normals among others that have them: shown flat",
                plural("triangle", *count)
            ),
            Self::UnusedVertices { count } => write!(
                f,
                "{count} {} in no triangle ignored",
                plural_vertex(*count)
            ),
            Self::NoTriangles => write!(f, "no triangle; nothing of it can be seen"),
            Self::Unused {
                what,
                name,
                count,
                file,
                line,
            } => {
                if let Some(file) = file {
                    write!(f, "{}: ", shown(file))?;
                }
                if let Some(line) = line {
                    write!(f, "line {line}: ")?;
                }
                write!(f, "{what} \"{}\" not used", shown(name))?;
                if *count > 1 {
                    write!(f, " ({count} times)")?;
                }
                Ok(())
            }
            Self::TrailingData => write!(f, "data after the end of the declared content ignored"),
            Self::MissingFile { what, name } => {
                let instead = if *what == "texture" {
                    "plain colour"
                } else {
                    "default grey"
                };
                write!(f, "{what} {} not found: {instead} used", shown(name))
            }
            Self::OutsideFolder { what, name } => write!(
                f,
                "{what} {} lies outside the model's folder: not opened",
                shown(name)
            ),
            Self::UndefinedMaterial { name, line } => write!(
                f,
                "line {line}: material \"{}\" is not defined: default grey used",
                shown(name)
            ),
            Self::InDocument {
                place,
                message,
                count,
            } => {
                write!(f, "{}: {}", shown(place), shown(message))?;
                if *count > 1 {
                    write!(f, " ({count} times)")?;
                }
                Ok(())
            }
            Self::InModel { file, about } => write!(f, "{}: {about}", shown(file)),
        }
    }
}

const fn plural_vertex(count: u64) -> &'static str {
    if count == 1 { "vertex" } else { "vertices" }
}
