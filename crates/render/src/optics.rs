//! The laws of reflection and refraction at a smooth surface.
//!
//! Directions `wo` point away from the surface, back to where the viewer is; normals are unit length
//! and on the viewer's side.

use ombra_geometry::{Normal3, Vector3};

/// Where a viewer in direction `wo` sees the mirror image: the angle out is the angle in.
#[must_use]
#[inline]
pub fn reflected(wo: Vector3, normal: Normal3) -> Vector3 {
    (-wo).reflect(normal)
}

/// Where a viewer in direction `wo` looks to through the surface, by Snell's law; `None` at total
/// internal reflection. `eta` is the index of refraction on the viewer's side over that on the other.
///
/// The result has unit length if `wo` has.
#[must_use]
#[inline]
pub fn refracted(wo: Vector3, normal: Normal3, eta: f32) -> Option<Vector3> {
    let cos_i = normal.dot(wo);
    let cos_t = transmitted_cosine(cos_i, eta)?;
    Some(normal.to_vector() * (eta * cos_i - cos_t) - wo * eta)
}

/// How much of unpolarised light is mirrored between two dielectrics, 0 to 1: Fresnel's equations.
/// What is not mirrored is transmitted. `cos_i` is the cosine between the normal and the viewer, and
/// `eta` as for [`refracted`].
#[must_use]
#[inline]
pub fn fresnel(cos_i: f32, eta: f32) -> f32 {
    let cos_i = cos_i.clamp(0.0, 1.0);
    let Some(cos_t) = transmitted_cosine(cos_i, eta) else {
        return 1.0;
    };
    let perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let mirrored = 0.5 * (perpendicular * perpendicular + parallel * parallel);
    // Grazing along a surface that does not bend light: 0 / 0.
    if mirrored.is_nan() { 0.0 } else { mirrored }
}

/// The cosine on the far side, from Snell's law; `None` where there is no far side to reach.
#[inline]
fn transmitted_cosine(cos_i: f32, eta: f32) -> Option<f32> {
    let squared = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    (squared >= 0.0).then(|| squared.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra_geometry::Angle;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    const UP: Normal3 = Vector3::Y.to_normal();

    fn wo(degrees: f32) -> Vector3 {
        let angle = Angle::from_degrees(degrees);
        Vector3::new(-angle.sin(), angle.cos(), 0.0)
    }

    #[test]
    fn light_bends_by_snells_law() {
        for degrees in [0.0, 10.0, 45.0, 80.0, 89.9] {
            for index in [1.0_f32, 1.33, 1.5, 2.4] {
                let d = refracted(wo(degrees), UP, 1.0 / index).unwrap();
                let expected = Angle::from_degrees(degrees).sin() / index;
                assert!((d.x - expected).abs() < 1e-6, "{degrees}° {index}: {d:?}");
                assert!((d.length() - 1.0).abs() < 1e-6 && d.y < 0.0 && d.z == 0.0);
            }
        }
    }

    #[test]
    fn nothing_gets_through_beyond_the_critical_angle() {
        let index = 1.5_f32;
        let critical = (1.0 / index).asin().to_degrees();
        assert!(refracted(wo(critical - 0.05), UP, index).is_some());
        assert!(refracted(wo(critical + 0.05), UP, index).is_none());
        assert_eq!(fresnel(wo(critical + 0.05).y, index), 1.0);
    }

    #[test]
    fn fresnel_gives_what_textbooks_give() {
        // Glass seen straight on: ((n − 1) / (n + 1))².
        assert!((fresnel(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-6);
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-6);
        assert!((fresnel(0.0, 1.0 / 1.5) - 1.0).abs() < 1e-6);
        // Between equals there is no surface.
        for cos in [0.0, 0.3, 1.0] {
            assert!(fresnel(cos, 1.0).abs() < 1e-6);
        }
        // At Brewster's angle only half of the light has anything to mirror.
        let brewster = 1.5_f32.atan();
        let perpendicular = (2.0 * brewster).cos();
        let expected = 0.5 * perpendicular * perpendicular;
        assert!((fresnel(brewster.cos(), 1.0 / 1.5) - expected).abs() < 1e-6);
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            failure_persistence: None,
            rng_seed: RngSeed::Fixed(1),
            ..ProptestConfig::default()
        })]

        #[test]
        fn a_path_reversed_is_a_path(degrees in 0.0_f32..89.0, index in 0.4_f32..2.5) {
            let towards = wo(degrees);
            if let Some(through) = refracted(towards, UP, 1.0 / index) {
                let back = refracted(through, -UP, index).unwrap();
                prop_assert!((back - towards).length() < 2e-3, "{back:?}");
                let there = fresnel(towards.y, 1.0 / index);
                let and_back = fresnel(-through.y, index);
                prop_assert!((there - and_back).abs() < 2e-3);
            }
        }

        #[test]
        fn what_is_mirrored_is_a_share(cos in 0.0_f32..=1.0, eta in 0.2_f32..5.0) {
            prop_assert!((0.0..=1.0).contains(&fresnel(cos, eta)));
        }

        #[test]
        fn a_mirror_keeps_the_angle(degrees in 0.0_f32..90.0) {
            let seen = reflected(wo(degrees), UP);
            prop_assert!((seen - Vector3::new(-wo(degrees).x, wo(degrees).y, 0.0)).length() < 1e-6);
        }
    }
}
