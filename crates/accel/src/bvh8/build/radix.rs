//! Sorting numbers by their upper halves, digit by digit, by many threads.
//!
//! The order is the same for any number of threads: equal ones stay in the order in which they came.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use rayon::prelude::*;

/// Bits of a digit.
const BITS: u32 = 11;
const VALUES: usize = 1 << BITS;
/// Numbers a task.
const TASK: usize = 1 << 16;

/// Sorts by the upper 32 bits.
pub(super) fn sort(numbers: Vec<u64>) -> Vec<u64> {
    let mut to: Vec<AtomicU64> = Vec::new();
    to.resize_with(numbers.len(), AtomicU64::default);
    let mut from: Vec<AtomicU64> = numbers.into_iter().map(AtomicU64::new).collect();
    for shift in [32, 32 + BITS, 32 + 2 * BITS] {
        pass(&from, &to, shift);
        std::mem::swap(&mut from, &mut to);
    }
    from.into_iter().map(AtomicU64::into_inner).collect()
}

/// Copies all in the order of one digit.
///
/// Every place is written once, by the task whose number goes there. Nothing says so to the compiler,
/// but to write and read such atomics takes what plain numbers take.
fn pass(from: &[AtomicU64], to: &[AtomicU64], shift: u32) {
    let digit = |number: u64| (number >> shift) as usize & (VALUES - 1);
    let mut counts: Vec<Vec<u32>> = from
        .par_chunks(TASK)
        .map(|numbers| {
            let mut counts = vec![0; VALUES];
            for number in numbers {
                counts[digit(number.load(Relaxed))] += 1;
            }
            counts
        })
        .collect();
    // Where each task's numbers with each digit begin.
    let mut before = 0;
    for value in 0..VALUES {
        for count in &mut counts {
            (count[value], before) = (before, before + count[value]);
        }
    }
    let tasks = from.par_chunks(TASK).zip(counts);
    tasks.for_each(|(numbers, mut places)| {
        for number in numbers {
            let number = number.load(Relaxed);
            let place = &mut places[digit(number)];
            to[*place as usize].store(number, Relaxed);
            *place += 1;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_sorted_by_their_upper_halves_and_equal_ones_stay_in_order() {
        let mix = |i: u64| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 20;
        for count in [0, 1, 2, 1000, 200_000] {
            let upper = |i: u64| {
                if i.is_multiple_of(3) {
                    mix(i) % 100
                } else {
                    mix(i) >> 12
                }
            };
            let numbers: Vec<u64> = (0..count).map(|i| upper(i) << 32 | i).collect();
            let mut expected = numbers.clone();
            expected.sort_by_key(|number| number >> 32);
            assert!(sort(numbers) == expected, "{count}");
        }
    }
}
