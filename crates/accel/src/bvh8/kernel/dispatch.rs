//! The kernels compiled once for each level of instructions, and the choice between them.

use ombra_geometry::EdgeRule;

use super::level::{Level, Portable};
#[cfg(target_arch = "x86_64")]
use super::level::{Avx2, Avx512};
use super::ray::SingleRay;
use super::walk::{Any, Closest, Found, Tree, walk};

/// Makes of each kernel one function a level, and one that chooses.
macro_rules! kernels {
    ($($(#[$meta:meta])* fn $name:ident($($argument:ident: $type:ty),*) -> $answer:ty = $body:ident;)*) => {
        $(
            $(#[$meta])*
            #[inline]
            pub(crate) fn $name(level: Level, $($argument: $type),*) -> $answer {
                // SAFETY: a `Level` is only made where the processor has it; trees are whole.
                unsafe {
                    match level {
                        Level::Scalar => scalar::$name($($argument),*),
                        #[cfg(target_arch = "x86_64")]
                        Level::Avx2 => avx2::$name($($argument),*),
                        #[cfg(target_arch = "x86_64")]
                        Level::Avx512 => avx512::$name($($argument),*),
                    }
                }
            }
        )*

        mod scalar {
            use super::*;
            $(
                pub(crate) unsafe fn $name($($argument: $type),*) -> $answer {
                    // SAFETY: every processor has these.
                    unsafe { $body::<Portable>($($argument),*) }
                }
            )*
        }

        #[cfg(target_arch = "x86_64")]
        mod avx2 {
            use super::*;
            $(
                #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
                pub(crate) unsafe fn $name($($argument: $type),*) -> $answer {
                    // SAFETY: the caller's promise.
                    unsafe { $body::<Avx2>($($argument),*) }
                }
            )*
        }

        #[cfg(target_arch = "x86_64")]
        mod avx512 {
            use super::*;
            $(
                #[target_feature(enable = "avx512f,avx512vl,avx512bw,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
                pub(crate) unsafe fn $name($($argument: $type),*) -> $answer {
                    // SAFETY: the caller's promise.
                    unsafe { $body::<Avx512>($($argument),*) }
                }
            )*
        }
    };
}

kernels! {
    /// The closest hit.
    fn closest(tree: &Tree<'_>, ray: &SingleRay) -> Option<Found> = closest_hit;
    /// Whether there is a hit.
    fn any(tree: &Tree<'_>, ray: &SingleRay) -> bool = any_hit;
}

#[inline(always)]
unsafe fn closest_hit<L: super::level::Lanes>(tree: &Tree<'_>, ray: &SingleRay) -> Option<Found> {
    // SAFETY: the caller's promise.
    unsafe { walk::<L, _, _>(tree, ray, EdgeRule::Closed, &mut Closest, &mut ()) }
}

#[inline(always)]
unsafe fn any_hit<L: super::level::Lanes>(tree: &Tree<'_>, ray: &SingleRay) -> bool {
    // SAFETY: the caller's promise.
    unsafe { walk::<L, _, _>(tree, ray, EdgeRule::Closed, &mut Any, &mut ()).is_some() }
}
