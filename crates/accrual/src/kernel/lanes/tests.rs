//! Every level does to numbers what the portable one does, to the bit.

use super::{Lanes, Mask as _, Pair, Portable};

/// What goes wrong at the edges of the number range, and what does not.
const ODD: [f32; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.1,
    1e-45,
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    -2.5e-20,
];

fn sixteen(seed: &mut u32) -> [f32; 16] {
    std::array::from_fn(|_| {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let word = *seed >> 8;
        if word.is_multiple_of(5) {
            ODD[word as usize / 5 % ODD.len()]
        } else {
            word as f32 / 65_536.0 - 128.0
        }
    })
}

/// Bits, but one NaN is like another: processors differ in those.
fn bits(x: f32) -> u32 {
    if x.is_nan() { u32::MAX } else { x.to_bits() }
}

/// Everything that sixteen lanes can do, done to many numbers.
///
/// # Safety
/// - The processor has the instructions of `L`.
unsafe fn answers<L: Lanes>() -> Vec<u32> {
    assert_eq!(L::COUNT, 16);
    let (mut all, mut seed) = (Vec::new(), 1);
    for _ in 0..2048 {
        let (a, b) = (sixteen(&mut seed), sixteen(&mut seed));
        // SAFETY: the lists have sixteen numbers; the caller's promise.
        unsafe {
            let (x, y) = (L::load(a.as_ptr()), L::load(b.as_ptr()));
            let (m, n) = (x.below(y), y.below(L::splat(1.0)));
            for lanes in [
                L::splat(a[0]),
                x.plus(y),
                x.minus(y),
                x.times(y),
                x.over(y),
                x.root(),
                x.smaller(y),
                x.larger(y),
                x.size(),
                x.or_where_not(m, y),
            ] {
                let mut to = [0.0; 16];
                lanes.store(to.as_mut_ptr());
                all.extend(to.map(bits));
            }
            all.extend([
                m.bits(),
                m.and(n).bits(),
                m.or(n).bits(),
                m.and_not(n).bits(),
            ]);
        }
    }
    all
}

#[test]
fn every_level_does_what_the_portable_one_does() {
    // SAFETY: every processor has this.
    let expected = unsafe { answers::<Pair<Portable>>() };
    #[cfg(target_arch = "x86_64")]
    {
        use ombra_accel::Level;
        let levels = Level::available();
        if levels.contains(&Level::Avx2) {
            // SAFETY: this machine has the level; so below.
            assert_eq!(unsafe { answers::<Pair<super::Avx2>>() }, expected);
        }
        if levels.contains(&Level::Avx512) {
            // SAFETY: as above.
            assert_eq!(unsafe { answers::<super::Avx512>() }, expected);
        }
    }
    assert!(!expected.is_empty());
}
