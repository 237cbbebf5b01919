//! A picture of a raster that can go into a report: the map, and what one needs to read it.

mod arrow;
mod canvas;
mod ground;
mod legend;
mod ramp;
mod round;
mod scale_bar;
mod shades;
mod text;

#[cfg(test)]
mod tests;

use super::{Raster, Unit};
use crate::image::ImageBuffer;
use canvas::{Canvas, Colour};
use ground::Ground;
use legend::Legend;
use scale_bar::ScaleBar;
pub use shades::Shades;
use text::Face;

const PAPER: Colour = [255; 3];
const INK: Colour = [34, 33, 38];
/// Still 5 : 1 against paper.
const PALE_INK: Colour = [108, 106, 112];

/// Pixels across for the map, the title and the legend, at the least.
const LEAST: u32 = 820;
/// Pixels on the longer side of the map, at the most.
const MOST: u32 = 2240;
/// Pixels between the edge of the picture and what it shows.
const MARGIN: u32 = 40;

/// What the colours of a map tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// From sun, light, to long shadow, dark.
    #[default]
    Shadow,
    /// From shadow that is lost, orange, over none, white, to shadow that is new, blue.
    Change,
    /// Of one moment: 0 is sun and 1 shadow.
    Moment,
    /// Of one moment before and after a change: 0 is sun and 1 shadow both times, 2 shadow that is new, and 3 shadow
    /// that is gone.
    MomentOfChange,
}

impl Scale {
    const fn is_of_moment(self) -> bool {
        matches!(self, Self::Moment | Self::MomentOfChange)
    }
}

/// What a picture of a map says beside the map. Characters that its font lacks (it has those of
/// Europe's Latin alphabets) show as a replacement sign, and what is too long is wrapped, then cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapStyle {
    /// What it shows, in large letters. At most two lines.
    pub title: String,
    /// Date, hours and place. At most two lines.
    pub subtitle: String,
    /// Method and bound, in small letters under the map. At most three lines.
    pub footer: String,
    /// The unit of the legend.
    pub unit: Unit,
    /// What the grey of places without a value is called; "Building" where this is empty.
    pub blank: String,
    /// Of places without a value those that are empty in another way, as they lie outside of what was measured: one for
    /// each cell, or none at all. They are nearly white.
    pub outside: Vec<bool>,
    /// What these are called; "Outside" where this is empty.
    pub outside_name: String,
    /// What the dark end of the legend stands for, in `unit`; more is as dark. `None`, or what is not
    /// more than 0: the largest value, rounded up. Set it where pictures are to be compared.
    pub max: Option<f32>,
    /// What the colours tell.
    pub scale: Scale,
}

/// Draws a raster: light where there is sun, dark where shadow is long, buildings in grey. North is
/// up.
///
/// The picture is 900 to 2400 pixels wide. Small rasters are enlarged by a whole factor to fill it (less
/// if it would be too tall), large ones reduced by averaging until the longer side has 2240 pixels. Write it
/// with [`write_image`](crate::write_image). The same arguments give the same picture.
#[must_use]
pub fn map_picture(raster: &Raster<'_>, style: &MapStyle) -> ImageBuffer {
    let ground = Ground::new(raster, style);
    let legend = Legend::new(raster, style);
    // Letters as large on the page, whether the picture has 900 pixels or 2400.
    let scale = if ground.width() >= 2 * LEAST { 2 } else { 1 };
    let content = ground.width().max(LEAST * scale);
    let [title, body, small] = [Face::title(scale), Face::body(scale), Face::small(scale)];
    let titles = title.lines(&style.title, content, 2);
    let subtitles = body.lines(&style.subtitle, content, 2);
    let footers = small.lines(&style.footer, content, 3);

    let margin = MARGIN * scale;
    let gap = 16 * scale;
    let below_heads = if titles.is_empty() && subtitles.is_empty() {
        0
    } else {
        gap
    };
    // Between the title and what stands under it.
    let lead = if titles.is_empty() { 0 } else { 4 * scale };
    let heads =
        lead + title.height() * titles.len() as u32 + body.height() * subtitles.len() as u32;
    let feet = match footers.len() as u32 {
        0 => 0,
        lines => gap + lines * small.height(),
    };
    let map_top = margin + heads + below_heads;
    let legend_top = map_top + ground.height() + gap + gap / 2;
    let legend_height = legend::HEIGHT * scale;
    let height = legend_top + legend_height + feet + margin;
    let mut canvas = Canvas::new(content + 2 * margin, height, PAPER);

    let mut top = margin;
    for (face, lines) in [(title, &titles), (body, &subtitles)] {
        for line in lines {
            face.draw(&mut canvas, i64::from(margin), i64::from(top), line, INK);
            top += face.height();
        }
        top += lead;
    }
    let map_left = margin + (content - ground.width()) / 2;
    ground.draw(&mut canvas, [map_left, map_top], legend.top(), style.scale);

    let [left, right] = [margin, margin + content].map(i64::from);
    let y = i64::from(legend_top);
    let name = |text: &'static str, own: &str| match own {
        "" => text.to_owned(),
        own => own.to_owned(),
    };
    let (building, outside) = (ground::Empty::Building, ground::Empty::Outside);
    let swatches = [
        (building, name("Building", &style.blank)),
        (outside, name("Outside", &style.outside_name)),
    ];
    let swatches: Vec<_> = (swatches.into_iter())
        .filter(|(empty, _)| ground.has(*empty))
        .map(|(empty, name)| (empty.colour(), name))
        .collect();
    legend.draw(&mut canvas, left, y, scale, &swatches);
    let arrow_left = right - i64::from(arrow::WIDTH * scale);
    arrow::draw(&mut canvas, arrow_left, y, scale);
    let bar = ScaleBar::new(ground.metres_per_pixel(), scale);
    bar.draw(&mut canvas, arrow_left - i64::from(44 * scale), y);

    let mut top = legend_top + legend_height + gap;
    for line in &footers {
        small.draw(&mut canvas, left, i64::from(top), line, PALE_INK);
        top += small.height();
    }
    canvas.into_image()
}
