//! Polygons with holes, cut into convex pieces of three or four corners.

use std::collections::HashMap;

use earcut::Earcut;

/// A piece: indices into the polygon's corners, counter-clockwise; a triangle repeats its last.
pub(crate) type Piece = [u32; 4];

/// Cuts a polygon (its rings, the outer one first, corners numbered through) into triangles by
/// ear clipping, and joins pairs of them to convex quadrilaterals if `in_pairs`.
pub(crate) fn pieces(rings: &[Vec<[f64; 2]>], in_pairs: bool) -> Vec<Piece> {
    let corners: Vec<[f64; 2]> = rings.iter().flatten().copied().collect();
    let mut holes = Vec::with_capacity(rings.len().saturating_sub(1));
    let mut start = 0;
    for ring in rings.iter().take(rings.len().saturating_sub(1)) {
        start += ring.len() as u32;
        holes.push(start);
    }
    let mut indices: Vec<u32> = Vec::new();
    Earcut::new().earcut(corners.iter().copied(), &holes, &mut indices);
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(indices.len() / 3);
    for &[a, b, c] in indices.as_chunks::<3>().0 {
        let area = turn(&corners, a, b, c);
        if area > 0.0 {
            triangles.push([a, b, c]);
        } else if area < 0.0 {
            triangles.push([a, c, b]);
        }
    }
    if in_pairs {
        paired(&corners, &triangles)
    } else {
        triangles.iter().map(|&[a, b, c]| [a, b, c, c]).collect()
    }
}

/// The area that pieces cover.
pub(crate) fn covered(corners: &[[f64; 2]], pieces: &[Piece]) -> f64 {
    let area = |&[a, b, c, d]: &Piece| turn(corners, a, b, c) + turn(corners, a, c, d);
    pieces.iter().map(area).sum::<f64>() / 2.0
}

/// Twice the area of a triangle; positive when it runs counter-clockwise.
fn turn(corners: &[[f64; 2]], a: u32, b: u32, c: u32) -> f64 {
    let [a, b, c] = [a, b, c].map(|i| corners[i as usize]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Each triangle, from the first, is joined with the free neighbour behind the longest of its edges
/// that leaves a convex whole: long edges between coplanar triangles are what costs most.
fn paired(corners: &[[f64; 2]], triangles: &[[u32; 3]]) -> Vec<Piece> {
    let mut behind = HashMap::new();
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        behind.extend([((a, b), (t, c)), ((b, c), (t, a)), ((c, a), (t, b))]);
    }
    let mut is_used = vec![false; triangles.len()];
    let mut pieces = Vec::with_capacity(triangles.len());
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        if is_used[t] {
            continue;
        }
        is_used[t] = true;
        let candidates = [[a, b, c], [b, c, a], [c, a, b]].map(|[a, b, c]| {
            let &(other, d) = behind.get(&(b, a))?;
            let quad = [a, d, b, c];
            let is_free = !is_used[other] && is_convex(corners, quad);
            is_free.then(|| (length(corners, a, b), other, quad))
        });
        let longest = (candidates.into_iter().flatten()).max_by(|a, b| a.0.total_cmp(&b.0));
        match longest {
            Some((_, other, quad)) => {
                is_used[other] = true;
                pieces.push(quad);
            }
            None => pieces.push([a, b, c, c]),
        }
    }
    pieces
}

/// Whether all corners turn left by more than rounding.
fn is_convex(corners: &[[f64; 2]], [a, b, c, d]: Piece) -> bool {
    [[a, b, c], [b, c, d], [c, d, a], [d, a, b]]
        .into_iter()
        .all(|[a, b, c]| {
            let size = length(corners, a, b) * length(corners, b, c);
            turn(corners, a, b, c) > 1e-6 * size
        })
}

fn length(corners: &[[f64; 2]], a: u32, b: u32) -> f64 {
    let [a, b] = [a, b].map(|i| corners[i as usize]);
    (b[0] - a[0]).hypot(b[1] - a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(rings: &[Vec<[f64; 2]>], pieces: &[Piece]) -> f64 {
        covered(&rings.concat(), pieces)
    }

    #[test]
    fn a_square_is_one_piece_and_an_l_is_two() {
        let square = vec![vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]];
        let found = pieces(&square, true);
        assert_eq!(found.len(), 1);
        assert_eq!(area(&square, &found), 4.0);
        assert_eq!(pieces(&square, false).len(), 2);
        let l = vec![vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ]];
        let found = pieces(&l, true);
        assert_eq!(found.len(), 2);
        assert_eq!(area(&l, &found), 3.0);
    }

    #[test]
    fn holes_stay_open() {
        let court = vec![
            vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
            vec![[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]],
        ];
        let found = pieces(&court, true);
        assert_eq!(area(&court, &found), 12.0);
        assert_eq!(found.len(), 4);
    }

    #[test]
    fn nothing_and_lines_have_no_pieces() {
        assert!(pieces(&[], true).is_empty());
        assert!(pieces(&[vec![]], true).is_empty());
        assert!(pieces(&[vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]], true).is_empty());
    }
}
