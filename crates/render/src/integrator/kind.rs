//! The integrators by name.

use std::fmt;

use ombra_scene::{Camera, World};

use super::depth;
use crate::display::{Quantity, Response};

/// What to measure along camera rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum IntegratorKind {
    /// Light, by Whitted's ray tracing: Phong's model with shadows, reflection and refraction.
    #[default]
    Whitted,
    /// Light without shadows and reflections, by rasterization: Phong's model alone.
    Raster,
    /// Shading normals as colours.
    Normals,
    /// Distances from the camera.
    Depth,
    /// Steps of the traversal.
    Cost,
    /// How much of the hemisphere over each place is open nearby.
    AmbientOcclusion,
}

impl IntegratorKind {
    /// All of them, the default first.
    pub const ALL: &[Self] = &[
        Self::Whitted,
        Self::Raster,
        Self::Normals,
        Self::Depth,
        Self::Cost,
        Self::AmbientOcclusion,
    ];

    /// The name that a person types.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whitted => "whitted",
            Self::Raster => "raster",
            Self::Normals => "normals",
            Self::Depth => "depth",
            Self::Cost => "cost",
            Self::AmbientOcclusion => "ao",
        }
    }

    /// What it is, in one line.
    #[must_use]
    pub const fn line(self) -> &'static str {
        match self {
            Self::Whitted => "light: Phong shading, shadows, reflection and refraction",
            Self::Raster => "light by rasterization: Phong shading alone, no rays",
            Self::Normals => "shading normals as colours",
            Self::Depth => "distance from the camera, white is near",
            Self::Cost => "traversal steps of camera rays, as a heat map",
            Self::AmbientOcclusion => "ambient occlusion: how open each place is, white is open",
        }
    }

    /// What its films hold.
    pub(crate) fn quantity(self, world: &World, camera: &Camera, response: Response) -> Quantity {
        match self {
            Self::Whitted | Self::Raster => Quantity::Light(response),
            // How open a place is does not depend on the film.
            Self::AmbientOcclusion => Quantity::Light(Response::default()),
            Self::Normals => Quantity::Normal,
            Self::Depth => depth::range(&world.finite_bounds(), camera),
            Self::Cost => Quantity::Steps,
        }
    }
}

impl fmt::Display for IntegratorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_lines_tell_integrators_apart() {
        for (i, kind) in IntegratorKind::ALL.iter().enumerate() {
            for other in &IntegratorKind::ALL[..i] {
                assert_ne!(kind.name(), other.name());
                assert_ne!(kind.line(), other.line());
            }
            assert_eq!(kind.to_string(), kind.name());
        }
    }
}
