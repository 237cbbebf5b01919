//! A box cut into equal cells, the lists of what lies in them, and the walk from cell to cell.

use std::ops::{ControlFlow, RangeInclusive};

use ombra_geometry::{Aabb, Axis, Point3};

use crate::Visitor;
use crate::cells::CellRay;

/// A box cut into equal cells.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    min: [f64; 3],
    /// The edges of a cell.
    edge: [f64; 3],
    /// How many cells along each axis: at least 1.
    cells: [u32; 3],
}

impl Lattice {
    /// Cuts a box into about so many cells, as nearly cubes as can be. Along an axis on which the
    /// box is thinner than a cube it is not cut, and the others take its share.
    pub(crate) fn new(bounds: &Aabb<f64>, target: f64) -> Self {
        let extent = bounds.extent().to_array();
        let mut thin_first = [0, 1, 2];
        thin_first.sort_by(|&a, &b| extent[a].total_cmp(&extent[b]));
        let mut cells = [1; 3];
        let mut left = target.max(1.0);
        for (i, &axis) in thin_first.iter().enumerate() {
            let rest = &thin_first[i..];
            let volume: f64 = rest.iter().map(|&k| extent[k]).product();
            let cube_edge = (volume / left).powf(1.0 / rest.len() as f64);
            // A NaN, from a box without extent, becomes 1.
            let count = (extent[axis] / cube_edge).round().max(1.0).min(left);
            cells[axis] = count as u32;
            left /= count;
        }
        Self {
            min: bounds.min.to_vector().to_array(),
            edge: std::array::from_fn(|k| extent[k] / f64::from(cells[k])),
            cells,
        }
    }

    /// The finest such lattice of about `target` cells or fewer in which the boxes are listed at
    /// most `limit` times together. One cell lists each box once, whatever the limit.
    pub(crate) fn fitting<'a>(
        bounds: &Aabb<f64>,
        mut target: f64,
        boxes: impl Iterator<Item = &'a Aabb<f64>> + Clone,
        limit: usize,
    ) -> Self {
        loop {
            let lattice = Self::new(bounds, target);
            let listed = |b| lattice.overlapped(b).iter().map(length).product::<usize>();
            let total = boxes.clone().map(listed).fold(0, usize::saturating_add);
            if total <= limit || lattice.len() == 1 {
                return lattice;
            }
            target *= 0.5;
        }
    }

    /// How many cells there are.
    pub(crate) fn len(&self) -> usize {
        self.cells.iter().map(|&n| n as usize).product()
    }

    /// The cells that a box overlaps: a range along each axis.
    fn overlapped(&self, bounds: &Aabb<f64>) -> [RangeInclusive<u32>; 3] {
        let (min, max) = (bounds.min.to_vector(), bounds.max.to_vector());
        let (min, max) = (min.to_array(), max.to_array());
        std::array::from_fn(|k| self.slice(k, min[k])..=self.slice(k, max[k]))
    }

    /// Which slice of an axis a coordinate lies in; the outermost ones are endless.
    #[inline]
    fn slice(&self, axis: usize, coordinate: f64) -> u32 {
        // The conversion saturates: below 0 is 0.
        let slice = ((coordinate - self.min[axis]) / self.edge[axis]) as u32;
        slice.min(self.cells[axis] - 1)
    }

    #[inline]
    fn plane(&self, axis: usize, index: u32) -> f64 {
        self.min[axis] + f64::from(index) * self.edge[axis]
    }

    /// The box of a cell.
    pub(crate) fn cell_bounds(&self, cell: usize) -> Aabb<f64> {
        let [nx, ny, _] = self.cells.map(|n| n as usize);
        let at = [cell % nx, cell / nx % ny, cell / nx / ny];
        let corner = |further: u32| {
            let [x, y, z] = std::array::from_fn(|k| self.plane(k, at[k] as u32 + further));
            Point3::new(x, y, z)
        };
        Aabb {
            min: corner(0),
            max: corner(1),
        }
    }

    /// Goes through the cells along a part of a ray, near to far, and calls `enter` with each cell
    /// and its part: disjoint parts that make up the whole. Stops after the cell that holds the
    /// visitor's `t_max`.
    ///
    /// Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987: of
    /// the next planes along the three axes, the one that is met first leads to the next cell. As
    /// published, the t of the next plane is found by adding up; here it comes from the plane's
    /// coordinate, so that it is the same from both sides and no error grows.
    #[inline]
    pub(crate) fn walk<V: Visitor>(
        &self,
        ray: &CellRay,
        mut from: f64,
        to: f64,
        visitor: &mut V,
        mut enter: impl FnMut(&mut V, usize, f64, f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut at = [0_u32; 3];
        let mut next = [f64::INFINITY; 3];
        let plane_ahead = |axis: Axis, at: u32| {
            let index = if ray.runs_down(axis) { at } else { at + 1 };
            ray.crossing(axis, self.plane(axis as usize, index))
        };
        for axis in Axis::ALL {
            let k = axis as usize;
            at[k] = self.slice(k, ray.at(axis, from));
            if !ray.is_still(axis) {
                next[k] = plane_ahead(axis, at[k]);
            }
        }
        let row = self.cells[0] as usize;
        let layer = row * self.cells[1] as usize;
        loop {
            visitor.node();
            let axis = first(&next);
            let k = axis as usize;
            let down = ray.runs_down(axis);
            let border = if down { 0 } else { self.cells[k] - 1 };
            let mut until = next[k].max(from);
            let last = at[k] == border || !(until < to);
            if last {
                until = to;
            }
            let cell = at[0] as usize + row * at[1] as usize + layer * at[2] as usize;
            enter(visitor, cell, from, until)?;
            if last || visitor.t_max() < until {
                return ControlFlow::Continue(());
            }
            at[k] = if down { at[k] - 1 } else { at[k] + 1 };
            next[k] = plane_ahead(axis, at[k]);
            from = until;
        }
    }
}

/// The axis of the smallest of three.
#[inline]
fn first(next: &[f64; 3]) -> Axis {
    if next[0] < next[1] {
        if next[0] < next[2] { Axis::X } else { Axis::Z }
    } else if next[1] < next[2] {
        Axis::Y
    } else {
        Axis::Z
    }
}

fn length(range: &RangeInclusive<u32>) -> usize {
    (range.end() - range.start()) as usize + 1
}

/// What lies in the cells of a lattice: one list behind the other, and where each begins.
#[derive(Clone, Debug)]
pub(crate) struct CellLists {
    /// One more than there are cells.
    pub(crate) offsets: Vec<u32>,
    /// Whatever names the boxes had.
    pub(crate) references: Vec<u32>,
}

impl CellLists {
    /// Lists each box, by its name, in every cell that it overlaps: by counting first.
    pub(crate) fn new<'a>(
        lattice: &Lattice,
        boxes: impl Iterator<Item = (u32, &'a Aabb<f64>)> + Clone,
    ) -> Self {
        let mut offsets = vec![0_u32; lattice.len() + 1];
        let each_cell = |bounds: &Aabb<f64>, act: &mut dyn FnMut(usize)| {
            let [xs, ys, zs] = lattice.overlapped(bounds);
            for z in zs {
                for y in ys.clone() {
                    let row = z as usize * lattice.cells[1] as usize + y as usize;
                    for x in xs.clone() {
                        act(row * lattice.cells[0] as usize + x as usize);
                    }
                }
            }
        };
        for (_, bounds) in boxes.clone() {
            each_cell(bounds, &mut |cell| offsets[cell] += 1);
        }
        // Each offset becomes the end of its list and is moved to its beginning as it is filled.
        let mut total = 0;
        for offset in &mut offsets {
            total += *offset;
            *offset = total;
        }
        let mut references = vec![0; total as usize];
        for (name, bounds) in boxes {
            each_cell(bounds, &mut |cell| {
                offsets[cell] -= 1;
                references[offsets[cell] as usize] = name;
            });
        }
        Self {
            offsets,
            references,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(x: f64, y: f64, z: f64) -> Aabb<f64> {
        Aabb::around([Point3::new(0.0, 0.0, 0.0), Point3::new(x, y, z)])
    }

    #[test]
    fn a_cube_is_cut_evenly_and_a_flat_box_only_along_itself() {
        assert_eq!(Lattice::new(&block(2.0, 2.0, 2.0), 1000.0).cells, [10; 3]);
        let flat = Lattice::new(&block(1.0, 1e-6, 1.0), 10_000.0);
        assert_eq!(flat.cells, [100, 1, 100]);
        let line = Lattice::new(&block(1e-9, 1e-9, 5.0), 64.0);
        assert_eq!(line.cells, [1, 1, 64]);
    }

    #[test]
    fn a_box_without_extent_is_one_cell() {
        assert_eq!(Lattice::new(&block(0.0, 0.0, 0.0), 1e6).len(), 1);
        assert_eq!(Lattice::new(&block(1.0, 1.0, 1.0), 0.0).len(), 1);
    }

    #[test]
    fn cells_are_as_many_as_asked_for_within_a_factor() {
        for extent in [(1.0, 2.0, 3.0), (1e-3, 1.0, 1e3), (1e30, 1e30, 1e-30)] {
            let lattice = Lattice::new(&block(extent.0, extent.1, extent.2), 5e4);
            assert!((2e4..1e5).contains(&(lattice.len() as f64)), "{lattice:?}");
        }
    }

    #[test]
    fn boxes_as_large_as_everything_make_the_lattice_coarse() {
        let all = block(1.0, 1.0, 1.0);
        let boxes = vec![all; 100];
        let lattice = Lattice::fitting(&all, 1e6, boxes.iter(), 800);
        assert!(lattice.len() <= 8);
    }

    #[test]
    fn each_box_is_listed_in_the_cells_that_it_overlaps_and_in_no_other() {
        let lattice = Lattice::new(&block(4.0, 4.0, 4.0), 64.0);
        let boxes: Vec<_> = (0..30)
            .map(|i| {
                let at = |k: i32| f64::from(i * k % 37) * 0.1 + 0.013;
                let corner = Point3::new(at(3), at(7), at(11));
                Aabb::around([corner]).padded(0.01 * f64::from(i))
            })
            .collect();
        let lists = CellLists::new(&lattice, (0..).zip(&boxes));
        for cell in 0..lattice.len() {
            let list =
                &lists.references[lists.offsets[cell] as usize..lists.offsets[cell + 1] as usize];
            let bounds = lattice.cell_bounds(cell);
            for (i, b) in boxes.iter().enumerate() {
                let overlaps = !bounds.intersection(*b).is_empty();
                let listed = list.iter().filter(|&&name| name == i as u32).count();
                assert_eq!(listed, usize::from(overlaps), "box {i}, cell {cell}");
            }
        }
    }
}
