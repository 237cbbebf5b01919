//! The lecture's loop: for each primitive, for each pixel.

use super::bands::{Bands, Drawn, Item, ROWS};
use super::facet::Fragment;
use super::presence::PresenceTest;
use super::source::Source;
use crate::Crop;
use crate::exposure::Exposure;

/// How much work it was to find what is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Pixels tested for whether a triangle or plane covers them.
    pub coverage_tests: u64,
    /// How often one did.
    pub covered: u64,
    /// How often what covered a pixel was nearer than all before it: how often a rasterizer that
    /// does not put off its shading would have shaded.
    pub nearest: u64,
}

impl Tally {
    pub(super) const fn and(self, other: Self) -> Self {
        Self {
            coverage_tests: self.coverage_tests + other.coverage_tests,
            covered: self.covered + other.covered,
            nearest: self.nearest + other.nearest,
        }
    }
}

/// What is seen in a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    /// Which item of the bands.
    pub(super) item: u32,
    pub(super) fragment: Fragment,
}

/// Some rows of the film with their depths.
pub(super) struct Band {
    /// Its columns and rows in the picture.
    pub(super) cells: Crop,
    places: Vec<[f64; 2]>,
    /// The z-buffer: infinite where nothing is seen yet.
    depths: Vec<f64>,
    nearest: Vec<Option<Nearest>>,
}

impl Band {
    /// One of the bands of a film.
    pub(super) fn new(extent: &Crop, index: usize) -> Self {
        let y0 = extent.y0 + index as u32 * ROWS;
        let cells = Crop {
            y0,
            y1: (y0 + ROWS).min(extent.y1),
            ..*extent
        };
        let count = cells.pixels() as usize;
        Self {
            cells,
            places: vec![[0.0; 2]; count],
            depths: vec![f64::INFINITY; count],
            nearest: vec![None; count],
        }
    }

    /// Finds what is seen at one sample of each pixel. Edge functions are evaluated at the place of
    /// that very sample, so that pixels are covered where rays would go.
    pub(super) fn draw(
        &mut self,
        bands: &Bands,
        index: usize,
        sources: &[Source<'_>],
        test: &PresenceTest<'_>,
    ) -> Tally {
        let exposure = test.exposure;
        let width = self.cells.width() as usize;
        for (i, place) in self.places.iter_mut().enumerate() {
            let (x, y) = (i % width, i / width);
            let pixel = [self.cells.x0 + x as u32, self.cells.y0 + y as u32];
            *place = Exposure::place(pixel, &exposure.sample(pixel, test.sample));
        }
        self.depths.fill(f64::INFINITY);
        self.nearest.fill(None);
        let mut tally = Tally::default();
        for &index in bands.of(index) {
            let item = bands.item(index);
            let source = &sources[item.object as usize];
            if let Some(drawn) = Drawn::new(item, source, test.view) {
                let gaps = (!test.is_whole(item)).then_some((test, item));
                self.primitive(index, &drawn, exposure.is_centred(), gaps, &mut tally);
            }
        }
        tally
    }

    /// One primitive, all pixels that it may cover. Where it may have gaps, each fragment is asked
    /// for before its depth counts.
    fn primitive(
        &mut self,
        item: u32,
        drawn: &Drawn,
        centred: bool,
        gaps: Option<(&PresenceTest<'_>, &Item)>,
        tally: &mut Tally,
    ) {
        let cells = drawn.cells(&self.cells, centred);
        let width = self.cells.width() as usize;
        for y in cells.rows.clone() {
            let row = (y - self.cells.y0) as usize * width;
            let columns = drawn.columns(y, &cells, centred);
            tally.coverage_tests += columns.len() as u64;
            for x in columns {
                let i = row + (x - self.cells.x0) as usize;
                let place = self.places[i];
                let fragment = match drawn {
                    Drawn::Facet(facet) if facet.outline().covers(place) => facet.at(place),
                    Drawn::Facet(_) => None,
                    Drawn::Plane(horizon) => horizon.depth(place).map(|depth| Fragment {
                        depth,
                        weights: [0.0; 2],
                    }),
                };
                let Some(fragment) = fragment else {
                    continue;
                };
                tally.covered += 1;
                // Of equally near ones the first counts, as with rays: items come in that order.
                if fragment.depth < self.depths[i]
                    && gaps.is_none_or(|(test, item)| test.is_there(item, [x, y], &fragment))
                {
                    tally.nearest += 1;
                    self.depths[i] = fragment.depth;
                    self.nearest[i] = Some(Nearest { item, fragment });
                }
            }
        }
    }

    /// What is seen in the pixels of the band, row by row.
    pub(super) fn seen(&self) -> impl Iterator<Item = ([u32; 2], Option<Nearest>)> {
        let width = self.cells.width() as usize;
        self.nearest.iter().enumerate().map(move |(i, &nearest)| {
            let (x, y) = (i % width, i / width);
            (
                [self.cells.x0 + x as u32, self.cells.y0 + y as u32],
                nearest,
            )
        })
    }
}
