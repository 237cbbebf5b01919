//! The way north, which is up: local metres count north along the meridian of the origin.

use super::canvas::Canvas;
use super::text::Face;
use super::{INK, PALE_INK};

/// Pixels that it is wide, at scale 1.
pub(super) const WIDTH: u32 = 28;

/// Draws it with its upper left corner at `x`, `y`: an N, and under it a pointer with a dark and a
/// light half.
pub(super) fn draw(canvas: &mut Canvas, x: i64, y: i64, scale: u32) {
    let middle = x + i64::from(WIDTH * scale / 2);
    Face::body(scale).draw_centred(canvas, middle, y, "N", INK);
    let s = scale as f32;
    let at = |dx: f32, dy: f32| [middle as f32 + dx * s, y as f32 + dy * s];
    let (tip, notch) = (at(0.0, 22.0), at(0.0, 54.0));
    canvas.triangle([tip, notch, at(-13.0, 62.0)], INK);
    canvas.triangle([tip, notch, at(13.0, 62.0)], PALE_INK);
}
