//! Every level does to eight numbers what the portable one does.

use super::super::super::node::Child;
use super::{Lanes, Level, Portable, WideLanes};

/// What goes wrong at the edges of the number range, and what does not.
const ODD: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    -3.5,
    0.1,
    1e-45,
    -1e-45,
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::MIN,
    16_777_217.0,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    2.5e-20,
];

/// Numbers without a pattern: eights of odd ones.
struct Eights(u32);

impl Eights {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0 >> 8
    }

    fn next(&mut self) -> [f32; 8] {
        std::array::from_fn(|_| {
            let word = self.word();
            if word.is_multiple_of(3) {
                ODD[word as usize / 3 % ODD.len()]
            } else {
                word as f32 / 65_536.0 - 128.0
            }
        })
    }

    /// The numbers from 0 to 7 in some order, three bits each.
    fn order(&mut self) -> u32 {
        let mut order = [0, 1, 2, 3, 4, 5, 6, 7];
        for k in 1..8 {
            order.swap(k, self.word() as usize % (k + 1));
        }
        (0..8).fold(0, |packed, k| packed | order[k] << (3 * k))
    }
}

/// Bits, but one NaN is like another: processors differ in those.
fn bits(x: f32) -> u32 {
    if x.is_nan() { u32::MAX } else { x.to_bits() }
}

fn stored<L: Lanes>(lanes: L) -> [u32; 8] {
    let mut to = [0.0; 8];
    // SAFETY: eight may be written; the processor has the level (see `answers`).
    unsafe { lanes.store(to.as_mut_ptr()) };
    to.map(bits)
}

/// Everything that lanes can do but for `multiply_add`, done to many numbers: what came out.
///
/// # Safety
/// - The processor has the instructions of `L`.
unsafe fn answers<L: Lanes>() -> Vec<Vec<u32>> {
    let mut all = Vec::new();
    let mut eights = Eights(1);
    for round in 0..4096_u32 {
        let (a, b) = (eights.next(), eights.next());
        let order = eights.order();
        // SAFETY: all lists have eight numbers or more.
        unsafe {
            let (x, y) = (L::load(a.as_ptr()), L::load(b.as_ptr()));
            for lanes in [
                L::splat(a[0]),
                x.minus(y),
                x.times(y),
                x.over(y),
                x.smaller(y),
                x.larger(y),
            ] {
                all.push(stored(lanes).to_vec());
            }
            all.push(vec![x.at_most(y), x.at_most(x)]);

            let bytes = order.wrapping_mul(0x9e37_79b1).to_le_bytes();
            let bytes = [bytes, (round.wrapping_mul(0x85eb_ca6b)).to_le_bytes()].concat();
            all.push(stored(L::load_bytes(bytes.as_ptr())).to_vec());
            let sixteen = [a, b].concat();
            let chosen = L::chosen(sixteen.as_ptr(), bytes.as_ptr());
            all.push(stored(chosen).to_vec());

            let mut to = b;
            x.store_where(round % 256, to.as_mut_ptr());
            all.push(to.map(bits).to_vec());

            let children = a.map(|x| Child(x.to_bits()));
            let mut pushed = [Child::NONE; 8];
            let mut entries = [0.0; 8];
            let which = x.push(
                y,
                order,
                children.as_ptr(),
                pushed.as_mut_ptr(),
                entries.as_mut_ptr(),
            );
            let count = which.count_ones() as usize;
            all.push(vec![which]);
            all.push(pushed[..count].iter().map(|child| child.0).collect());
            all.push(entries[..count].iter().map(|x| x.to_bits()).collect());
            let which = x.push_unordered(y, children.as_ptr(), pushed.as_mut_ptr());
            let count = which.count_ones() as usize;
            all.push(vec![which]);
            all.push(pushed[..count].iter().map(|child| child.0).collect());

            let mut entries = [eights.next(), eights.next(), eights.next()].concat();
            let mut children: Vec<_> = (0..24).map(Child).collect();
            let kept = L::keep(
                children.as_mut_ptr(),
                entries.as_mut_ptr(),
                round as usize % 25,
                b[0],
            );
            all.push(children[..kept].iter().map(|child| child.0).collect());
            all.push(entries[..kept].iter().map(|x| x.to_bits()).collect());

            // Products of two have no number range to leave; of eight they do.
            let (p, q) = (L::Wide::of(x), L::Wide::of(y));
            let large = p.times(p).times(p).times(p);
            for wide in [
                p,
                L::Wide::splat(a[0].into()),
                p.plus(q),
                p.minus(q),
                p.times(q),
                p.over(q),
                p.smaller(q),
                p.larger(q),
                large.times(large),
            ] {
                all.push(stored(wide.rounded()).to_vec());
            }
            // What rounding to singles hides.
            let (sum, scaled) = (p.plus(q).minus(p), p.times(q).over(p));
            all.push(vec![
                p.below(q),
                p.below(p),
                sum.below(q),
                q.below(sum),
                scaled.below(q),
                q.below(scaled),
            ]);
        }
    }
    all
}

/// A product is rounded before the sum or not at all.
///
/// # Safety
/// - The processor has the instructions of `L`.
unsafe fn multiplies_and_adds<L: Lanes>() {
    let mut eights = Eights(2);
    for _ in 0..4096 {
        let (a, b, c) = (eights.next(), eights.next(), eights.next());
        // SAFETY: all lists have eight numbers.
        let found = unsafe {
            let (b, c) = (L::load(b.as_ptr()), L::load(c.as_ptr()));
            stored(L::load(a.as_ptr()).multiply_add(b, c))
        };
        for k in 0..8 {
            let (once, twice) = (a[k].mul_add(b[k], c[k]), a[k] * b[k] + c[k]);
            assert!(
                found[k] == bits(once) || found[k] == bits(twice),
                "{:?}: {:x}",
                (a[k], b[k], c[k]),
                found[k]
            );
        }
    }
}

/// Calls a function with the lanes of a level.
macro_rules! at {
    ($level:expr, $function:ident) => {{
        let level: Level = $level;
        // SAFETY: this machine has the level.
        unsafe {
            match level {
                Level::Scalar => $function::<Portable>(),
                #[cfg(debug_assertions)]
                Level::NeonTwin => $function::<super::NeonTwin>(),
                #[cfg(target_arch = "aarch64")]
                Level::Neon => $function::<super::Neon>(),
                #[cfg(target_arch = "x86_64")]
                Level::Avx2 => $function::<super::Avx2>(),
                #[cfg(target_arch = "x86_64")]
                Level::Avx512 => $function::<super::Avx512>(),
            }
        }
    }};
}

#[test]
fn every_level_does_what_the_portable_one_does() {
    let expected = at!(Level::Scalar, answers);
    for level in Level::available() {
        let found = at!(level, answers);
        assert_eq!(found.len(), expected.len());
        for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(found, expected, "{level:?}, answer {i}");
        }
        at!(level, multiplies_and_adds);
    }
}

#[test]
fn the_best_level_is_one_that_has_instructions() {
    assert_eq!(Level::available().last(), Some(&Level::detect()));
    #[cfg(debug_assertions)]
    assert!(Level::detect() > Level::NeonTwin);
}
