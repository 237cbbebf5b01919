//! The map itself: cells as pixels, buildings with an outline.

use super::canvas::{Canvas, Colour};
use super::{INK, LEAST, MOST, Scale, ramp};
use crate::raster::Raster;
use crate::raster::cells::{Blank, Cells};

/// A warm grey, which the ramp has nowhere.
pub(super) const BUILDING: Colour = [186, 179, 170];
pub(super) const OUTLINE: Colour = [112, 104, 96];

/// How tall enlarging may make a map.
const TALL: u32 = 1600;

/// A raster at the size at which it is drawn.
pub(super) struct Ground<'a> {
    cells: Cells<'a>,
    /// Pixels on the side of a cell.
    zoom: u32,
    metres_per_pixel: f64,
    /// What a value is multiplied by to be minutes.
    minutes: f32,
}

impl<'a> Ground<'a> {
    pub(super) fn new(raster: &Raster<'a>) -> Self {
        let grid = raster.grid();
        let factor = grid.width.max(grid.height).div_ceil(MOST);
        let cells = match factor {
            1 => raster.cells(),
            _ => raster.cells().means(factor as usize, Blank::IfMostAre),
        };
        let (width, height) = (cells.width as u32, cells.height as u32);
        let zoom = LEAST.div_ceil(width).min(TALL / height).max(1);
        Self {
            cells,
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

    pub(super) fn has_buildings(&self) -> bool {
        self.cells.values.iter().any(|v| v.is_nan())
    }

    /// Draws it with its upper left corner at `at`. `darkest` is how many minutes the dark
    /// end of the ramp stands for.
    pub(super) fn draw(&self, canvas: &mut Canvas, at: [u32; 2], darkest: f32, scale: Scale) {
        let [left, top] = at.map(i64::from);
        // A table: curves and powers for each cell would take longer than all the rest.
        const SHADES: usize = 1024;
        let ramp: Vec<Colour> = (0..=SHADES)
            .map(|i| ramp::of(scale, i as f32 / SHADES as f32))
            .collect();
        for (row, values) in self.cells.values.chunks_exact(self.cells.width).enumerate() {
            let y = top + row as i64 * i64::from(self.zoom);
            for (column, &value) in values.iter().enumerate() {
                let x = left + column as i64 * i64::from(self.zoom);
                let colour = if value.is_nan() {
                    BUILDING
                } else {
                    let fraction = ramp::along(scale, value * self.minutes / darkest);
                    ramp[(fraction * SHADES as f32).round() as usize]
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

    /// Whether there is a cell that is not in a building.
    fn is_open(&self, column: i64, row: i64) -> bool {
        let at = usize::try_from(column).ok().zip(usize::try_from(row).ok());
        at.is_some_and(|(column, row)| {
            let exists = column < self.cells.width && row < self.cells.height;
            exists && !self.cells.values[row * self.cells.width + column].is_nan()
        })
    }
}
