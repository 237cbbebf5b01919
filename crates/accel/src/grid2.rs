//! The grid in a grid: two levels.
//!
//! The idea: a coarse grid first, and in each of its crowded cells a grid of its own, as fine as
//! what lies in that cell asks for. Empty space is crossed in large steps, and a detailed object in
//! a large scene gets small cells where it stands. Within a cell the walk is that of the uniform
//! grid, over the part of the ray that the cell has.
//!
//! Kalojanov, Billeter, Slusallek, "Two-Level Grids for Ray Tracing on GPUs", Computer Graphics
//! Forum 30(2), 2011, whose densities of the two levels these are; the older and deeper
//! relative: Jevans, Wyvill, "Adaptive Voxel Subdivision for Ray Tracing", Graphics Interface 1989.

use std::ops::ControlFlow;

use ombra_geometry::Aabb;
use rayon::prelude::*;

use crate::cells::{Root, padded};
use crate::lattice::{CellLists, Lattice};
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// Cells of the coarse grid a primitive.
const TOP_DENSITY: f64 = 0.12;

/// Cells of a fine grid a primitive in it.
const DENSITY: f64 = 2.4;

/// A cell with more primitives than this is crowded.
const CROWD: usize = 4;

/// How often, on average, each of the levels may list a primitive.
const REFERENCES: usize = 5;

/// A grid whose crowded cells hold grids.
#[derive(Clone, Debug)]
pub struct Grid2 {
    root: Root,
    top: Lattice,
    cells: Vec<TopCell>,
    grids: Vec<Inner>,
    /// The offsets of all inner grids, one behind the other.
    offsets: Vec<u32>,
    references: Vec<u32>,
}

/// A cell of the coarse grid.
#[derive(Clone, Copy, Debug)]
enum TopCell {
    /// A list: a part of `references`.
    List { first: u32, count: u32 },
    /// The index of an inner grid.
    Grid(u32),
}

/// A grid in a cell.
#[derive(Clone, Debug)]
struct Inner {
    lattice: Lattice,
    /// Where its offsets begin.
    first: usize,
}

impl Structure for Grid2 {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let root = Root::new(reach);
        let boxes = padded(primitives, reach);
        let count = primitives.len();
        // Offsets have 32 bits.
        let addressable = count <= u32::MAX as usize / (REFERENCES * REFERENCES);
        let (target, crowd) = if root.can_be_cut() && addressable {
            (TOP_DENSITY * count as f64, CROWD)
        } else {
            (1.0, usize::MAX)
        };
        let limit = count.saturating_mul(REFERENCES);
        let top = Lattice::fitting(root.bounds(), target, boxes.iter(), limit);
        let lists = CellLists::new(&top, (0..).zip(&boxes));
        let list = |cell: usize| {
            &lists.references[lists.offsets[cell] as usize..lists.offsets[cell + 1] as usize]
        };
        let built: Vec<_> = (0..top.len())
            .into_par_iter()
            .map(|cell| {
                let crowded = list(cell).len() > crowd;
                crowded.then(|| inner(&top.cell_bounds(cell), &boxes, list(cell)))
            })
            .collect();

        let mut grid = Self {
            root,
            top,
            cells: Vec::with_capacity(built.len()),
            grids: Vec::new(),
            offsets: Vec::new(),
            references: Vec::new(),
        };
        for (cell, inner) in built.into_iter().enumerate() {
            grid.push(list(cell), inner);
        }
        for name in &mut grid.references {
            *name = primitives[*name as usize].primitive;
        }
        grid.offsets.shrink_to_fit();
        grid.references.shrink_to_fit();
        grid
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        self.root
            .traverse(ray, &self.references, visitor, |ray, visitor| {
                let (enter, exit) = (ray.enter, ray.exit);
                let show = |visitor: &mut V, list: std::ops::Range<u32>, from, to| {
                    if list.is_empty() {
                        return ControlFlow::Continue(());
                    }
                    let list = &self.references[list.start as usize..list.end as usize];
                    visitor.leaf(list, ray.span(from, to))
                };
                self.top.walk(
                    ray,
                    enter,
                    exit,
                    visitor,
                    |visitor, cell, from, to| match self.cells[cell] {
                        TopCell::List { first, count } => {
                            show(visitor, first..first + count, from, to)
                        }
                        TopCell::Grid(grid) => {
                            let Inner { lattice, first } = &self.grids[grid as usize];
                            let offsets = &self.offsets[*first..];
                            lattice.walk(ray, from, to, visitor, |visitor, cell, from, to| {
                                let list = offsets[cell]..offsets[cell + 1];
                                show(visitor, list, from, to)
                            })
                        }
                    },
                )
            })
    }

    fn bytes(&self) -> usize {
        self.root.bytes()
            + size_of_val(self.cells.as_slice())
            + size_of_val(self.grids.as_slice())
            + size_of_val(self.offsets.as_slice())
            + size_of_val(self.references.as_slice())
    }
}

impl Grid2 {
    /// Appends a cell of the coarse grid.
    fn push(&mut self, list: &[u32], inner: Option<(Lattice, CellLists)>) {
        let base = self.references.len() as u32;
        if let Some((lattice, lists)) = inner {
            self.cells.push(TopCell::Grid(self.grids.len() as u32));
            self.grids.push(Inner {
                lattice,
                first: self.offsets.len(),
            });
            self.offsets
                .extend(lists.offsets.iter().map(|offset| base + offset));
            self.references.extend(lists.references);
        } else {
            self.cells.push(TopCell::List {
                first: base,
                count: list.len() as u32,
            });
            self.references.extend(list);
        }
    }
}

/// The grid of a crowded cell, over the boxes that its list names.
fn inner(bounds: &Aabb<f64>, boxes: &[Aabb<f64>], list: &[u32]) -> (Lattice, CellLists) {
    let listed = list.iter().map(|&i| &boxes[i as usize]);
    let target = DENSITY * list.len() as f64;
    let limit = list.len().saturating_mul(REFERENCES);
    let lattice = Lattice::fitting(bounds, target, listed.clone(), limit);
    let lists = CellLists::new(&lattice, list.iter().copied().zip(listed));
    (lattice, lists)
}
