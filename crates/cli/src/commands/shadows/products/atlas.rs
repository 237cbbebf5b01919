//! Many small pictures on few large ones.

use ombra::formats::GlbTexture;

/// No page is wider, since few graphics processors take more.
pub(super) const MOST: u32 = 8192;

/// Where a picture lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Slot {
    pub(super) page: usize,
    /// Of its upper left corner.
    pub(super) at: [u32; 2],
}

/// Large pictures with small ones on them, none on another.
pub(super) struct Atlas {
    pub(super) pages: Vec<GlbTexture>,
    /// Of the small ones, in the order in which they were given.
    pub(super) slots: Vec<Slot>,
}

impl Atlas {
    /// For pictures of so many columns and rows, none of them more than [`MOST`]. They stand on shelves, the tallest first.
    pub(super) fn new(sizes: &[[u32; 2]], blank: [u8; 3]) -> Self {
        let pixels: f64 = sizes
            .iter()
            .map(|size| f64::from(size[0]) * f64::from(size[1]))
            .sum();
        let longest = sizes.iter().flatten().copied().max().unwrap_or(1);
        // Shelves waste some.
        let wanted = (1.25 * pixels).sqrt() as u32;
        let side = wanted.max(longest).max(16).next_power_of_two().min(MOST);
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by_key(|&index| std::cmp::Reverse(sizes[index][1]));
        let mut slots = vec![
            Slot {
                page: 0,
                at: [0, 0]
            };
            sizes.len()
        ];
        let (mut page, mut left, mut top, mut shelf) = (0, 0, 0, 0);
        let mut heights = Vec::new();
        for index in order {
            let [width, height] = sizes[index];
            if left + width > side {
                (left, top, shelf) = (0, top + shelf, 0);
            }
            if top + height > side {
                heights.push(top);
                (page, left, top, shelf) = (page + 1, 0, 0, 0);
            }
            slots[index] = Slot {
                page,
                at: [left, top],
            };
            left += width;
            shelf = shelf.max(height);
        }
        heights.push(top + shelf);
        let pages = heights.into_iter().map(|height| GlbTexture {
            width: side,
            pixels: vec![blank; side as usize * height.max(1) as usize],
        });
        Self {
            pages: pages.collect(),
            slots,
        }
    }

    /// Colours a pixel of a small picture.
    pub(super) fn set(&mut self, picture: usize, [x, y]: [u32; 2], colour: [u8; 3]) {
        let Slot { page, at } = self.slots[picture];
        let page = &mut self.pages[page];
        page.pixels[((at[1] + y) * page.width + at[0] + x) as usize] = colour;
    }

    /// The texture coordinates of a place on a small picture, in pixels from its upper left corner.
    pub(super) fn texcoord(&self, picture: usize, size: [u32; 2], at: [f64; 2]) -> [f32; 2] {
        /// So far from its edge, so that rounding does not show the neighbour.
        const EDGE: f64 = 0.02;
        let slot = self.slots[picture];
        let page = &self.pages[slot.page];
        let all = [page.width as usize, page.pixels.len() / page.width as usize];
        [0, 1].map(|k| {
            let within = at[k].clamp(EDGE, f64::from(size[k]) - EDGE);
            ((f64::from(slot.at[k]) + within) / all[k] as f64) as f32
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_picture_lies_on_another_or_beyond_its_page() {
        let sizes: Vec<[u32; 2]> = (0..300)
            .map(|k| [1 + k * 37 % 60, 1 + k * 91 % 45])
            .collect();
        for sizes in [
            &sizes[..],
            &sizes[..1],
            &[],
            &[[1, 1]; 5],
            &[[MOST, 1], [1, MOST], [MOST, MOST]],
        ] {
            let mut atlas = Atlas::new(sizes, [0; 3]);
            for (index, size) in sizes.iter().enumerate() {
                let name = [1 + (index / 250) as u8, (index % 250) as u8, 7];
                for y in 0..size[1] {
                    (0..size[0]).for_each(|x| atlas.set(index, [x, y], name));
                }
            }
            let coloured = atlas.pages.iter().flat_map(|page| &page.pixels);
            let coloured = coloured.filter(|pixel| pixel[2] == 7).count() as u64;
            let all: u64 = sizes
                .iter()
                .map(|size| u64::from(size[0]) * u64::from(size[1]))
                .sum();
            assert_eq!(coloured, all);
        }
    }
}
