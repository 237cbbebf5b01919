//! What eight numbers in two fours do together.

use super::super::super::super::node::Child;
use super::super::Lanes;
use super::{Four, HalvesWide, Words};

/// The first four and the last four.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halves<F>(pub(super) [F; 2]);

/// The bit of each lane.
const BIT: [[u32; 4]; 2] = [[1, 2, 4, 8], [16, 32, 64, 128]];

/// Where each of eight fields of three bits begins.
const FIELD: [[u32; 4]; 2] = [[0, 3, 6, 9], [12, 15, 18, 21]];

/// For each mask of eight bits the places of those that are set, one after the other, in fields of
/// three bits: written as a node's [order](super::super::super::super::node::Node::order) is, so that
/// both are read in the same way.
const COMPRESSED: [u32; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut k, mut count) = (0, 0);
        while k < 8 {
            if mask >> k & 1 == 1 {
                table[mask] |= k << (3 * count);
                count += 1;
            }
            k += 1;
        }
        mask += 1;
    }
    table
};

/// Bit k: whether lane k is set. There is no instruction that gathers them, but one that adds: so each
/// lane keeps its own bit.
///
/// # Safety
/// - The processor has the instructions of `W`; so for all functions here.
#[inline(always)]
pub(super) unsafe fn mask<W: Words>(lanes: [W; 2]) -> u32 {
    // SAFETY: the caller's promise.
    unsafe {
        let first = lanes[0].and(W::load(BIT[0].as_ptr()));
        let last = lanes[1].and(W::load(BIT[1].as_ptr()));
        first.or(last).sum()
    }
}

/// Which bytes of eight words make the words at eight places, given as fields of three bits.
///
/// # Safety
/// - As above.
#[inline(always)]
unsafe fn places<W: Words>(order: u32) -> [W; 2] {
    // SAFETY: as above.
    unsafe {
        let order = W::splat(order);
        [
            bytes(order.shifted_right(W::load(FIELD[0].as_ptr()))),
            bytes(order.shifted_right(W::load(FIELD[1].as_ptr()))),
        ]
    }
}

/// The bytes of the words at the places that the lowest three bits say.
///
/// # Safety
/// - As above.
#[inline(always)]
unsafe fn bytes<W: Words>(places: W) -> W {
    // SAFETY: as above. Word k begins at byte 4 k.
    unsafe {
        let each = W::splat(u32::from_ne_bytes([0, 1, 2, 3]));
        let four = W::splat(u32::from_ne_bytes([4; 4]));
        places.and(W::splat(7)).multiply_add(four, each)
    }
}

/// Of eight words those at places.
///
/// # Safety
/// - As above.
#[inline(always)]
unsafe fn picked<W: Words>(of: [W; 2], places: [W; 2]) -> [W; 2] {
    // SAFETY: as above.
    unsafe { [places[0].bytes_of(of), places[1].bytes_of(of)] }
}

/// Eight words from memory.
///
/// # Safety
/// - As above; and they may be read there.
#[inline(always)]
unsafe fn load<W: Words>(from: *const Child) -> [W; 2] {
    // SAFETY: the caller's promise; a child is a word.
    unsafe {
        let from = from.cast();
        [W::load(from), W::load(from.add(4))]
    }
}

/// Eight words to memory.
///
/// # Safety
/// - As above; and they may be written there.
#[inline(always)]
unsafe fn store<W: Words, T>(words: [W; 2], to: *mut T) {
    const { assert!(size_of::<T>() == size_of::<u32>()) };
    // SAFETY: the caller's promise.
    unsafe {
        let to = to.cast();
        words[0].store(to);
        words[1].store(to.add(4));
    }
}

impl<F: Four> Halves<F> {
    /// All bits set where a number is not above the other one.
    ///
    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn not_above(self, other: Self) -> [F::Words; 2] {
        // SAFETY: the caller's promise.
        unsafe { [self.0[0].at_most(other.0[0]), self.0[1].at_most(other.0[1])] }
    }

    /// # Safety
    /// - As above.
    #[inline(always)]
    unsafe fn bits(self) -> [F::Words; 2] {
        // SAFETY: the caller's promise.
        unsafe { [self.0[0].bits(), self.0[1].bits()] }
    }
}

/// Functions that do to each half what they are called after.
macro_rules! half_by_half {
    ($($name:ident)*) => {
        $(
            #[inline(always)]
            unsafe fn $name(self, other: Self) -> Self {
                // SAFETY: the caller's promise.
                unsafe { Self([self.0[0].$name(other.0[0]), self.0[1].$name(other.0[1])]) }
            }
        )*
    };
}

impl<F: Four> Lanes for Halves<F> {
    type Wide = HalvesWide<F>;

    half_by_half!(minus times over smaller larger);

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's promise; so everywhere below.
        Self(unsafe { [F::splat(x); 2] })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { [F::load(from), F::load(from.add(4))] })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: as above.
        unsafe {
            self.0[0].store(to);
            self.0[1].store(to.add(4));
        }
    }

    #[inline(always)]
    unsafe fn store_where(self, bits: u32, to: *mut f32) {
        // SAFETY: as above. What is not chosen is written as it was read.
        unsafe {
            let (bits, old) = (F::Words::splat(bits), Self::load(to));
            let first = bits.meets(F::Words::load(BIT[0].as_ptr()));
            let last = bits.meets(F::Words::load(BIT[1].as_ptr()));
            self.0[0].where_set(first, old.0[0]).store(to);
            self.0[1].where_set(last, old.0[1]).store(to.add(4));
        }
    }

    #[inline(always)]
    unsafe fn multiply_add(self, factor: Self, addend: Self) -> Self {
        // SAFETY: as above.
        unsafe {
            Self([
                self.0[0].multiply_add(factor.0[0], addend.0[0]),
                self.0[1].multiply_add(factor.0[1], addend.0[1]),
            ])
        }
    }

    #[inline(always)]
    unsafe fn at_most(self, other: Self) -> u32 {
        // SAFETY: as above.
        unsafe { mask(self.not_above(other)) }
    }

    #[inline(always)]
    unsafe fn push(
        self,
        far: Self,
        order: u32,
        children: *const Child,
        to: *mut Child,
        entries: *mut f32,
    ) -> u32 {
        // SAFETY: as above.
        unsafe {
            let places = places(order);
            let entered = mask(picked(self.not_above(far), places));
            let near = picked(self.bits(), places);
            let children = picked(load(children), places);
            let kept = self::places(COMPRESSED[entered as usize & 255]);
            store(picked(near, kept), entries);
            store(picked(children, kept), to);
            entered
        }
    }

    #[inline(always)]
    unsafe fn push_unordered(self, far: Self, children: *const Child, to: *mut Child) -> u32 {
        // SAFETY: as above.
        unsafe {
            let entered = self.at_most(far);
            let children: [F::Words; 2] = load(children);
            let kept = places(COMPRESSED[entered as usize & 255]);
            store(picked(children, kept), to);
            entered
        }
    }

    #[inline(always)]
    unsafe fn keep(children: *mut Child, entries: *mut f32, count: usize, t_max: f32) -> usize {
        // SAFETY: as above. What is written begins at or before what was read, so nothing that is
        // still to be read is written over.
        unsafe {
            let t_max = Self::splat(t_max);
            let (mut from, mut kept) = (0, 0);
            while from < count {
                let near = Self::load(entries.add(from));
                let what: [F::Words; 2] = load(children.add(from));
                let there = (1 << (count - from).min(8)) - 1;
                let near_enough = near.at_most(t_max) & there;
                let places = places(COMPRESSED[near_enough as usize & 255]);
                store(picked(near.bits(), places), entries.add(kept));
                store(picked(what, places), children.add(kept));
                kept += near_enough.count_ones() as usize;
                from += 8;
            }
            kept
        }
    }
}
