//! Whitted's material: what a surface does with light.

use ombra_geometry::Point3;

use crate::{PictureTexture, Rgb, Texture};

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
    /// How much of what is seen through the surface is added, per colour, 0 to 1. A shadow ray
    /// passes straight through, dimmed by this at every surface, whatever the angle.
    ///
    /// Where light does not get through it is mirrored instead: at total internal reflection all of
    /// this part (see `internal_reflection`), and with `fresnel` the share that the angle decides.
    /// That adds to `reflection`.
    pub transmission: Rgb,
    /// The index of refraction on the inner side of the surface, over that on the outer side; 1 does
    /// not bend light. Above 0.
    pub index_of_refraction: f32,
    /// Whether the angle decides how much of the transparent part is mirrored, after Fresnel, as on
    /// real glass and water. Otherwise all of it goes through, short of total internal reflection.
    pub fresnel: bool,
    /// Whether total internal reflection mirrors what cannot leave, as in nature; otherwise that
    /// light is lost.
    pub internal_reflection: bool,
    /// Light of its own, added to everything else. A surface that has nothing else is a light source
    /// (see [`is_light_source`](Self::is_light_source)).
    pub emission: Rgb,
    /// A picture that `emission` is multiplied by.
    pub emission_picture: Option<PictureTexture>,
    /// How much of light is lost on its way behind the surface, per unit of length and colour, 0 or
    /// more: of what comes the distance d, exp(−absorption · d) is left (Beer's law). Only a ray that
    /// meets the back of this very surface is absorbed: one that meets something else inside is not,
    /// nor are shadow rays.
    pub absorption: Rgb,
    /// Whether only the outer side is there: rays that come from behind pass as if there were
    /// nothing.
    pub one_sided: bool,
    /// Where the surface has holes.
    pub cutout: Option<Cutout>,
}

/// Holes in a surface: it is not there where a picture's opacity is below a bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Cutout {
    /// The picture. Its colours have no part in this.
    pub picture: PictureTexture,
    /// The least opacity at which the surface is there.
    pub cutoff: f32,
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
            internal_reflection: true,
            emission: Rgb::BLACK,
            emission_picture: None,
            absorption: Rgb::BLACK,
            one_sided: false,
            cutout: None,
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

    /// A mirror: nothing but what it reflects.
    #[must_use]
    pub fn mirror(name: impl Into<String>, reflection: Rgb) -> Self {
        Self {
            name: name.into(),
            diffuse: Texture::Constant(Rgb::BLACK),
            reflection,
            ..Self::default()
        }
    }

    /// Clear glass, water or the like: the angle decides what is mirrored and what goes through.
    #[must_use]
    pub fn glass(name: impl Into<String>, index_of_refraction: f32) -> Self {
        Self {
            name: name.into(),
            diffuse: Texture::Constant(Rgb::BLACK),
            transmission: Rgb::WHITE,
            index_of_refraction,
            fresnel: true,
            ..Self::default()
        }
    }

    /// A light source of one colour.
    #[must_use]
    pub fn luminous(name: impl Into<String>, emission: Rgb) -> Self {
        Self {
            name: name.into(),
            diffuse: Texture::Constant(Rgb::BLACK),
            emission,
            ..Self::default()
        }
    }

    /// Whether it is a lamp: it has light of its own and does nothing with that of others. A lamp
    /// hides no light from what is behind it, so that a light can stand within.
    #[must_use]
    #[inline]
    pub fn is_light_source(&self) -> bool {
        !self.emission.is_black()
            && self.specular.is_black()
            && self.reflection.is_black()
            && self.transmission.is_black()
            && matches!(self.diffuse, Texture::Constant(diffuse) if diffuse.is_black())
    }

    /// Its own light at surface parameters.
    #[must_use]
    #[inline]
    pub fn emission_at(&self, uv: [f32; 2]) -> Rgb {
        match &self.emission_picture {
            Some(picture) => self.emission * picture.at(uv),
            None => self.emission,
        }
    }

    /// What is left of light that came this far behind the surface, per colour.
    #[must_use]
    #[inline]
    pub fn left_after(&self, distance: f32) -> Rgb {
        self.absorption
            .to_array()
            .map(|a| (-a * distance).exp())
            .into()
    }

    /// Whether it is there wherever its object is, and from both sides.
    #[must_use]
    #[inline]
    pub const fn is_whole(&self) -> bool {
        !self.one_sided && self.cutout.is_none()
    }

    /// The scattered part at a place of the surface; see [`Texture::at`].
    #[must_use]
    #[inline]
    pub fn diffuse_at(&self, point: Point3, uv: [f32; 2]) -> Rgb {
        self.diffuse.at(point, uv)
    }
}
