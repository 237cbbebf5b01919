//! Memory asked for before it is needed.

/// Asks for the line of the cache at an address: it comes while something else is done. An address of
/// what is not there does no harm.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub fn prefetch(at: *const u8) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    // SAFETY: a prefetch reads nothing that a program can see.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(at.cast()) };
}

/// As on x86-64; there is no stable intrinsic for it.
#[cfg(target_arch = "aarch64")]
#[inline(always)]
pub fn prefetch(at: *const u8) {
    // SAFETY: as on x86-64.
    unsafe {
        std::arch::asm!(
            "prfm pldl1keep, [{}]",
            in(reg) at,
            options(readonly, nostack, preserves_flags),
        );
    }
}

/// Nothing where there is no such instruction.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
#[inline(always)]
pub fn prefetch(_: *const u8) {}
