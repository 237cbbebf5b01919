//! Lights: they light, but they are not seen.
//!
//! What is seen is an object with [`Material::emission`](crate::Material::emission);
//! [`Light::Luminous`] lets such an object light others.

use ombra_geometry::{Angle, InstanceId, Point3, Vector3};

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
    /// Shines from a parallelogram, to both sides: each place that is lit sees one of its points, and
    /// each sample of a pixel another one, so that shadows get soft edges. Cook, Porter, Carpenter,
    /// "Distributed Ray Tracing", SIGGRAPH 1984, section 4.3.
    Area {
        /// One of its corners.
        corner: Point3,
        /// From the corner to the next one.
        edge_u: Vector3,
        /// From the corner to the one before.
        edge_v: Vector3,
        /// The colour and strength of the light of all of it, as it arrives at distance 1.
        intensity: Rgb,
        /// How it weakens on its way.
        falloff: Falloff,
    },
    /// Shines from a point within an object: lit is what sees the object in the direction of that
    /// point. Whatever else is met first puts a place into the shade, however transparent it is. The
    /// rule of Heckbert's minimal ray tracing contest, 1987.
    Luminous {
        /// The object.
        object: InstanceId,
        /// The point, the middle of the object as a rule.
        position: Point3,
        /// The colour and strength of the light, as it arrives at distance 1.
        intensity: Rgb,
        /// How it weakens on its way.
        falloff: Falloff,
    },
}

/// How light from a point weakens with the distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Falloff {
    /// Not at all, as in the lecture.
    #[default]
    None,
    /// With the square of the distance, as in the world.
    InverseSquare,
    /// The same, but it fades to nothing at a range: times 1 − (distance / range)⁴ (Khronos Group,
    /// glTF extension `KHR_lights_punctual`, "Range Property").
    InverseSquareWithin {
        /// The distance from which on nothing arrives. Above 0.
        range: f32,
    },
}

impl Falloff {
    fn at(self, distance: f32) -> f32 {
        match self {
            Self::None => 1.0,
            Self::InverseSquare => 1.0 / (distance * distance),
            Self::InverseSquareWithin { range } => {
                let window = 1.0 - (distance / range).powi(4);
                window.max(0.0) / (distance * distance)
            }
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
    /// The object that must be met first in that direction; otherwise nothing may be met before
    /// `distance`.
    pub object: Option<InstanceId>,
}

impl Light {
    /// What arrives at `point`; `None` if nothing does: outside of a cone, or at the light itself.
    ///
    /// `xi` gives two uniform numbers in `[0, 1)`; it is asked only by lights that have an area.
    #[must_use]
    #[inline]
    pub fn sample_li(&self, point: Point3, xi: impl FnOnce() -> [f32; 2]) -> Option<LightSample> {
        match self {
            Self::Point {
                position,
                intensity,
                falloff,
            } => arriving(point, *position, *intensity, *falloff),
            Self::Area {
                corner,
                edge_u,
                edge_v,
                intensity,
                falloff,
            } => {
                let [u, v] = xi();
                let position = *corner + *edge_u * u + *edge_v * v;
                arriving(point, position, *intensity, *falloff)
            }
            Self::Luminous {
                object,
                position,
                intensity,
                falloff,
            } => Some(LightSample {
                object: Some(*object),
                ..arriving(point, *position, *intensity, *falloff)?
            }),
            Self::Directional {
                direction,
                intensity,
            } => Some(LightSample {
                wi: -direction.normalized()?,
                distance: f32::INFINITY,
                incident: *intensity,
                object: None,
            }),
            Self::Spot {
                position,
                direction,
                inner,
                outer,
                intensity,
                falloff,
            } => {
                let arriving = arriving(point, *position, *intensity, *falloff)?;
                let cosine = -arriving.wi.dot(direction.normalized()?);
                let fade = fade(cosine, outer.cos(), inner.cos());
                let incident = arriving.incident * fade;
                (fade > 0.0).then_some(LightSample {
                    incident,
                    ..arriving
                })
            }
        }
    }
}

/// What arrives from a point that shines alike in all directions.
#[inline]
fn arriving(at: Point3, position: Point3, intensity: Rgb, falloff: Falloff) -> Option<LightSample> {
    let way = position - at;
    let distance = way.length();
    Some(LightSample {
        wi: way.normalized()?,
        distance,
        incident: intensity * falloff.at(distance),
        object: None,
    })
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

    fn unused() -> [f32; 2] {
        unreachable!("a light without an area needs no random numbers")
    }

    #[test]
    fn an_area_shines_from_the_point_that_is_asked_for() {
        let light = Light::Area {
            corner: Point3::new(9.0, 9.0, 16.0),
            edge_u: Vector3::X,
            edge_v: Vector3::Y * 2.0,
            intensity: Rgb::WHITE,
            falloff: Falloff::InverseSquare,
        };
        let below = Point3::new(9.5, 9.5, 14.0);
        let sample = light.sample_li(below, || [0.5, 0.25]).unwrap();
        assert_eq!(sample.wi, Vector3::Z);
        assert_eq!(sample.incident, Rgb::grey(0.25));
        assert_eq!(sample.object, None);
    }

    #[test]
    fn the_light_of_an_object_names_it() {
        let light = Light::Luminous {
            object: InstanceId(3),
            position: Point3::new(0.0, 2.0, 0.0),
            intensity: Rgb::WHITE,
            falloff: Falloff::None,
        };
        let sample = light.sample_li(Point3::ORIGIN, unused).unwrap();
        assert_eq!(sample.object, Some(InstanceId(3)));
        assert_eq!((sample.wi, sample.distance), (Vector3::Y, 2.0));
    }

    #[test]
    fn a_point_light_falls_off_with_the_square_if_asked() {
        let position = Point3::new(0.0, 2.0, 0.0);
        let light = |falloff| Light::Point {
            position,
            intensity: Rgb::WHITE,
            falloff,
        };
        let incident = |falloff| {
            light(falloff)
                .sample_li(Point3::ORIGIN, unused)
                .unwrap()
                .incident
        };
        assert_eq!(incident(Falloff::None), Rgb::WHITE);
        assert_eq!(incident(Falloff::InverseSquare), Rgb::grey(0.25));
        let within = |range| incident(Falloff::InverseSquareWithin { range });
        assert_eq!(within(4.0), Rgb::grey(0.25 * 15.0 / 16.0));
        assert_eq!(within(2.0), Rgb::BLACK);
        assert_eq!(within(1.0), Rgb::BLACK);
        assert_eq!(light(Falloff::None).sample_li(position, unused), None);
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
        assert_eq!(
            spot(20.0).sample_li(below, unused).unwrap().incident,
            Rgb::WHITE
        );
        assert_eq!(spot(20.0).sample_li(aside, unused), None);
        assert!(spot(40.0).sample_li(aside, unused).unwrap().incident.r > 0.0);
        assert_eq!(spot(10.0).sample_li(aside, unused), None);
        assert_eq!(
            spot(5.0).sample_li(aside, unused),
            None,
            "outer below inner"
        );
        assert_eq!(
            spot(5.0).sample_li(below, unused).unwrap().incident,
            Rgb::WHITE
        );
    }
}
