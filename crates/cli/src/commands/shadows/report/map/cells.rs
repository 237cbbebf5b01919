//! The cells of a grid as a picture.

use ombra::city::Grid;

/// Values of the cells of a grid, and the value of the strongest colour.
pub(in super::super) struct Cells<'a> {
    pub(in super::super) grid: &'a Grid,
    /// NaN where there is none.
    pub(in super::super) values: &'a [f32],
    pub(in super::super) most: f32,
}

/// So many colours.
pub(super) const STEPS: u8 = 12;

/// From pale to dark blue: 1 to [`STEPS`].
pub(super) fn colour(step: u8) -> [u8; 3] {
    let share = f64::from(step) / f64::from(STEPS);
    let (pale, dark) = ([214.0, 226.0, 244.0], [24.0, 32.0, 110.0]);
    [0, 1, 2].map(|k| (pale[k] + share * (dark[k] - pale[k])) as u8)
}

/// A PNG of the cells, with nothing where the value is 0 or none.
pub(super) fn picture(cells: &Cells<'_>) -> Vec<u8> {
    let step = |&value: &f32| {
        if !(value > 0.0) {
            return 0;
        }
        let share = (value / cells.most).clamp(0.0, 1.0);
        (share * f32::from(STEPS)).ceil().max(1.0) as u8
    };
    let pixels: Vec<u8> = cells.values.iter().map(step).collect();
    let palette: Vec<u8> = (0..=STEPS).flat_map(colour).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, cells.grid.width, cells.grid.height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette);
    encoder.set_trns(vec![0]);
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&pixels));
    // A list takes all bytes, and there is one for each cell.
    written.expect("a picture in memory is written");
    file
}
