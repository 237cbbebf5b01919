//! A picture laid over a surface.

use std::sync::Arc;

use super::Image;
use super::wrap::{Filter, Wrap};
use crate::Rgb;

/// A picture over the surface parameters: which, where on them, what is beyond its edges and between
/// its pixels, and a colour that it is multiplied by.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureTexture {
    /// The picture. v runs upward on it.
    pub image: Arc<Image>,
    /// What its colours are multiplied by.
    pub factor: Rgb,
    /// What is beyond its left and right edges, and beyond its lower and upper ones.
    pub wrap: [Wrap; 2],
    /// What is between its pixels.
    pub filter: Filter,
    /// Where on the picture a pair of surface parameters is; `None` takes them as they are.
    pub placement: Option<UvTransform>,
}

/// An affine map of surface parameters: two rows that are multiplied by (u, v, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvTransform(pub [[f32; 3]; 2]);

impl UvTransform {
    /// Where a pair of surface parameters comes to lie.
    #[must_use]
    #[inline]
    pub fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        self.0.map(|[a, b, c]| a * u + b * v + c)
    }
}

impl PictureTexture {
    /// The picture as it is, repeated in both directions and interpolated between its pixels.
    #[must_use]
    pub const fn new(image: Arc<Image>) -> Self {
        Self {
            image,
            factor: Rgb::WHITE,
            wrap: [Wrap::Repeat; 2],
            filter: Filter::Linear,
            placement: None,
        }
    }

    /// The colour at surface parameters.
    #[must_use]
    #[inline]
    pub fn at(&self, uv: [f32; 2]) -> Rgb {
        let uv = self.placed(uv);
        self.image.colour_at(uv, self.wrap, self.filter) * self.factor
    }

    /// The opacity of the picture at surface parameters; the factor has no part in it.
    #[must_use]
    #[inline]
    pub fn alpha_at(&self, uv: [f32; 2]) -> f32 {
        let uv = self.placed(uv);
        self.image.alpha_at(uv, self.wrap, self.filter)
    }

    /// The mean colour of the whole picture.
    #[must_use]
    pub fn average(&self) -> Rgb {
        self.image.average() * self.factor
    }

    #[inline]
    fn placed(&self, uv: [f32; 2]) -> [f32; 2] {
        self.placement.map_or(uv, |placement| placement.apply(uv))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_placed_tinted_and_wrapped() {
        let pixels = vec![Rgb::WHITE, Rgb::BLACK];
        let image = Arc::new(Image::new(2, 1, pixels).unwrap());
        let mut texture = PictureTexture::new(image);
        texture.factor = Rgb::new(0.5, 1.0, 0.0);
        texture.filter = Filter::Nearest;
        assert_eq!(texture.at([0.25, 0.5]), texture.factor);
        assert_eq!(texture.at([0.75, 0.5]), Rgb::BLACK);
        texture.placement = Some(UvTransform([[1.0, 0.0, 0.5], [0.0, 1.0, 0.0]]));
        assert_eq!(texture.at([0.75, 0.5]), texture.factor, "repeated");
        texture.wrap[0] = Wrap::Clamp;
        assert_eq!(texture.at([0.75, 0.5]), Rgb::BLACK);
        assert_eq!(texture.average(), Rgb::new(0.25, 0.5, 0.0));
    }
}
