//! From metal and roughness to Phong: one formula each.
//!
//! glTF's materials are microfacet ones (section 3.9 and appendix B of the specification); Phong knows
//! a matt part, a highlight and a mirror. What becomes what:
//!
//! - **Highlight**: the mirrored share at right angles, F0 = ((n − 1) / (n + 1))² for what is no metal
//!   (0.04 at n = 1.5) and the base colour for metal. Roughness r is the distribution's width α = r²,
//!   and a Blinn-Phong exponent of 2/α² − 2 is as wide (Walter, Marschner, Li, Torrance, "Microfacet
//!   Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2). About the mirrored ray,
//!   as here, the same highlight needs a quarter of it: (2/α² − 2) / 4.
//! - **Its brightness**: F0 (m + 2) / 2 at exponent m, so that a sharper highlight of the same light is
//!   a brighter one (Lafortune, Willems, "Using the Modified Phong Reflectance Model for Physically
//!   Based Rendering", 1994), but not above 1.
//! - **Metal** has no matt part: it mirrors, the rougher the more blurred. Of that the share (1 − r)²
//!   stays a sharp mirror and the rest counts as matt.

use ombra_scene::Rgb;

/// What Phong needs of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Phong {
    /// What of the base colour is matt.
    pub(super) matt: f32,
    /// What of the base colour is a mirror.
    pub(super) mirror: f32,
    pub(super) specular: Rgb,
    pub(super) shininess: f32,
}

/// Highlights of a higher exponent are smaller than a pixel.
const LARGEST_EXPONENT: f32 = 4096.0;

/// Of a surface whose metal and roughness are from 0 to 1.
pub(super) fn phong(base: Rgb, metal: f32, roughness: f32, index_of_refraction: f32) -> Phong {
    let alpha = (roughness * roughness).max(1e-3);
    let exponent = ((2.0 / (alpha * alpha) - 2.0) / 4.0).clamp(1.0, LARGEST_EXPONENT);
    let ratio = (index_of_refraction - 1.0) / (index_of_refraction + 1.0);
    let mirrored = Rgb::grey(ratio * ratio).lerp(base, metal);
    let bright = mirrored * ((exponent + 2.0) / 2.0);
    let most = bright.max_component();
    let smooth = (1.0 - roughness) * (1.0 - roughness);
    // A mirror image fainter than one step in 256 is not worth its rays.
    let mirror = if metal * smooth > 1.0 / 256.0 {
        metal * smooth
    } else {
        0.0
    };
    Phong {
        matt: 1.0 - mirror,
        mirror,
        specular: if most > 1.0 {
            bright * (1.0 / most)
        } else {
            bright
        },
        shininess: exponent,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rough_surfaces_have_wide_and_faint_highlights() {
        let base = Rgb::new(0.8, 0.4, 0.2);
        let rough = phong(base, 0.0, 1.0, 1.5);
        assert_eq!((rough.shininess, rough.matt, rough.mirror), (1.0, 1.0, 0.0));
        assert!((rough.specular.r - 0.06).abs() < 1e-6, "0.04 times 3/2");
        let mut before = rough;
        for roughness in [0.9, 0.7, 0.5, 0.3, 0.1, 0.0] {
            let next = phong(base, 0.0, roughness, 1.5);
            assert!(next.shininess >= before.shininess && next.specular.r >= before.specular.r);
            assert!(next.specular.max_component() <= 1.0 && next.shininess.is_finite());
            before = next;
        }
    }

    #[test]
    fn metal_mirrors_in_its_colour_and_passes_on_no_more_than_it_gets() {
        let base = Rgb::new(0.8, 0.4, 0.2);
        for roughness in [0.0, 0.3, 0.6, 1.0] {
            for metal in [0.0, 0.5, 1.0] {
                let metal = phong(base, metal, roughness, 1.5);
                assert!((metal.matt + metal.mirror - 1.0).abs() < 1e-6);
            }
        }
        let polished = phong(base, 1.0, 0.0, 1.5);
        assert_eq!((polished.matt, polished.mirror), (0.0, 1.0));
        let highlight = polished.specular;
        assert!((highlight.g / highlight.r - 0.5).abs() < 1e-6);
    }
}
