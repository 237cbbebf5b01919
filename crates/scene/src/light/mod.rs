//! Lights that have no surface: they are not seen, they only light.
//!
//! A light that is seen is an object with [`Material::emission`](crate::Material::emission).

use ombra_geometry::{Angle, Point3, Vector3};

use crate::Rgb;

/// A light.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// Shines from one point in all directions.
    Point {
        /// Where.
        position: Point3,
        /// The colour and strength of the light, as it arrives at distance 1.
        intensity: Rgb,
        /// How it weakens on its way.
        falloff: Falloff,
    },
    /// Shines from infinitely far away, like the sun.
    Directional {
        /// Where the light goes, of any length but 0.
        direction: Vector3,
        /// The colour and strength of the light.
        intensity: Rgb,
    },
    /// Shines from one point into a cone.
    Spot {
        /// Where.
        position: Point3,
        /// Along the middle of the cone, of any length but 0.
        direction: Vector3,
        /// Half the opening angle of the part that is fully lit.
        inner: Angle,
        /// Half the opening angle of the whole cone; between the two the light fades. Not above
        /// `inner` makes a sharp edge.
        outer: Angle,
        /// The colour and strength of the light in the middle, as it arrives at distance 1.
        intensity: Rgb,
        /// How it weakens on its way.
        falloff: Falloff,
    },
}

/// How light from a point weakens with the distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all, as in the lecture.
    #[default]
    None,
    /// With the square of the distance, as in the world.
    InverseSquare,
}

impl Falloff {
    fn at(self, distance: f32) -> f32 {
        match self {
            Self::None => 1.0,
            Self::InverseSquare => 1.0 / (distance * distance),
        }
    }
}

/// What of a light arrives at a point if nothing is in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Toward the light, unit length.
    pub wi: Vector3,
    /// How far the light is; infinite for a directional one.
    pub distance: f32,
    /// How much arrives on a surface that faces it.
    pub incident: Rgb,
}

impl Light {
    /// What arrives at `point`; `None` if nothing does: outside of a cone, or at the light itself.
    #[must_use]
    pub fn sample_li(&self, point: Point3) -> Option<LightSample> {
        match self {
            Self::Point {
                position,
                intensity,
                falloff,
            } => {
                let (wi, distance) = toward(point, *position)?;
                let incident = *intensity * falloff.at(distance);
                Some(LightSample {
                    wi,
                    distance,
                    incident,
                })
            }
            Self::Directional {
                direction,
                intensity,
            } => Some(LightSample {
                wi: -direction.normalized()?,
                distance: f32::INFINITY,
                incident: *intensity,
            }),
            Self::Spot {
                position,
                direction,
                inner,
                outer,
                intensity,
                falloff,
            } => {
                let (wi, distance) = toward(point, *position)?;
                let cosine = -wi.dot(direction.normalized()?);
                let fade = fade(cosine, outer.cos(), inner.cos());
                let incident = *intensity * (fade * falloff.at(distance));
                (fade > 0.0).then_some(LightSample {
                    wi,
                    distance,
                    incident,
                })
            }
        }
    }
}

fn toward(from: Point3, to: Point3) -> Option<(Vector3, f32)> {
    let way = to - from;
    Some((way.normalized()?, way.length()))
}

/// 0 below `start`, 1 from `end` on, a smooth cubic in between; a step at `start` where `end` is not
/// above it.
fn fade(x: f32, start: f32, end: f32) -> f32 {
    if x < start {
        return 0.0;
    }
    if x >= end {
        return 1.0;
    }
    let s = ((x - start) / (end - start)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_light_falls_off_with_the_square_if_asked() {
        let position = Point3::new(0.0, 2.0, 0.0);
        let light = |falloff| Light::Point {
            position,
            intensity: Rgb::WHITE,
            falloff,
        };
        let incident = |falloff| light(falloff).sample_li(Point3::ORIGIN).unwrap().incident;
        assert_eq!(incident(Falloff::None), Rgb::WHITE);
        assert_eq!(incident(Falloff::InverseSquare), Rgb::grey(0.25));
        assert_eq!(light(Falloff::None).sample_li(position), None);
    }

    #[test]
    fn a_spot_lights_its_cone_only() {
        let spot = |outer: f32| Light::Spot {
            position: Point3::new(0.0, 1.0, 0.0),
            direction: -Vector3::Y,
            inner: Angle::from_degrees(10.0),
            outer: Angle::from_degrees(outer),
            intensity: Rgb::WHITE,
            falloff: Falloff::None,
        };
        let below = Point3::ORIGIN;
        let aside = Point3::new(0.5, 0.0, 0.0);
        assert_eq!(spot(20.0).sample_li(below).unwrap().incident, Rgb::WHITE);
        assert_eq!(spot(20.0).sample_li(aside), None);
        assert!(spot(40.0).sample_li(aside).unwrap().incident.r > 0.0);
        assert_eq!(spot(10.0).sample_li(aside), None);
        assert_eq!(spot(5.0).sample_li(aside), None, "outer below inner");
        assert_eq!(spot(5.0).sample_li(below).unwrap().incident, Rgb::WHITE);
    }
}
