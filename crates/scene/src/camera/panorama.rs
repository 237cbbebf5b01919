//! A camera that sees everything around it.

use std::f32::consts::{PI, TAU};

use ombra_geometry::{Point3, Vector3};

/// The whole sphere of directions in an equirectangular picture: longitude from left to right with
/// the camera's direction in the middle, latitude from top to bottom. Its natural aspect is 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Panorama;

impl Panorama {
    #[inline]
    pub(super) fn local_ray(self, [px, py]: [f32; 2]) -> (Point3, Vector3) {
        let (sin_around, cos_around) = ((px - 0.5) * TAU).sin_cos();
        let (sin_up, cos_up) = ((0.5 - py) * PI).sin_cos();
        let direction = Vector3::new(sin_around * cos_up, sin_up, -cos_around * cos_up);
        (Point3::ORIGIN, direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_looks_everywhere() {
        let close = |screen, expected: Vector3| {
            let (_, direction) = Panorama.local_ray(screen);
            assert!(
                (direction - expected).length() < 1e-6,
                "{screen:?} → {direction:?}"
            );
        };
        close([0.5, 0.5], -Vector3::Z);
        close([0.75, 0.5], Vector3::X);
        close([0.0, 0.5], Vector3::Z);
        close([0.3, 0.0], Vector3::Y);
        close([0.3, 1.0], -Vector3::Y);
    }
}
