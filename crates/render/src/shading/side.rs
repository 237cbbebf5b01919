//! The side of a surface that is seen.

use ombra_geometry::{Normal3, Vector3};
use ombra_scene::Interaction;

use crate::optics;

/// A surface as seen from one side: its normals face the viewer, so that both sides are shaded
/// alike.
///
/// Of the two normals the true one decides what is in front of the surface and what behind it, so
/// that no light leaks through; the shading normal decides everything else.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// The true normal.
    true_normal: Normal3,
    /// The normal to shade with, on the same side.
    pub(crate) shading_normal: Normal3,
    /// The normal of mirrors and lenses: the shading normal, or where that faces away from the
    /// viewer the nearest one that does not.
    optical_normal: Normal3,
    outside: bool,
}

impl Side {
    #[inline]
    pub(crate) fn of(place: &Interaction) -> Self {
        let outside = place.is_front();
        let towards_viewer = |n: Normal3| if outside { n } else { -n };
        let true_normal = towards_viewer(place.normal);
        let shading_normal = towards_viewer(place.shading_normal);
        let away = shading_normal.dot(place.wo);
        let optical_normal = if away < 0.0 {
            let edge_on = shading_normal - (place.wo * away).to_normal();
            edge_on.normalized().unwrap_or(true_normal)
        } else {
            shading_normal
        };
        Self {
            true_normal,
            shading_normal,
            optical_normal,
            outside,
        }
    }

    /// Whether a direction leads away from the surface on this side.
    #[inline]
    pub(crate) fn is_in_front(&self, direction: Vector3) -> bool {
        self.true_normal.dot(direction) > 0.0
    }

    /// The index of refraction on this side over that on the other one.
    #[inline]
    pub(crate) fn eta(&self, index_of_refraction: f32) -> f32 {
        if self.outside {
            1.0 / index_of_refraction
        } else {
            index_of_refraction
        }
    }

    /// The cosine of the angle at which the viewer looks at the surface.
    #[inline]
    pub(crate) fn cosine(&self, wo: Vector3) -> f32 {
        self.optical_normal.dot(wo)
    }

    /// Where the mirror image is seen: always in front of the surface.
    #[inline]
    pub(crate) fn reflected(&self, wo: Vector3) -> Vector3 {
        let direction = optics::reflected(wo, self.optical_normal);
        let in_front = self.true_normal.dot(direction) >= 0.0;
        // Where an interpolated normal sends the ray into the surface it is mirrored out again.
        if in_front {
            direction
        } else {
            direction.reflect(self.true_normal)
        }
    }

    /// Where the viewer looks to through the surface: always behind it; `None` at total internal
    /// reflection.
    #[inline]
    pub(crate) fn refracted(&self, wo: Vector3, eta: f32) -> Option<Vector3> {
        let direction = optics::refracted(wo, self.optical_normal, eta)?;
        let behind = self.true_normal.dot(direction) <= 0.0;
        Some(if behind {
            direction
        } else {
            direction.reflect(self.true_normal)
        })
    }
}
