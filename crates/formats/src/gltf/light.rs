//! The lights of `KHR_lights_punctual`.
//!
//! Their strengths are photometric: candela for points and spots (what arrives at the distance d is
//! I / d² lux), lux for directional lights. A matt surface of the colour k that gets E lux sends on
//! k E / π, while Phong's sends on k times the light: so a light's strength here is that of the file
//! over π. What is then too bright or too dark to be seen is mended by one factor for all lights; see
//! [`metering`](super::metering).

use std::f32::consts::{FRAC_1_PI, FRAC_PI_2};

use ombra_geometry::{Angle, Point3, Vector3};
use ombra_scene::light::Falloff;
use ombra_scene::{Light, Rgb};

use super::document::{LightKind, LightSpec};
use super::node::Matrix;
use super::wrong;
use crate::error::FormatError;

/// A light at its node, shining along −z of it.
pub(super) fn light(spec: &LightSpec, matrix: &Matrix, place: &str) -> Result<Light, FormatError> {
    let good = |x: &f32| (0.0..=f32::MAX).contains(x);
    if !spec.color.iter().all(good) {
        let message = format!("is {:?}; finite numbers of 0 or more are right", spec.color);
        return Err(wrong(format!("{place}.color"), message));
    }
    if !good(&spec.intensity) {
        let message = format!(
            "is {}; a finite number of 0 or more is right",
            spec.intensity
        );
        return Err(wrong(format!("{place}.intensity"), message));
    }
    let falloff = match spec.range {
        None => Falloff::InverseSquare,
        Some(range) if range > 0.0 && range.is_finite() => Falloff::InverseSquareWithin { range },
        Some(range) => {
            let message = format!("is {range}; a finite number above 0 is right");
            return Err(wrong(format!("{place}.range"), message));
        }
    };
    let intensity = Rgb::from(spec.color) * (spec.intensity * FRAC_1_PI);
    if !intensity.to_array().iter().all(good) {
        let message = format!(
            "is {}, which times the color {:?} is more than a number holds",
            spec.intensity, spec.color
        );
        return Err(wrong(format!("{place}.intensity"), message));
    }
    let column = |i: usize| Vector3::new(matrix[0][i], matrix[1][i], matrix[2][i]);
    let position = Point3::ORIGIN + column(3).cast::<f32>();
    let direction = -column(2).normalized().unwrap_or_default().cast::<f32>();
    Ok(match spec.kind {
        LightKind::Directional => Light::Directional {
            direction,
            intensity,
        },
        LightKind::Point => Light::Point {
            position,
            intensity,
            falloff,
        },
        LightKind::Spot => {
            let (inner, outer) = (spec.spot.inner_cone_angle, spec.spot.outer_cone_angle);
            if !(0.0 <= inner && inner <= outer && outer <= FRAC_PI_2 + 1e-5) {
                let message = format!(
                    "innerConeAngle is {inner} and outerConeAngle {outer}; radians with \
                     0 <= inner < outer <= 1.5708 are right"
                );
                return Err(wrong(format!("{place}.spot"), message));
            }
            Light::Spot {
                position,
                direction,
                inner: Angle::from_radians(inner),
                outer: Angle::from_radians(outer),
                intensity,
                falloff,
            }
        }
    })
}
