//! The integrators by name.

use std::fmt;
use std::str::FromStr;

use ombra_scene::{Camera, World};

use super::depth;
use crate::display::Quantity;

/// What to measure along camera rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum IntegratorKind {
    /// Light, by Whitted's ray tracing: Phong's model with shadows, reflection and refraction.
    #[default]
    Whitted,
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
            Self::Normals => "shading normals as colours",
            Self::Depth => "distance from the camera, white is near",
            Self::Cost => "traversal steps of camera rays, as a heat map",
            Self::AmbientOcclusion => "ambient occlusion: how open each place is, white is open",
        }
    }

    /// What its films hold.
    pub(crate) fn quantity(self, world: &World, camera: &Camera) -> Quantity {
        match self {
            Self::Whitted | Self::AmbientOcclusion => Quantity::Light,
            Self::Normals => Quantity::Normal,
            Self::Depth => depth::range(&world.finite_bounds(), camera),
            Self::Cost => Quantity::Steps,
        }
    }
}

/// A name that no integrator has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownIntegrator(String);

impl fmt::Display for UnknownIntegrator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = IntegratorKind::ALL.iter().map(|kind| kind.name()).collect();
        write!(
            f,
            "there is no integrator \"{}\"; there are: {}",
            self.0,
            names.join(", ")
        )
    }
}

impl std::error::Error for UnknownIntegrator {}

impl FromStr for IntegratorKind {
    type Err = UnknownIntegrator;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .iter()
            .copied()
            .find(|kind| kind.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownIntegrator(name.to_owned()))
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
    fn names_lead_back_to_integrators() {
        for &kind in IntegratorKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
            assert!(!kind.line().is_empty());
        }
        let error = "path".parse::<IntegratorKind>().unwrap_err().to_string();
        assert!(
            IntegratorKind::ALL
                .iter()
                .all(|kind| error.contains(kind.name()))
        );
    }
}
