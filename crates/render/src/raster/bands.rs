//! Who is drawn where: what may cover a pixel of a band of rows.

use std::ops::Range;

use ombra_geometry::Point3;
use ombra_geometry::shape::Plane;
use rayon::prelude::*;

use super::facet::Facet;
use super::outline::Cells;
use super::source::{Body, Form, Source};
use super::view::{Horizon, View};
use crate::Crop;

/// Rows of a band: the part of the picture that one thread draws at a time. Its depths fit into the
/// cache of a core.
pub(super) const ROWS: u32 = 8;

/// How many triangles one thread sorts at a time.
const CHUNK: usize = 4096;

/// Names a triangle or a plane of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Item {
    pub(super) object: u32,
    /// Of the geometry, as rays count them.
    pub(super) primitive: u32,
    /// Of the triangles of a shape.
    pub(super) triangle: u32,
}

/// What an item looks like.
#[derive(Clone, Copy, Debug)]
pub(super) enum Drawn {
    Facet(Facet),
    Plane(Horizon),
}

impl Drawn {
    /// An item as the camera sees it; `None` if it does not.
    #[inline]
    pub(super) fn new(item: &Item, source: &Source<'_>, view: &View) -> Option<Self> {
        let mesh = match &source.body {
            Body::Mesh(mesh) => *mesh,
            Body::Shapes(forms) => match &forms[item.primitive as usize] {
                Form::Triangles(mesh) => mesh.as_ref(),
                Form::Endless(plane) => return Self::endless(plane, source, view),
                Form::Nothing => return None,
            },
        };
        let corners = mesh.corners(item.triangle as usize);
        let project = |corner: Point3| {
            let corner = source.camera_from_object.point(corner.wide());
            view.project(corner)
        };
        Facet::new(corners.map(project), view.near()).map(Self::Facet)
    }

    fn endless(plane: &Plane, source: &Source<'_>, view: &View) -> Option<Self> {
        let point = source.camera_from_object.point(plane.point());
        let normal = source.camera_from_object.normal(plane.normal());
        view.horizon(point, normal.to_vector()).map(Self::Plane)
    }

    /// Those of a row of its [`cells`](Self::cells) that it may cover.
    #[inline]
    pub(super) fn columns(&self, row: u32, cells: &Cells, centred: bool) -> Range<u32> {
        match self {
            Self::Facet(facet) => facet.outline().columns(row, cells, centred),
            Self::Plane(_) => cells.columns.clone(),
        }
    }

    /// The box of pixels that it may cover.
    pub(super) fn cells(&self, extent: &Crop, centred: bool) -> Cells {
        match self {
            Self::Facet(facet) => facet.outline().cells(extent, centred),
            Self::Plane(horizon) => {
                let low = [extent.x0, extent.y0].map(f64::from);
                let high = [extent.x1, extent.y1].map(f64::from);
                let (low, high) = horizon.bounds(low, high);
                Cells::around(low, high, extent, centred)
            }
        }
    }
}

/// What is in the picture, band by band.
///
/// Takes 12 bytes for each triangle in the picture and 4 for each band that it is in.
pub(super) struct Bands {
    items: Vec<Item>,
    /// For each band the first of its places in `order`, and the end of the last one.
    begins: Vec<usize>,
    order: Vec<u32>,
    /// How many triangles and planes there are, in the picture or not.
    pub(super) primitives: u64,
}

impl Bands {
    pub(super) fn new(sources: &[Source<'_>], view: &View, extent: &Crop, centred: bool) -> Self {
        let chunks: Vec<(u32, u32, u32, u32)> =
            sources.iter().enumerate().flat_map(chunks).collect();
        let primitives = chunks
            .iter()
            .map(|&(.., from, to)| u64::from(to - from))
            .sum();
        let count = extent.height().div_ceil(ROWS) as usize;
        // In the order of objects and primitives, whatever the number of threads.
        let seen: Vec<(Item, [u32; 2])> = chunks
            .into_par_iter()
            .flat_map_iter(|(object, primitive, from, to)| {
                let source = &sources[object as usize];
                (from..to).filter_map(move |i| {
                    let item = Item {
                        object,
                        // Of a mesh each triangle is a primitive.
                        primitive: if matches!(source.body, Body::Mesh(_)) {
                            i
                        } else {
                            primitive
                        },
                        triangle: i,
                    };
                    let cells = Drawn::new(&item, source, view)?.cells(extent, centred);
                    let bands = [cells.rows.start, cells.rows.end.wrapping_sub(1)];
                    let band = |row: u32| (row - extent.y0) / ROWS;
                    (cells.count() > 0).then(|| (item, bands.map(band)))
                })
            })
            .collect();
        // Counting sort.
        let mut begins = vec![0; count + 1];
        for &(_, [first, last]) in &seen {
            for band in first..=last {
                begins[band as usize + 1] += 1;
            }
        }
        for band in 0..count {
            begins[band + 1] += begins[band];
        }
        let mut order = vec![0; begins[count]];
        let mut ends = begins.clone();
        for (i, &(_, [first, last])) in seen.iter().enumerate() {
            for end in &mut ends[first as usize..=last as usize] {
                order[*end] = i as u32;
                *end += 1;
            }
        }
        Self {
            items: seen.into_iter().map(|(item, _)| item).collect(),
            begins,
            order,
            primitives,
        }
    }

    /// The items of a band by their indices, in order.
    pub(super) fn of(&self, band: usize) -> &[u32] {
        &self.order[self.begins[band]..self.begins[band + 1]]
    }

    pub(super) fn item(&self, index: u32) -> &Item {
        &self.items[index as usize]
    }
}

/// The triangles of an object in handy numbers: object, primitive, from, to.
fn chunks((object, source): (usize, &Source<'_>)) -> Vec<(u32, u32, u32, u32)> {
    let cut = |primitive: usize, count: usize| {
        (0..count).step_by(CHUNK).map(move |from| {
            let to = (from + CHUNK).min(count);
            (object as u32, primitive as u32, from as u32, to as u32)
        })
    };
    match &source.body {
        Body::Mesh(mesh) => cut(0, mesh.triangles().len()).collect(),
        Body::Shapes(forms) => {
            let count = |form: &Form| match form {
                Form::Triangles(mesh) => mesh.triangles().len(),
                Form::Endless(_) => 1,
                Form::Nothing => 0,
            };
            let cut = |(i, form)| cut(i, count(form));
            forms.iter().enumerate().flat_map(cut).collect()
        }
    }
}
