//! The list that a builder begins with.

use ombra_geometry::Aabb;
use rayon::prelude::*;

use super::item::Item;
use super::lanes::zeroed_items;
use crate::{Bounded, Primitives};

/// Items a task.
const TASK: usize = 1 << 13;

/// All items, and what is known about them.
#[derive(Debug)]
pub(crate) struct Items {
    pub(crate) list: Vec<Item>,
    /// The box around all boxes.
    pub(crate) bounds: Item,
    /// The box around all centres, twice as large (see [`Item::add_centre`]).
    pub(crate) centres: Item,
    /// Primitives with boxes that are not finite: they have no place in a tree.
    pub(crate) unbounded: Vec<u32>,
}

/// The same of one task.
struct Task {
    kept: usize,
    bounds: Item,
    centres: Item,
    unbounded: Vec<u32>,
}

impl Items {
    /// Of primitives. Those with an empty or NaN box are left out.
    pub(crate) fn of(primitives: &impl Primitives) -> Self {
        let box_of = |place: usize| (primitives.bounds(place as u32), place as u32);
        Self::each(primitives.len(), &box_of)
    }

    /// Of boxes.
    pub(crate) fn bounded(boxes: &[Bounded]) -> Self {
        Self::each(boxes.len(), &|k| (boxes[k].bounds, boxes[k].primitive))
    }

    fn each(count: usize, of: &(impl Fn(usize) -> (Aabb, u32) + Sync)) -> Self {
        let mut list = zeroed_items(count);
        let tasks: Vec<Task> = list
            .par_chunks_mut(TASK)
            .enumerate()
            .map(|(task, items)| Task::new(items, task * TASK, of))
            .collect();
        let mut all = Task::EMPTY;
        for (k, task) in tasks.into_iter().enumerate() {
            let first = k * TASK;
            if all.kept < first {
                list.copy_within(first..first + task.kept, all.kept);
            }
            all.kept += task.kept;
            all.bounds.add(&task.bounds);
            all.centres.add(&task.centres);
            all.unbounded.extend(task.unbounded);
        }
        list.truncate(all.kept);
        Self {
            list,
            bounds: all.bounds,
            centres: all.centres,
            unbounded: all.unbounded,
        }
    }
}

impl Task {
    const EMPTY: Self = Self {
        kept: 0,
        bounds: Item::EMPTY,
        centres: Item::EMPTY,
        unbounded: Vec::new(),
    };

    fn new(items: &mut [Item], first: usize, of: &impl Fn(usize) -> (Aabb, u32)) -> Self {
        let mut task = Self::EMPTY;
        for place in first..first + items.len() {
            let (bounds, primitive) = of(place);
            if bounds.is_empty() {
                continue;
            }
            if !bounds.is_finite() {
                task.unbounded.push(primitive);
                continue;
            }
            let item = Item::new(&bounds, primitive);
            task.bounds.add(&item);
            task.centres.add_centre(&item);
            items[task.kept] = item;
            task.kept += 1;
        }
        task
    }
}
