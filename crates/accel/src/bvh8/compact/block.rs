//! The leaves of the compact layout, to the byte.

use arrayvec::ArrayVec;
use ombra_geometry::{Point3, TriangleMesh};

use super::super::node::{Child, MAX_LEAF};

/// Leaves, one after the other, in words of four bytes. Each begins at an even word:
///
/// | words         | holds                                                                       |
/// |---------------|-----------------------------------------------------------------------------|
/// | 1             | T, the number of triangles, in the lowest byte; V, that of corners, in the next |
/// | V             | x of the corners, as bits                                                  |
/// | V             | y                                                                           |
/// | V             | z                                                                           |
/// | T             | the numbers of the triangles                                                |
/// | 3 T bytes     | which corner is the first of each triangle, which the second, which the third |
///
/// Corners that are the same bits are there once, unless there are more than [`SHARED`] all the same:
/// then each triangle has three of its own, all first ones coming before all second ones.
///
/// The first leaf has no triangles. After the last one come [`BEHIND`] words, since walks read more than
/// they need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Blocks {
    words: Vec<u32>,
}

/// The most corners that are looked up by number, as many as two vectors hold.
pub(crate) const SHARED: usize = 16;

/// Words that may be read behind the last leaf: sixteen corners are read where there may be three.
const BEHIND: usize = SHARED;

/// The most words of a leaf: triangles that share nothing.
const MOST: usize = (1 + 9 * MAX_LEAF + MAX_LEAF + 3 * MAX_LEAF / 4).next_multiple_of(2);

/// One leaf before it is put among the others.
pub(super) type Block = ArrayVec<u32, MOST>;

/// Triangles and corners of a leaf, from its first word.
#[inline(always)]
pub(crate) const fn counts(first: u32) -> (usize, usize) {
    ((first & 0xff) as usize, (first >> 8 & 0xff) as usize)
}

/// A leaf of some triangles of a mesh.
pub(super) fn block(mesh: &TriangleMesh, triangles: &[u32]) -> Block {
    let count = triangles.len();
    let all = triangles.iter().map(|&t| mesh.corners(t as usize));
    let all: ArrayVec<[[u32; 3]; 3], MAX_LEAF> = all
        .map(|corners| corners.map(|p: Point3| p.to_array().map(f32::to_bits)))
        .collect();
    let mut corners = ArrayVec::<[u32; 3], { 3 * MAX_LEAF }>::new();
    let mut which = [0_u8; 3 * MAX_LEAF];
    for (k, triangle) in all.iter().enumerate() {
        for (n, corner) in triangle.iter().enumerate() {
            let known = corners.iter().position(|own| own == corner);
            which[n * count + k] = known.unwrap_or(corners.len()) as u8;
            if known.is_none() {
                corners.push(*corner);
            }
        }
    }
    if corners.len() > SHARED {
        corners.clear();
        for n in 0..3 {
            corners.extend(all.iter().map(|triangle| triangle[n]));
        }
        which = std::array::from_fn(|k| k as u8);
    }
    let mut block = Block::new();
    block.push(count as u32 | (corners.len() as u32) << 8);
    for axis in 0..3 {
        block.extend(corners.iter().map(|corner| corner[axis]));
    }
    block.extend(triangles.iter().copied());
    let bytes = which[..3 * count].chunks(4);
    block.extend(bytes.map(|bytes| {
        (0..)
            .zip(bytes)
            .map(|(k, b)| u32::from(*b) << (8 * k))
            .sum()
    }));
    if !block.len().is_multiple_of(2) {
        block.push(0);
    }
    block
}

impl Blocks {
    /// The empty leaf, and room for others of so many words.
    pub(super) fn with_room(words: usize) -> Self {
        let mut blocks = Self {
            words: Vec::with_capacity(2 + words + BEHIND),
        };
        blocks.words.extend([0; 2]);
        blocks
    }

    /// Appends leaves; the first of them is named by how many words come before.
    pub(super) fn append(&mut self, words: &[u32]) {
        self.words.extend(words);
    }

    /// Nothing is appended any more.
    pub(super) fn end(&mut self) {
        self.words.extend([0; BEHIND]);
    }

    pub(crate) const fn words(&self) -> &[u32] {
        self.words.as_slice()
    }

    pub(crate) const fn bytes(&self) -> usize {
        size_of_val(self.words.as_slice())
    }

    /// The numbers of a leaf's triangles.
    pub(crate) fn triangles(&self, leaf: Child) -> ArrayVec<u32, MAX_LEAF> {
        let block = &self.words[leaf.word()..];
        let (triangles, corners) = counts(block[0]);
        block[1 + 3 * corners..][..triangles]
            .iter()
            .copied()
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a triangle as a walk finds them.
    fn corners(block: &[u32], triangle: usize) -> [[f32; 3]; 3] {
        let (triangles, corners) = counts(block[0]);
        let which = 1 + 3 * corners + triangles;
        [0, 1, 2].map(|n| {
            let at = n * triangles + triangle;
            let corner = (block[which + at / 4] >> (8 * (at % 4)) & 0xff) as usize;
            [0, 1, 2].map(|axis| f32::from_bits(block[1 + axis * corners + corner]))
        })
    }

    fn assert_holds(mesh: &TriangleMesh, corners_kept: usize) {
        let triangles: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        let block = block(mesh, &triangles);
        assert_eq!(counts(block[0]), (triangles.len(), corners_kept));
        assert!(block.len().is_multiple_of(2));
        for &k in &triangles {
            let expected = mesh.corners(k as usize).map(Point3::to_array);
            assert_eq!(corners(&block, k as usize), expected);
        }
        let mut blocks = Blocks::with_room(block.len());
        blocks.append(&block);
        blocks.end();
        assert_eq!(blocks.triangles(Child::block(2))[..], triangles);
        assert!(blocks.triangles(Child::EMPTY_BLOCK).is_empty());
    }

    fn point(k: usize) -> Point3 {
        Point3::new(k as f32, (k * k) as f32, -(k as f32))
    }

    #[test]
    fn a_strip_keeps_each_corner_once() {
        for count in 1..=8_u32 {
            let indices = (0..count).map(|k| [k, k + 1, k + 2]).collect();
            let points = (0..count as usize + 2).map(point).collect();
            let mesh = TriangleMesh::new(points, indices).unwrap();
            assert_holds(&mesh, count as usize + 2);
        }
    }

    #[test]
    fn triangles_that_share_nothing_keep_all() {
        for count in 1..=8_u32 {
            let indices = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let points = (0..3 * count as usize).map(point).collect();
            let mesh = TriangleMesh::new(points, indices).unwrap();
            assert_holds(&mesh, 3 * count as usize);
        }
    }

    #[test]
    fn corners_are_the_same_if_their_bits_are() {
        let zero = Point3::new(0.0, 0.0, 0.0);
        let other = Point3::new(-0.0, 0.0, 0.0);
        let points = vec![zero, zero, other];
        let mesh = TriangleMesh::new(points, vec![[0, 1, 2]]).unwrap();
        assert_holds(&mesh, 2);
    }
}
