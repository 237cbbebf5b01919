//! The kernels compiled once for each level of instructions, and the choice between them.

use ombra_geometry::{EdgeRule, Hit, Ray};

use super::super::node::{Child, Node};
use super::box_ray::BoxRay;
use super::layout::Layout;
#[cfg(target_arch = "aarch64")]
use super::level::Neon;
#[cfg(debug_assertions)]
use super::level::NeonTwin;
#[cfg(target_arch = "x86_64")]
use super::level::{Avx2, Avx512};
use super::level::{Lanes, Level, Portable};
use super::lists::{entered, readied};
use super::many::many;
use super::ray::{Near, SingleRay};
use super::walk::{Any, Closest, Found, Said, Tree, walk};
use crate::{AnyHit, Statistics, TraversalRay};

/// Makes of each kernel one function a level, and one that chooses.
macro_rules! kernels {
    ($($(#[$meta:meta])* fn $name:ident$(<$layout:ident>)?($($argument:ident: $type:ty),*) -> $answer:ty = $body:ident;)*) => {
        $(
            $(#[$meta])*
            #[inline]
            pub(crate) fn $name$(<$layout: Layout>)?(level: Level, $($argument: $type),*) -> $answer {
                // SAFETY: a `Level` is only made where the processor has it; trees are whole.
                unsafe {
                    match level {
                        Level::Scalar => scalar::$name($($argument),*),
                        #[cfg(debug_assertions)]
                        Level::NeonTwin => neon_twin::$name($($argument),*),
                        #[cfg(target_arch = "aarch64")]
                        Level::Neon => neon::$name($($argument),*),
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
                pub(crate) unsafe fn $name$(<$layout: Layout>)?($($argument: $type),*) -> $answer {
                    // SAFETY: every processor has these.
                    unsafe { $body::<Portable$(, $layout)?>($($argument),*) }
                }
            )*
        }

        #[cfg(debug_assertions)]
        mod neon_twin {
            use super::*;
            $(
                pub(crate) unsafe fn $name$(<$layout: Layout>)?($($argument: $type),*) -> $answer {
                    // SAFETY: every processor has these.
                    unsafe { $body::<NeonTwin$(, $layout)?>($($argument),*) }
                }
            )*
        }

        #[cfg(target_arch = "aarch64")]
        mod neon {
            use super::*;
            $(
                #[target_feature(enable = "neon")]
                pub(crate) unsafe fn $name$(<$layout: Layout>)?($($argument: $type),*) -> $answer {
                    // SAFETY: the caller's promise.
                    unsafe { $body::<Neon$(, $layout)?>($($argument),*) }
                }
            )*
        }

        #[cfg(target_arch = "x86_64")]
        mod avx2 {
            use super::*;
            $(
                #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
                pub(crate) unsafe fn $name$(<$layout: Layout>)?($($argument: $type),*) -> $answer {
                    // SAFETY: the caller's promise.
                    unsafe { $body::<Avx2$(, $layout)?>($($argument),*) }
                }
            )*
        }

        #[cfg(target_arch = "x86_64")]
        mod avx512 {
            use super::*;
            $(
                #[target_feature(enable = "avx512f,avx512vl,avx512bw,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
                pub(crate) unsafe fn $name$(<$layout: Layout>)?($($argument: $type),*) -> $answer {
                    // SAFETY: the caller's promise.
                    unsafe { $body::<Avx512$(, $layout)?>($($argument),*) }
                }
            )*
        }
    };
}

kernels! {
    /// The closest hit; `None` if this ray is not for the kernels.
    fn closest<Y>(tree: &Tree<Y>, near: &Near, ray: &Ray) -> Option<Option<Found>> = closest_hit;
    /// The closest hits of many rays. `slow` is told which rays are not for the kernels.
    fn closest_many<Y>(tree: &Tree<Y>, near: &Near, rays: &[Ray], hits: &mut [Option<Hit>], slow: &mut dyn FnMut(usize)) -> () = closest_hits;
    /// Whether many rays have a hit. `slow` is told which rays are not for the kernels.
    fn any_many<Y>(tree: &Tree<Y>, near: &Near, rays: &[Ray], hits: &mut [bool], slow: &mut dyn FnMut(usize)) -> () = any_hits;
    /// The closest hit that `said` accepts, and what the search cost.
    fn search<Y>(tree: &Tree<Y>, ray: &mut SingleRay, rule: EdgeRule, said: &mut dyn FnMut(&Found) -> AnyHit) -> Option<Found> = said_hit;
    /// The same, counting.
    fn search_counted<Y>(tree: &Tree<Y>, ray: &mut SingleRay, rule: EdgeRule, said: &mut dyn FnMut(&Found) -> AnyHit, statistics: &mut Statistics) -> Option<Found> = said_hit_counted;
    /// Whether there is a hit; `None` if this ray is not for the kernels.
    fn any<Y>(tree: &Tree<Y>, near: &Near, ray: &Ray) -> Option<bool> = any_hit;
    /// A ray made ready for a walk to lists; `None` if boxes are to be tested in double precision.
    fn ready(ray: &TraversalRay, near: &Near) -> Option<BoxRay> = readied;
    /// One node of a walk to lists.
    fn enter(node: &Node, ray: &BoxRay, t_max: f32, to: *mut Child, entries: *mut f32) -> usize = entered;
}

#[inline(always)]
unsafe fn closest_hit<L: Lanes, Y: Layout>(
    tree: &Tree<Y>,
    near: &Near,
    ray: &Ray,
) -> Option<Option<Found>> {
    let mut ray = SingleRay::new(ray, near)?;
    // SAFETY: the caller's promise.
    unsafe {
        Some(walk::<L, Y, _, _>(
            tree,
            &mut ray,
            EdgeRule::Closed,
            &mut Closest,
            &mut (),
        ))
    }
}

#[inline(always)]
unsafe fn any_hit<L: Lanes, Y: Layout>(tree: &Tree<Y>, near: &Near, ray: &Ray) -> Option<bool> {
    let mut ray = SingleRay::new(ray, near)?;
    // SAFETY: the caller's promise.
    let found = unsafe { walk::<L, Y, _, _>(tree, &mut ray, EdgeRule::Closed, &mut Any, &mut ()) };
    Some(found.is_some())
}

#[inline(always)]
unsafe fn said_hit<L: Lanes, Y: Layout>(
    tree: &Tree<Y>,
    ray: &mut SingleRay,
    rule: EdgeRule,
    said: &mut dyn FnMut(&Found) -> AnyHit,
) -> Option<Found> {
    // SAFETY: the caller's promise.
    unsafe { walk::<L, Y, _, _>(tree, ray, rule, &mut Said(said), &mut ()) }
}

#[inline(always)]
unsafe fn said_hit_counted<L: Lanes, Y: Layout>(
    tree: &Tree<Y>,
    ray: &mut SingleRay,
    rule: EdgeRule,
    said: &mut dyn FnMut(&Found) -> AnyHit,
    statistics: &mut Statistics,
) -> Option<Found> {
    // SAFETY: the caller's promise.
    unsafe { walk::<L, Y, _, _>(tree, ray, rule, &mut Said(said), statistics) }
}

#[inline(always)]
unsafe fn closest_hits<L: Lanes, Y: Layout>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    hits: &mut [Option<Hit>],
    slow: &mut dyn FnMut(usize),
) {
    let answer = |index: usize, found: Found| {
        hits[index] = found.some().map(|found| found.candidate().hit());
    };
    // SAFETY: the caller's promise.
    unsafe { many::<L, Y, Closest>(tree, near, rays, answer, slow) }
}

#[inline(always)]
unsafe fn any_hits<L: Lanes, Y: Layout>(
    tree: &Tree<Y>,
    near: &Near,
    rays: &[Ray],
    hits: &mut [bool],
    slow: &mut dyn FnMut(usize),
) {
    let answer = |index: usize, found: Found| hits[index] = found.some().is_some();
    // SAFETY: the caller's promise.
    unsafe { many::<L, Y, Any>(tree, near, rays, answer, slow) }
}
