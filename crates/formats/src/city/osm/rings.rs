//! Ways joined to rings.

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
}
