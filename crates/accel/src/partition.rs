//! Bringing part of a list to the front: by a question, or by half.

use ombra_geometry::Axis;

use crate::Bounded;

/// Brings items for which `left` holds to the front and counts them.
pub(crate) fn partition<T>(items: &mut [T], left: impl Fn(&T) -> bool) -> usize {
    let (mut from, mut to) = (0, items.len());
    while from < to {
        if left(&items[from]) {
            from += 1;
        } else {
            to -= 1;
            items.swap(from, to);
        }
    }
    from
}

/// Brings the half with the smaller centres along an axis to the front, of equal centres the
/// primitives with the smaller indices, and counts it.
pub(crate) fn halve(items: &mut [Bounded], axis: Axis) -> usize {
    let middle = items.len() / 2;
    if items.len() < 2 {
        return middle;
    }
    let key = |item: &Bounded| item.bounds.centre()[axis];
    items.select_nth_unstable_by(middle, |a, b| {
        key(a)
            .total_cmp(&key(b))
            .then(a.primitive.cmp(&b.primitive))
    });
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partition_counts_what_it_brings_to_the_front() {
        for list in [vec![], vec![1], vec![2], vec![1, 2, 3, 4, 5, 6, 7]] {
            let mut parted = list.clone();
            let even = partition(&mut parted, |x| x % 2 == 0);
            assert!(parted[..even].iter().all(|x| x % 2 == 0));
            assert!(parted[even..].iter().all(|x| x % 2 == 1));
            parted.sort_unstable();
            assert_eq!(parted, list);
        }
    }
}
