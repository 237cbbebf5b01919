//! Ways joined to rings, and courtyards put into their outlines.

use std::collections::HashMap;

/// Joins chains of nodes where they meet. Returns the closed rings, which repeat their first nodes,
/// and how many chains were left open.
pub(super) fn joined(chains: &[&[i64]]) -> (Vec<Vec<i64>>, usize) {
    let mut by_end: HashMap<i64, Vec<usize>> = HashMap::new();
    for (index, chain) in chains.iter().enumerate() {
        if let [first, .., last] = chain {
            by_end.entry(*first).or_default().push(index);
            by_end.entry(*last).or_default().push(index);
        }
    }
    let mut is_used = vec![false; chains.len()];
    let mut rings = Vec::new();
    let mut open = 0;
    for start in 0..chains.len() {
        if std::mem::replace(&mut is_used[start], true) {
            continue;
        }
        let mut ring = chains[start].to_vec();
        while let [first, .., last] = ring[..]
            && first != last
        {
            let ends = by_end.get_mut(&last);
            let next = ends.and_then(|ends| {
                // Each chain is taken out twice at the most, so that this ends soon.
                std::iter::from_fn(|| ends.pop()).find(|&index| !is_used[index])
            });
            let Some(next) = next else { break };
            is_used[next] = true;
            let chain = chains[next];
            if chain.first() == Some(&last) {
                ring.extend(&chain[1..]);
            } else {
                ring.extend(chain.iter().rev().skip(1));
            }
        }
        if ring.len() > 1 && ring.first() == ring.last() {
            rings.push(ring);
        } else {
            open += 1;
        }
    }
    (rings, open)
}

/// Outlines with their courtyards: each a list of rings, the outer one first. Returns how many
/// courtyards lie in none of the outlines.
pub(super) fn polygons(
    outer: Vec<Vec<[f64; 2]>>,
    inner: Vec<Vec<[f64; 2]>>,
) -> (Vec<Vec<Vec<[f64; 2]>>>, usize) {
    let boxes: Vec<_> = outer.iter().map(|ring| around(ring)).collect();
    let mut polygons: Vec<_> = outer.into_iter().map(|ring| vec![ring]).collect();
    let mut stray = 0;
    for ring in inner {
        let owner = (polygons.iter().zip(&boxes)).position(|(polygon, bounds)| {
            // Rings may touch, so that one corner alone decides nothing.
            let within = ring
                .iter()
                .filter(|&&p| (0..2).all(|i| bounds[0][i] <= p[i] && p[i] <= bounds[1][i]));
            let asked = within.take(8);
            let [inside, all] = asked.fold([0, 0], |[inside, all], &p| {
                [inside + usize::from(is_inside(&polygon[0], p)), all + 1]
            });
            all > 0 && 2 * inside >= all
        });
        match owner {
            Some(owner) => polygons[owner].push(ring),
            None => stray += 1,
        }
    }
    (polygons, stray)
}

fn around(ring: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    ring.iter().fold(nothing, |[low, high], p| {
        [
            [low[0].min(p[0]), low[1].min(p[1])],
            [high[0].max(p[0]), high[1].max(p[1])],
        ]
    })
}

/// Whether a ray to the east meets the ring, which repeats its first corner, an odd number of times.
fn is_inside(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    ring.windows(2).fold(false, |inside, edge| {
        let [a, b] = [edge[0], edge[1]];
        if (a[1] > y) == (b[1] > y) {
            return inside;
        }
        let at = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        inside ^ (x < at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_are_joined_whichever_way_they_run() {
        let (rings, open) = joined(&[
            &[1, 2, 3],
            &[5, 4, 3],
            &[5, 1],
            &[7, 8, 9, 7],
            &[10, 11],
            &[],
        ]);
        assert_eq!(rings, [vec![1, 2, 3, 4, 5, 1], vec![7, 8, 9, 7]]);
        assert_eq!(open, 2, "one of two nodes and one of none");
    }

    #[test]
    fn courtyards_are_of_the_outline_around_them() {
        let square = |x: f64, size: f64| {
            let high = x + size;
            vec![[x, x], [high, x], [high, high], [x, high], [x, x]]
        };
        let outer = vec![square(0.0, 4.0), square(10.0, 4.0)];
        let (found, stray) = polygons(outer, vec![square(11.0, 1.0), square(20.0, 1.0)]);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(stray, 1);
    }
}
