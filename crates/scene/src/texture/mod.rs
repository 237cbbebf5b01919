//! Colours that change over a surface.

mod image;
mod picture;
mod wrap;

use std::sync::Arc;

use ombra_geometry::Point3;

use crate::Rgb;

pub use image::Image;
pub use picture::{PictureTexture, UvTransform};
pub use wrap::{Filter, Wrap};

/// A colour for every place of a surface.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Texture {
    /// The same everywhere.
    Constant(Rgb),
    /// Squares of two colours in the object's own x and z, like the floor of a kitchen: walls and
    /// other steep surfaces show stripes.
    Checker {
        /// The colour of the square whose corners are (0, 0) and (size, size), and the other one.
        colours: [Rgb; 2],
        /// The side of a square, in units of the object. Above 0.
        size: f32,
    },
    /// A picture over the surface parameters.
    Picture(PictureTexture),
}

impl Texture {
    /// The colour at a point of the object's space with surface parameters `uv`.
    #[must_use]
    #[inline]
    pub fn at(&self, point: Point3, uv: [f32; 2]) -> Rgb {
        match self {
            Self::Constant(colour) => *colour,
            Self::Checker { colours, size } => {
                // Beyond what an integer holds singles are even.
                let odd = |x: f32| (x / size).floor() as i64 & 1 == 1;
                colours[usize::from(odd(point.x) != odd(point.z))]
            }
            Self::Picture(picture) => picture.at(uv),
        }
    }

    /// Its mean colour, or close to it: what the surface looks like from far away.
    #[must_use]
    pub fn average(&self) -> Rgb {
        match self {
            Self::Constant(colour) => *colour,
            Self::Checker {
                colours: [a, b], ..
            } => a.lerp(*b, 0.5),
            Self::Picture(picture) => picture.average(),
        }
    }
}

impl From<Rgb> for Texture {
    fn from(colour: Rgb) -> Self {
        Self::Constant(colour)
    }
}

impl From<Arc<Image>> for Texture {
    /// The picture repeated in both directions and interpolated between its pixels.
    fn from(image: Arc<Image>) -> Self {
        Self::Picture(PictureTexture::new(image))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checkers_alternate_across_zero_too() {
        let colours = [Rgb::BLACK, Rgb::WHITE];
        let checker = Texture::Checker { colours, size: 2.0 };
        let at = |x, z| checker.at(Point3::new(x, 0.0, z), [0.0; 2]);
        assert_eq!(at(1.0, 1.0), Rgb::BLACK);
        assert_eq!(at(3.0, 1.0), Rgb::WHITE);
        assert_eq!(at(-1.0, 1.0), Rgb::WHITE);
        assert_eq!(at(-1.0, -1.0), Rgb::BLACK);
    }
}
