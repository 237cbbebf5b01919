//! Whose shadow places lie in, where that is plain: all along an arc the same.
//!
//! That is by far the most that happens, and it is found for the places of a tile at once. What is not plain, such as an arc in which
//! a building begins to cover the sun, is a matter of cuts, one place after another.

use ombra_city::Facet;

use super::bits::bits;
use super::lanes::{Lanes, Mask as _};
use super::near::{Near, Nears};
use super::stretches::Record;
use crate::cover::JOIN;
use crate::occluder::Occluder;
use crate::tile::{PLACES, Tile};
use crate::way::Way;

/// The owner of what lies in no shadow.
pub(crate) const NOBODY: u32 = Facet::CONTEXT - 1;

/// How much nearer one must be than another one to be called nearer: more than what is rounded.
const NEARER: f32 = 1.0 + 1e-4;

/// Whose shadow each place lies in all along an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Whose {
    /// The nearest, or [`NOBODY`].
    pub(crate) owner: [u32; PLACES],
    /// Bit k: others cover the sun of place k as well.
    pub(crate) shared: u32,
    /// Bit k: of place k it is not plain.
    pub(crate) open: u32,
}

/// A record that is one of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Entry {
    pub(crate) owner: u32,
    /// Which record.
    pub(crate) index: u32,
}

/// For which places one owner covers the arc wholly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    owner: u32,
    whole: u32,
}

/// Whose shadow the places of a tile lie in all along an arc. The entries are all that was found of it, in order.
///
/// # Safety
/// - The processor has the instructions of `P`, which are sixteen; the entries are of records, and these of occluders; the
///   way has the arc.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "what a loop hands to its body")]
pub(super) unsafe fn whose<P: Lanes>(
    occluders: &[Occluder],
    tile: &Tile,
    way: &Way,
    arc: usize,
    records: &[Record],
    entries: &[Entry],
    groups: &mut Vec<Group>,
    nears: &mut Vec<Nears>,
) -> Whose {
    const { assert!(P::COUNT == PLACES) }
    let mut found = Whose {
        owner: [NOBODY; PLACES],
        shared: 0,
        open: 0,
    };
    groups.clear();
    nears.clear();
    // SAFETY: the caller's promise.
    unsafe {
        let (zero, one, join) = (P::splat(0.0), P::splat(1.0), P::splat(JOIN));
        let stretch = |entry: &Entry| {
            let record = records.get_unchecked(entry.index as usize);
            (record.from.as_ptr(), record.to.as_ptr())
        };
        let none = zero.below(zero);
        // How many owners cover all, and the last of these.
        let (mut wholes, mut last_whole, mut partly) = (zero, zero, none);
        for own in entries.chunk_by(|a, b| a.owner == b.owner) {
            let (mut before, mut after, mut some) = (zero, one, none);
            for entry in own {
                let (from, to) = stretch(entry);
                let (from, to) = (P::load(from), P::load(to));
                let covers = from.below(to);
                some = some.or(covers);
                let first = covers.and_not(before.plus(join).below(from));
                let second = covers.and_not(to.plus(join).below(after));
                before = to.larger(before).or_where_not(first, before);
                after = from.smaller(after).or_where_not(second, after);
            }
            let gap = before.plus(join).below(after);
            let whole = some.and_not(gap);
            partly = partly.or(some.and(gap));
            last_whole = P::splat(groups.len() as f32).or_where_not(whole, last_whole);
            wholes = wholes.plus(one.or_where_not(whole, zero));
            groups.push(Group {
                owner: own[0].owner,
                whole: whole.bits(),
            });
        }
        let many = one.below(wholes);
        let mut numbers = [0.0_f32; PLACES];
        last_whole.store(numbers.as_mut_ptr());
        let sole = zero.below(wholes).and_not(many).and_not(partly).bits();
        for place in bits(sole) {
            found.owner[place] = groups[numbers[place] as usize].owner;
        }
        found.open = partly.or(many).bits();
        if found.open == 0 {
            return found;
        }
        for entry in entries {
            let which = records.get_unchecked(entry.index as usize).which as usize;
            let near = Near::<P>::new(occluders.get_unchecked(which), tile, way, arc);
            nears.push(near.store());
        }
        if many.bits() == 0 {
            return found;
        }

        // The nearest when the arc begins and when it ends.
        let nowhere = Near {
            begin: zero,
            end: zero,
            bulge: zero,
        };
        let (mut first, mut last) = (nowhere, nowhere);
        let (mut first_number, mut last_number) = (P::splat(-1.0), P::splat(-1.0));
        let (mut first_to, mut last_from) = (zero, one);
        let nearly = P::splat(1.0 - JOIN);
        let owners = || entries.chunk_by(|a, b| a.owner == b.owner);
        let mut at = nears.iter();
        for (number, own) in owners().enumerate() {
            let number = P::splat(number as f32);
            for (entry, near) in own.iter().zip(&mut at) {
                let (from, to) = stretch(entry);
                let (from, to) = (P::load(from), P::load(to));
                let covers = from.below(to).and(many);
                let begins = covers.and_not(join.below(from));
                let ends = covers.and_not(to.below(nearly));
                let near: Near<P> = near.load();
                let nearer = begins.and(first.begin.below(near.begin));
                first = near.or_where_not(nearer, first);
                first_number = number.or_where_not(nearer, first_number);
                first_to = to.or_where_not(nearer, first_to);
                let nearer = ends.and(last.end.below(near.end));
                last = near.or_where_not(nearer, last);
                last_number = number.or_where_not(nearer, last_number);
                last_from = from.or_where_not(nearer, last_from);
            }
        }
        // One polygon is the nearest all along, or two that meet. Behind one is who is behind at its ends and at those of the arc, which
        // others that cover all of it are; behind two who is so at the ends of all that it covers, since the less near of two is nearer
        // still in between.
        let meet = many.and_not(first_to.plus(join).below(last_from));
        let mut plain = meet.bits();
        let begins = first
            .begin
            .below(last.begin)
            .or(last.begin.below(first.begin));
        let two = begins
            .or(first.end.below(last.end))
            .or(last.end.below(first.end));
        let mut at = nears.iter();
        for (number, own) in owners().enumerate() {
            let number = P::splat(number as f32);
            let others = first_number.below(number).or(number.below(first_number));
            let asked = meet.and(others);
            for (entry, near) in own.iter().zip(&mut at) {
                let (from, to) = stretch(entry);
                let (from, to) = (P::load(from), P::load(to));
                let partly = join.below(from).or(to.below(nearly));
                let covers = from.below(to).and(partly.or(two)).and(asked);
                if covers.bits() & plain == 0 {
                    continue;
                }
                let near: Near<P> = near.load();
                let mut behind = covers;
                for share in [from, to] {
                    let others = first.at(share).smaller(last.at(share));
                    let own = near.at(share).times(P::splat(NEARER));
                    behind = behind.and(own.below(others));
                }
                plain &= !covers.and_not(behind).bits();
            }
        }
        let mut last_numbers = [0.0_f32; PLACES];
        first_number.store(numbers.as_mut_ptr());
        last_number.store(last_numbers.as_mut_ptr());
        for place in bits(plain) {
            let number = numbers[place];
            if number < 0.0 || number.to_bits() != last_numbers[place].to_bits() {
                continue;
            }
            let group = &groups[number as usize];
            if group.whole >> place & 1 == 1 {
                found.owner[place] = group.owner;
                found.shared |= 1 << place;
                found.open &= !(1 << place);
            }
        }
    }
    found
}
