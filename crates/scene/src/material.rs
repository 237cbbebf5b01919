//! Whitted's material: what a surface does with light.

use ombra_geometry::Point3;

use crate::{Rgb, Texture};

/// A material within its scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(pub u32);

impl MaterialId {
    /// For indexing into a slice.
    #[must_use]
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// A surface as Whitted's ray tracer knows it: a local part after Phong, a mirror part, a
/// transparent part, and its own light.
///
/// Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975; Whitted, "An Improved
/// Illumination Model for Shaded Display", CACM 23(6), 1980.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// For messages; need not be unique.
    pub name: String,
    /// How much of the light that arrives is scattered evenly, per colour, 0 to 1. Ambient light
    /// is scattered by the same.
    pub diffuse: Texture,
    /// How bright the highlight of a light is, per colour.
    pub specular: Rgb,
    /// Phong's exponent: how small the highlight is. Above 0.
    pub shininess: f32,
    /// How much of what is seen in the mirror direction is added, per colour, 0 to 1.
    pub reflection: Rgb,
    /// How much of what is seen through the surface is added, per colour, 0 to 1. Shadow rays
    /// pass, dimmed by this.
    pub transmission: Rgb,
    /// The index of refraction on the inner side of the surface, over that on the outer side; 1 does
    /// not bend light. Above 0.
    pub index_of_refraction: f32,
    /// Whether the angle decides between mirror and transparency, after Fresnel: what is not
    /// transmitted is reflected. Otherwise the two parts are as given, whatever the angle.
    pub fresnel: bool,
    /// Light of its own. A surface with any is a light source that is seen as such: it shows this
    /// and nothing else.
    pub emission: Rgb,
}

impl Default for Material {
    /// A light grey, matt surface.
    fn default() -> Self {
        Self {
            name: "default".to_owned(),
            diffuse: Texture::Constant(Rgb::grey(0.8)),
            specular: Rgb::BLACK,
            shininess: 32.0,
            reflection: Rgb::BLACK,
            transmission: Rgb::BLACK,
            index_of_refraction: 1.0,
            fresnel: false,
            emission: Rgb::BLACK,
        }
    }
}

impl Material {
    /// A matt surface of one colour.
    #[must_use]
    pub fn matt(name: impl Into<String>, diffuse: Rgb) -> Self {
        Self {
            name: name.into(),
            diffuse: Texture::Constant(diffuse),
            ..Self::default()
        }
    }

    /// Whether it is a light source.
    #[must_use]
    #[inline]
    pub fn is_light_source(&self) -> bool {
        !self.emission.is_black()
    }

    /// The scattered part at a place of the surface; see [`Texture::at`].
    #[must_use]
    #[inline]
    pub fn diffuse_at(&self, point: Point3, uv: [f32; 2]) -> Rgb {
        self.diffuse.at(point, uv)
    }
}
