//! The uniform grid.
//!
//! The idea: cut the scene's box into equal cells, list in each what overlaps it, and go along the
//! ray from cell to cell. To build it is a counting sort; to walk it, one comparison a step. It is
//! at its best where primitives are of one size and evenly spread; a detailed object in a large
//! empty scene falls into a few cells ("teapot in a stadium").
//!
//! Fujimoto, Tanaka, Iwata, "ARTS: Accelerated Ray-Tracing System", IEEE CG&A 6(4), 1986; the walk
//! is that of Amanatides and Woo (see `lattice.rs`). The number of cells is a multiple of the number
//! of primitives, as in Cleary, Wyvill, "Analysis of an Algorithm for Fast Ray Tracing Using Uniform
//! Space Subdivision", The Visual Computer 4(2), 1988; which multiple, in Ize, Shirley, Parker,
//! "Grid Creation Strategies for Efficient Ray Tracing", RT 2007. The lists lie one behind the other
//! in one array: Lagae, Dutré, "Compact, Fast and Robust Grids for Ray Tracing", EGSR 2008.

use std::ops::ControlFlow;

use crate::cells::{Root, padded};
use crate::lattice::{CellLists, Lattice};
use crate::{Bounded, Reach, Structure, TraversalRay, Visitor};

/// Cells a primitive.
const DENSITY: f64 = 8.0;

/// How often, on average, a primitive may be listed. Large primitives make the grid coarser.
const REFERENCES: usize = 16;

/// A uniform grid.
#[derive(Clone, Debug)]
pub struct Grid {
    root: Root,
    lattice: Lattice,
    lists: CellLists,
}

impl Structure for Grid {
    fn build(primitives: &[Bounded], reach: &Reach) -> Self {
        let root = Root::new(reach);
        let boxes = padded(primitives, reach);
        let count = primitives.len();
        let target = if root.can_be_cut() {
            DENSITY * count as f64
        } else {
            1.0
        };
        let limit = count.saturating_mul(REFERENCES).min(u32::MAX as usize);
        let lattice = Lattice::fitting(root.bounds(), target, boxes.iter(), limit);
        let names = primitives.iter().map(|p| p.primitive);
        let lists = CellLists::new(&lattice, names.zip(&boxes));
        Self {
            root,
            lattice,
            lists,
        }
    }

    #[inline]
    fn traverse<V: Visitor>(&self, ray: &TraversalRay, visitor: &mut V) -> ControlFlow<()> {
        let CellLists {
            offsets,
            references,
        } = &self.lists;
        self.root
            .traverse(ray, references, visitor, |ray, visitor| {
                let (enter, exit) = (ray.enter, ray.exit);
                self.lattice
                    .walk(ray, enter, exit, visitor, |visitor, cell, from, to| {
                        let list = offsets[cell] as usize..offsets[cell + 1] as usize;
                        if list.is_empty() {
                            return ControlFlow::Continue(());
                        }
                        visitor.leaf(&references[list], ray.span(from, to))
                    })
            })
    }

    fn bytes(&self) -> usize {
        self.root.bytes()
            + size_of_val(self.lists.offsets.as_slice())
            + size_of_val(self.lists.references.as_slice())
    }
}
