//! A camera with a lens: sharp at one distance only.

use ombra_geometry::{Angle, Point3, Vector3};

use super::CameraSample;
use super::perspective::image_point;

/// A perspective camera with a thin lens: Cook, Porter, Carpenter, "Distributed Ray Tracing",
/// SIGGRAPH 1984, section 4.1. All rays of a place in the picture meet at the plane of focus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinLens {
    /// The angle between the top and the bottom of the picture, above 0° and below 180°.
    pub fov: Angle,
    /// The radius of the lens; 0 makes a pinhole.
    pub lens_radius: f32,
    /// The distance of the plane that is sharp, along the direction of the camera. Above 0.
    pub focus_distance: f32,
    /// The outline of the lens.
    pub aperture: Aperture,
    /// See [`Perspective::shift`](super::Perspective::shift).
    pub shift: [f32; 2],
}

/// The outline of a lens, which is that of bright points out of focus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aperture {
    /// A disk of the lens's radius.
    #[default]
    Disk,
    /// A square whose sides are twice the lens's radius, upright in the picture.
    Square,
}

impl ThinLens {
    #[inline]
    pub(super) fn local_ray(
        &self,
        half: f32,
        aspect: f32,
        sample: CameraSample,
    ) -> (Point3, Vector3) {
        let [x, y] = match self.aperture {
            Aperture::Disk => concentric_disk(sample.lens),
            Aperture::Square => sample.lens.map(|x| 2.0 * x - 1.0),
        };
        let on_lens = Vector3::new(x, y, 0.0) * self.lens_radius;
        let [px, py] = sample.screen;
        let [dx, dy] = self.shift;
        let in_focus = image_point(half, aspect, [px + dx, py + dy]) * self.focus_distance;
        (Point3::ORIGIN + on_lens, in_focus - on_lens)
    }
}

/// A uniform point of the unit disk: Shirley, Chiu, "A Low Distortion Map Between Disk and Square",
/// Journal of Graphics Tools 2(3), 1997.
fn concentric_disk([x, y]: [f32; 2]) -> [f32; 2] {
    use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};
    let (a, b) = (2.0 * x - 1.0, 2.0 * y - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0; 2];
    }
    let (radius, angle) = if a.abs() > b.abs() {
        (a, FRAC_PI_4 * (b / a))
    } else {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    };
    [radius * angle.cos(), radius * angle.sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_meet_at_the_plane_of_focus() {
        let camera = ThinLens {
            fov: Angle::from_degrees(60.0),
            lens_radius: 0.3,
            focus_distance: 4.0,
            aperture: Aperture::Disk,
            shift: [0.0; 2],
        };
        let meet = |lens| {
            let screen = [0.2, 0.7];
            let (origin, direction) = camera.local_ray(0.5, 1.5, CameraSample { screen, lens });
            origin + direction
        };
        let middle = meet([0.5, 0.5]);
        assert_eq!(middle.z, -4.0);
        for lens in [[0.0, 0.0], [0.9, 0.1], [0.3, 0.99]] {
            assert!((meet(lens) - middle).length() < 1e-5);
        }
    }
}
