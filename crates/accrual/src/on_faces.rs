//! Roofs and façades: those of their places that the sky can reach.

use ombra_city::{City, FaceKind, FacePlace, GridError, Inside};
use rayon::prelude::*;

use crate::ground::Ground;

/// What another building stands this near before, in metres, is no outer face: outlines of neighbours do not
/// meet to the centimetre.
const CLEARANCE: f32 = 0.1;

/// Places on the faces of buildings, and how many were left out.
#[derive(Clone, Debug, Default)]
pub struct OnFaces {
    /// The places, in the order of the buildings and their faces.
    pub places: Vec<FacePlace>,
    /// How many lie in a building or within 10 cm of one (on a wall against its neighbour, on a podium's roof under
    /// its tower), or below the terrain. They are not among the places.
    pub hidden: usize,
}

impl OnFaces {
    /// Those of [`City::face_places`] that are to be `kept` (it is asked with local metres east and north)
    /// and that lie neither in a building nor below the terrain. What is not kept is not counted as hidden.
    ///
    /// # Errors
    /// As those of [`City::face_places`].
    pub fn of(
        city: &City,
        kind: FaceKind,
        cell: f64,
        kept: impl Fn([f64; 2]) -> bool,
    ) -> Result<Self, GridError> {
        let places = city.face_places(kind, cell, kept)?;
        let all = places.len();
        let (inside, ground) = (Inside::new(city), Ground::new(city));
        let is_seen = |place: &FacePlace| {
            let at = place.at;
            let is_free = |at| !inside.contains(at);
            is_free(at)
                && is_free(at + place.normal * CLEARANCE)
                && (ground.at([at.x, at.y].map(f64::from))).is_none_or(|foot| at.z > foot.z)
        };
        let places: Vec<FacePlace> = places.into_par_iter().filter(is_seen).collect();
        let hidden = all - places.len();
        Ok(Self { places, hidden })
    }
}
