#![cfg_attr(
    target_arch = "x86_64",
    expect(
        unsafe_code,
        reason = "Embree wants denormal numbers flushed on the threads that call it, and only two \
                  instructions can do that"
    )
)]
//! Denormal numbers as zero, for all contestants alike.
//!
//! Embree asks for this on every thread that traces (its manual, "Performance Recommendations").
//! So it is set for everybody while rays are traced on the clock, and for nobody otherwise. That
//! ombra's answers are the same with and without is checked by every run.

/// While this lives, the thread that made it takes denormal numbers for zero and gives zero for them.
#[derive(Debug)]
pub(crate) struct Flushed {
    #[cfg(target_arch = "x86_64")]
    before: u32,
    /// It belongs to one thread.
    _not_send: std::marker::PhantomData<*const ()>,
}

/// Flush to zero, and denormals are zero.
#[cfg(target_arch = "x86_64")]
const FLUSH: u32 = 0x8040;

impl Flushed {
    /// From now on. Nothing on processors other than x86-64, for which there is no Embree here.
    pub(crate) fn on() -> Self {
        #[cfg(target_arch = "x86_64")]
        let before = control();
        #[cfg(target_arch = "x86_64")]
        set_control(before | FLUSH);
        Self {
            #[cfg(target_arch = "x86_64")]
            before,
            _not_send: std::marker::PhantomData,
        }
    }
}

impl Drop for Flushed {
    fn drop(&mut self) {
        #[cfg(target_arch = "x86_64")]
        set_control(self.before);
    }
}

#[cfg(target_arch = "x86_64")]
fn control() -> u32 {
    let mut word = 0_u32;
    // SAFETY: stores the control word to a place of its size that is ours.
    unsafe {
        std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack, preserves_flags));
    }
    word
}

#[cfg(target_arch = "x86_64")]
fn set_control(word: u32) {
    // SAFETY: `word` is what the register held, or that with the two bits that flush denormals; no
    // exception is unmasked. The compiler may assume that denormals are kept, and where it reckons
    // with them ahead of time its result is the one without flushing; no traced number hangs on
    // that, and no memory does.
    unsafe {
        std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack, preserves_flags));
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use std::hint::black_box;

    #[test]
    fn denormals_are_flushed_for_as_long_as_it_lives() {
        let half_of_least = || black_box(f32::MIN_POSITIVE) * black_box(0.5);
        assert!(half_of_least() > 0.0);
        let flushed = Flushed::on();
        let inside = half_of_least();
        drop(flushed);
        assert_eq!(inside, 0.0);
        assert!(half_of_least() > 0.0);
    }
}
