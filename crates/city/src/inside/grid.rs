//! Boxes on the ground, found by place.

/// A grid of square cells, each with the boxes that reach into it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grid {
    corner: [f32; 2],
    cells_per_metre: f32,
    size: [usize; 2],
    /// Where each cell's boxes begin in `boxes`; one more than there are cells.
    starts: Vec<u32>,
    boxes: Vec<u32>,
}

/// Boxes may stand in so many cells each, on average: a few large ones among many small ones make
/// the grid coarser, and not the memory large.
const MOST_CELLS_PER_BOX: u64 = 16;

impl Grid {
    /// A grid over boxes given by their lowest and highest corners.
    pub(crate) fn new(boxes: &[[[f32; 2]; 2]]) -> Self {
        let [low, high] = boxes.iter().fold(
            [[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]],
            |[low, high], [a, b]| {
                [
                    [low[0].min(a[0]), low[1].min(a[1])],
                    [high[0].max(b[0]), high[1].max(b[1])],
                ]
            },
        );
        if boxes.is_empty() {
            return Self::default();
        }
        let extent = [high[0] - low[0], high[1] - low[1]];
        // As many cells as boxes, if the extent is square.
        let mut across = (boxes.len() as f32).sqrt().ceil();
        loop {
            let cells_per_metre = across / extent[0].max(extent[1]).max(1e-3);
            let mut grid = Self {
                corner: low,
                cells_per_metre,
                size: extent.map(|e| (e * cells_per_metre) as usize + 1),
                ..Self::default()
            };
            let cells = |&[a, b]: &[[f32; 2]; 2]| {
                let [from, to] = [grid.cell(a), grid.cell(b)];
                ((to[0] - from[0] + 1) * (to[1] - from[1] + 1)) as u64
            };
            let entries: u64 = boxes.iter().map(cells).sum();
            if across <= 1.0 || entries <= MOST_CELLS_PER_BOX * boxes.len() as u64 {
                grid.fill(boxes);
                return grid;
            }
            across = (across / 2.0).floor().max(1.0);
        }
    }

    /// Counted first, then put in place, so that each cell's boxes keep their order.
    fn fill(&mut self, boxes: &[[[f32; 2]; 2]]) {
        let mut starts = vec![0_u32; self.size[0] * self.size[1] + 1];
        for bounds in boxes {
            self.for_cells(bounds, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; starts[starts.len() - 1] as usize];
        for (index, bounds) in boxes.iter().enumerate() {
            self.for_cells(bounds, |cell| {
                entries[next[cell] as usize] = index as u32;
                next[cell] += 1;
            });
        }
        self.starts = starts;
        self.boxes = entries;
    }

    fn for_cells(&self, [a, b]: &[[f32; 2]; 2], mut visit: impl FnMut(usize)) {
        let [from, to] = [self.cell(*a), self.cell(*b)];
        for row in from[1]..=to[1] {
            for column in from[0]..=to[0] {
                visit(row * self.size[0] + column);
            }
        }
    }

    /// The cell of a place in the grid. A cast of a float stops at the ends of its range.
    fn cell(&self, place: [f32; 2]) -> [usize; 2] {
        [0, 1].map(|i| {
            let at = (place[i] - self.corner[i]) * self.cells_per_metre;
            (at as usize).min(self.size[i] - 1)
        })
    }

    /// The boxes near a place, in their order; those that hold it are among them.
    pub(crate) fn near(&self, place: [f32; 2]) -> &[u32] {
        if self.starts.is_empty() || !place.iter().all(|x| x.is_finite()) {
            return &[];
        }
        let [column, row] = self.cell(place);
        let cell = row * self.size[0] + column;
        &self.boxes[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}
