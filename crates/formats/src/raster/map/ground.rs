//! The map itself: cells as pixels, buildings with an outline.

use super::canvas::{Canvas, Colour};
use super::{INK, LEAST, MOST, MapStyle, Scale, Shades};
use crate::raster::Raster;
use crate::raster::cells::{Blank, Cells};

/// Why a cell has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Empty {
    Building,
    Outside,
}

impl Empty {
    /// Warm greys, which the ramp has nowhere.
    pub(super) const fn colour(self) -> Colour {
        match self {
            Self::Building => [186, 179, 170],
            Self::Outside => [240, 237, 232],
        }
    }
}

pub(super) const OUTLINE: Colour = [112, 104, 96];

/// How tall enlarging may make a map.
const TALL: u32 = 1600;

/// A raster at the size at which it is drawn.
pub(super) struct Ground<'a> {
    cells: Cells<'a>,
    /// Of cells without a value those that lie outside; as many as cells, or none.
    outside: Vec<bool>,
    /// Pixels on the side of a cell.
    zoom: u32,
    metres_per_pixel: f64,
    /// What a value is multiplied by to be minutes.
    minutes: f32,
}

impl<'a> Ground<'a> {
    pub(super) fn new(raster: &Raster<'a>, style: &MapStyle) -> Self {
        let outside = &style.outside;
        let grid = raster.grid();
        let factor = grid.width.max(grid.height).div_ceil(MOST);
        let (cells, outside) = match factor {
            1 => (raster.cells(), outside.clone()),
            // Between sun and shadow there is no mean.
            _ if style.scale.is_of_moment() => (
                raster.cells().middles(factor as usize),
                reduced(outside, grid.width as usize, factor as usize),
            ),
            _ => (
                raster.cells().means(factor as usize, Blank::IfMostAre),
                reduced(outside, grid.width as usize, factor as usize),
            ),
        };
        let (width, height) = (cells.width as u32, cells.height as u32);
        let zoom = LEAST.div_ceil(width).min(TALL / height).max(1);
        Self {
            cells,
            outside,
            zoom,
            metres_per_pixel: grid.cell * f64::from(factor) / f64::from(zoom),
            minutes: raster.unit().minutes(),
        }
    }

    /// Pixels in a row.
    pub(super) fn width(&self) -> u32 {
        self.cells.width as u32 * self.zoom
    }

    /// Rows of pixels.
    pub(super) fn height(&self) -> u32 {
        self.cells.height as u32 * self.zoom
    }

    pub(super) fn metres_per_pixel(&self) -> f64 {
        self.metres_per_pixel
    }

    /// Whether some cell is empty for this reason.
    pub(super) fn has(&self, empty: Empty) -> bool {
        (0..self.cells.values.len()).any(|at| self.empty(at) == Some(empty))
    }

    /// Why a cell has no value, if it has none.
    fn empty(&self, at: usize) -> Option<Empty> {
        let is_outside = self.outside.get(at).copied().unwrap_or(false);
        self.cells.values[at].is_nan().then_some(if is_outside {
            Empty::Outside
        } else {
            Empty::Building
        })
    }

    /// Draws it with its upper left corner at `at`. `darkest` is how many minutes the dark
    /// end of the ramp stands for.
    pub(super) fn draw(&self, canvas: &mut Canvas, at: [u32; 2], darkest: f32, scale: Scale) {
        let [left, top] = at.map(i64::from);
        let shades = Shades::up_to(scale, darkest);
        for (row, values) in self.cells.values.chunks_exact(self.cells.width).enumerate() {
            let y = top + row as i64 * i64::from(self.zoom);
            for (column, &value) in values.iter().enumerate() {
                let x = left + column as i64 * i64::from(self.zoom);
                let at = row * self.cells.width + column;
                let colour = if let Some(empty) = self.empty(at) {
                    empty.colour()
                } else {
                    shades.colour(value * self.minutes)
                };
                canvas.rectangle(x, y, self.zoom, self.zoom, colour);
            }
        }
        self.draw_outlines(canvas, left, top);
        canvas.frame([left, top], [self.width(), self.height()], 1, INK);
    }

    /// Darkens those pixels of buildings that lie next to the open.
    fn draw_outlines(&self, canvas: &mut Canvas, left: i64, top: i64) {
        let zoom = i64::from(self.zoom);
        let line: i64 = if zoom >= 6 { 2 } else { 1 };
        for row in 0..self.cells.height as i64 {
            for column in 0..self.cells.width as i64 {
                if self.is_open(column, row) {
                    continue;
                }
                let all = || (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y)));
                let open = all().filter(|&(x, y)| self.is_open(column + x, row + y));
                for (x, y) in open {
                    // The strip of the cell on that side: its whole side, or only a corner.
                    let strip = |side: i64| match side {
                        -1 => (0, line),
                        0 => (0, zoom),
                        _ => (zoom - line, line),
                    };
                    let ((x, width), (y, height)) = (strip(x), strip(y));
                    let at = [left + column * zoom + x, top + row * zoom + y];
                    canvas.rectangle(at[0], at[1], width as u32, height as u32, OUTLINE);
                }
            }
        }
    }

    /// Whether there is a cell, and it is not in a building.
    fn is_open(&self, column: i64, row: i64) -> bool {
        let at = usize::try_from(column).ok().zip(usize::try_from(row).ok());
        at.is_some_and(|(column, row)| {
            let exists = column < self.cells.width && row < self.cells.height;
            exists && self.empty(row * self.cells.width + column) != Some(Empty::Building)
        })
    }
}

/// Of blocks of `factor` by `factor` cells those in which most lie outside.
fn reduced(outside: &[bool], width: usize, factor: usize) -> Vec<bool> {
    let mut blocks = Vec::new();
    for rows in outside.chunks(width * factor) {
        let mut counts = vec![[0, 0]; width.div_ceil(factor)];
        for row in rows.chunks_exact(width) {
            for (column, &is_outside) in row.iter().enumerate() {
                counts[column / factor][usize::from(is_outside)] += 1;
            }
        }
        blocks.extend(counts.into_iter().map(|[others, outside]| outside > others));
    }
    blocks
}
