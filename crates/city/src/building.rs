//! Buildings in local metres.

use ombra_geometry::Point3;

use crate::polygon::Polygon;

/// A building: one or several parts under one name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Building {
    /// Its name in the file, if it has one.
    pub id: Option<String>,
    /// What it is made of; at least one part. Parts may abut and overlap.
    pub parts: Vec<Part>,
    /// The z of the ground that it stands on, metres.
    pub ground: f32,
    /// Metres above the sea of its ground, if the file tells so beside a flat map.
    pub ground_elevation: Option<f32>,
}

/// A piece of a building.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// An outline with upright walls and a flat roof.
    Prism(Prism),
    /// Faces as the file has them.
    Faces(Faces),
}

/// An outline with upright walls and a flat roof: a closed solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// Its outline.
    pub outline: Polygon,
    /// Where it begins: z in metres, at least that of the building's ground.
    pub base: f32,
    /// Where it ends: z in metres, above `base`.
    pub top: f32,
}

/// Faces as the file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faces {
    /// The faces; at least one.
    pub faces: Vec<Face>,
    /// Whether they enclose a solid, each facing outwards. It may be open where it stands on the
    /// ground.
    pub is_closed: bool,
}

/// A flat face with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// The outer ring, counter-clockwise as seen from outside, then its holes. No ring repeats its
    /// first corner.
    pub rings: Vec<Vec<Point3>>,
    /// What it is of the building.
    pub surface: Surface,
}

/// What a face is of its building.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Surface {
    /// Of the roof.
    Roof,
    /// Of a wall.
    Wall,
    /// Where the building stands on the ground.
    Ground,
    /// The file does not say.
    #[default]
    Untold,
}

impl Building {
    /// The least box around it on the ground: its lowest and its highest corner.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 2]; 2] {
        let corners = self.parts.iter().flat_map(Part::bounds);
        crate::polygon::bounds(corners)
    }
}

impl Part {
    /// The z of its lowest and of its highest place, metres.
    #[must_use]
    pub fn range(&self) -> [f32; 2] {
        match self {
            Self::Prism(prism) => [prism.base, prism.top],
            Self::Faces(faces) => (faces.faces.iter().flat_map(Face::corners))
                .fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], p| {
                    [low.min(p.z), high.max(p.z)]
                }),
        }
    }

    /// The least box around it on the ground: its lowest and its highest corner.
    #[must_use]
    pub fn bounds(&self) -> [[f32; 2]; 2] {
        match self {
            Self::Prism(prism) => prism.outline.bounds(),
            Self::Faces(faces) => {
                let corners = faces.faces.iter().flat_map(Face::corners);
                crate::polygon::bounds(corners.map(|p| [p.x, p.y]))
            }
        }
    }
}

impl Face {
    /// The corners of all its rings.
    pub fn corners(&self) -> impl Iterator<Item = Point3> {
        self.rings.iter().flatten().copied()
    }
}
