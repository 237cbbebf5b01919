//! What a picture shows beyond its edges and between its pixels.

/// What is beyond the edges of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture again, every other time mirrored.
    Mirror,
    /// The pixel at the edge.
    Clamp,
}

/// What is between the centres of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// A blend of the nearest ones.
    #[default]
    Linear,
    /// The nearest one.
    Nearest,
}

impl Wrap {
    /// The place within the picture, 0 to 1, that shows at `x`. NaN and infinity are taken as 0.
    #[inline]
    pub(super) fn inside(self, x: f32) -> f32 {
        if !x.is_finite() {
            return 0.0;
        }
        match self {
            Self::Repeat => x.rem_euclid(1.0),
            Self::Mirror => {
                let twice = x.rem_euclid(2.0);
                if twice > 1.0 { 2.0 - twice } else { twice }
            }
            Self::Clamp => x.clamp(0.0, 1.0),
        }
    }
}

/// The two pixels of a row or column that are blended, and the share of the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taps {
    pub(super) first: u32,
    pub(super) second: u32,
    pub(super) share: f32,
}

impl Taps {
    /// Of a place from 0 to 1 among `size` pixels.
    #[inline]
    pub(super) fn of(place: f32, size: u32, wrap: Wrap, filter: Filter) -> Self {
        let last = i64::from(size) - 1;
        let scaled = place * size as f32;
        if filter == Filter::Nearest {
            let nearest = (scaled.floor() as i64).clamp(0, last) as u32;
            return Self {
                first: nearest,
                second: nearest,
                share: 0.0,
            };
        }
        let from_centre = scaled - 0.5;
        let below = from_centre.floor();
        // A mirrored edge has the same pixel on both sides, like a clamped one.
        let pixel = |i: i64| match wrap {
            Wrap::Repeat => i.rem_euclid(last + 1) as u32,
            Wrap::Mirror | Wrap::Clamp => i.clamp(0, last) as u32,
        };
        Self {
            first: pixel(below as i64),
            second: pixel(below as i64 + 1),
            share: from_centre - below,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_wrap_folds_in_its_own_way() {
        let at = |wrap: Wrap| [-0.25, 0.25, 1.25, 2.25].map(|x| wrap.inside(x));
        assert_eq!(at(Wrap::Repeat), [0.75, 0.25, 0.25, 0.25]);
        assert_eq!(at(Wrap::Mirror), [0.25, 0.25, 0.75, 0.25]);
        assert_eq!(at(Wrap::Clamp), [0.0, 0.25, 1.0, 1.0]);
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            assert_eq!([f32::NAN, f32::INFINITY].map(|x| wrap.inside(x)), [0.0; 2]);
            assert!((0.0..=1.0).contains(&wrap.inside(-1e-30)));
        }
    }

    #[test]
    fn edges_blend_with_what_the_wrap_puts_beyond_them() {
        let taps = |wrap| Taps::of(0.0, 4, wrap, Filter::Linear);
        assert_eq!(
            (taps(Wrap::Repeat).first, taps(Wrap::Repeat).second),
            (3, 0)
        );
        assert_eq!((taps(Wrap::Clamp).first, taps(Wrap::Clamp).second), (0, 0));
        assert_eq!(
            (taps(Wrap::Mirror).first, taps(Wrap::Mirror).second),
            (0, 0)
        );
    }

    #[test]
    fn the_nearest_pixel_is_not_blended() {
        for (place, pixel) in [(0.0, 0), (0.24, 0), (0.26, 1), (0.99, 3), (1.0, 3)] {
            let taps = Taps::of(place, 4, Wrap::Repeat, Filter::Nearest);
            assert_eq!((taps.first, taps.second, taps.share), (pixel, pixel, 0.0));
        }
    }
}
