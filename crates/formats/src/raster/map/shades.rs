//! The colours of a map, for pictures that are no map themselves.

use super::canvas::Colour;
use super::legend::Legend;
use super::{MapStyle, Scale, ramp};

/// A table: curves and powers for each cell would take longer than all the rest.
const SHADES: usize = 1024;

/// The colours in which a map shows minutes.
#[derive(Clone, Debug, PartialEq)]
pub struct Shades {
    scale: Scale,
    top: f32,
    ramp: Vec<Colour>,
}

impl Shades {
    /// As [`map_picture`](super::map_picture) has them for these values, in minutes, with the same style.
    #[must_use]
    pub fn new(minutes: &[f32], style: &MapStyle) -> Self {
        Self::up_to(style.scale, Legend::of(minutes, 1.0, style).top())
    }

    /// With `top` minutes at the dark end.
    pub(super) fn up_to(scale: Scale, top: f32) -> Self {
        let shades = (0..=SHADES).map(|i| ramp::of(scale, i as f32 / SHADES as f32));
        Self {
            scale,
            top,
            ramp: shades.collect(),
        }
    }

    /// The colour (sRGB) of so many minutes.
    #[must_use]
    pub fn colour(&self, minutes: f32) -> [u8; 3] {
        let along = ramp::along(self.scale, minutes / self.top);
        self.ramp[(along * SHADES as f32).round() as usize]
    }

    /// Of the legend: minutes at the dark end.
    #[must_use]
    pub const fn top(&self) -> f32 {
        self.top
    }

    /// What the colours tell.
    #[must_use]
    pub const fn scale(&self) -> Scale {
        self.scale
    }
}
