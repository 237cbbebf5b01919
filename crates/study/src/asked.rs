//! Questions to a world, and its answers: counted one by one, or timed all at once.

use std::time::Instant;

use ombra::accel::{AnyHit, Statistics, Traversable};
use ombra::geometry::{EdgeRule, Hit, Ray};
use rayon::prelude::*;

/// How many rays a batch has at most: as many as a renderer would have at hand.
const LARGEST_BATCH: usize = 1024;

/// Into how many batches a thread's share is cut at least, so that all end together.
const BATCHES: usize = 8;

/// What rays were answered, in their order.
#[derive(Clone, Debug)]
pub(crate) enum Answers {
    Closest(Vec<Option<Hit>>),
    Any(Vec<bool>),
}

impl Answers {
    /// Places for answers to so many rays.
    pub(crate) fn places(asks_any: bool, count: usize) -> Self {
        if asks_any {
            Self::Any(vec![false; count])
        } else {
            Self::Closest(vec![None; count])
        }
    }

    /// Makes it as many places as there are rays, in the memory that is there.
    pub(crate) fn cut(&mut self, count: usize) {
        match self {
            Self::Closest(hits) => hits.resize(count, None),
            Self::Any(hits) => hits.resize(count, false),
        }
    }

    pub(crate) fn hits(&self) -> usize {
        match self {
            Self::Closest(hits) => hits.iter().flatten().count(),
            Self::Any(hits) => hits.iter().filter(|&&hit| hit).count(),
        }
    }

    /// How many of these answers are not, to the bit, those to the chosen rays of `all`.
    pub(crate) fn differences(&self, all: &Self, chosen: impl Iterator<Item = usize>) -> usize {
        match (self, all) {
            (Self::Closest(own), Self::Closest(all)) => {
                let pairs = own.iter().zip(chosen.map(|i| &all[i]));
                pairs
                    .filter(|(own, other)| bits(own) != bits(other))
                    .count()
            }
            (Self::Any(own), Self::Any(all)) => {
                let pairs = own.iter().zip(chosen.map(|i| &all[i]));
                pairs.filter(|(own, other)| own != other).count()
            }
            _ => chosen.count(),
        }
    }
}

/// A hit as bits, so that −0 and 0 differ and NaN equals itself.
fn bits(hit: &Option<Hit>) -> Option<[u32; 6]> {
    hit.as_ref().map(|hit| {
        [
            hit.t.to_bits(),
            hit.u.to_bits(),
            hit.v.to_bits(),
            hit.primitive.0,
            hit.geometry.0,
            hit.instance.0,
        ]
    })
}

/// The answer to one ray and what it cost.
fn counted(world: &impl Traversable, ray: &Ray, asks_any: bool) -> (Option<Hit>, Statistics) {
    if !asks_any {
        return world.intersect_counted(ray);
    }
    let mut statistics = Statistics::default();
    let terminate = &mut |_: &_| AnyHit::Terminate;
    let wide = (*ray).into();
    let hit = world.search(&wide, EdgeRule::Closed, Some(&mut statistics), terminate);
    (hit.map(|candidate| candidate.hit()), statistics)
}

/// The answers to all rays and what each cost, on the threads that this is called from.
pub(crate) fn count(
    world: &impl Traversable,
    rays: &[Ray],
    asks_any: bool,
) -> (Answers, Vec<Statistics>) {
    let all = rays.par_iter().map(|ray| counted(world, ray, asks_any));
    let (hits, costs): (Vec<_>, Vec<_>) = all.unzip();
    let answers = if asks_any {
        Answers::Any(hits.iter().map(Option::is_some).collect())
    } else {
        Answers::Closest(hits)
    };
    (answers, costs)
}

/// Answers all rays, on the threads that this is called from, and says how many seconds that took.
pub(crate) fn time(world: &impl Traversable, rays: &[Ray], answers: &mut Answers) -> f64 {
    let shares = rayon::current_num_threads() * BATCHES;
    let batch = (rays.len() / shares).clamp(1, LARGEST_BATCH);
    let rays = rays.par_chunks(batch);
    let begun = Instant::now();
    match answers {
        Answers::Closest(hits) => rays
            .zip(hits.par_chunks_mut(batch))
            .for_each(|(rays, hits)| world.intersect_many(rays, hits)),
        Answers::Any(hits) => rays
            .zip(hits.par_chunks_mut(batch))
            .for_each(|(rays, hits)| world.occluded_many(rays, hits)),
    }
    begun.elapsed().as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ombra::geometry::{GeometryId, InstanceId, PrimitiveId};

    #[test]
    fn a_hit_that_differs_in_one_bit_differs() {
        let hit = |t| {
            Some(Hit {
                t,
                u: 0.0,
                v: 0.0,
                primitive: PrimitiveId(0),
                geometry: GeometryId(0),
                instance: InstanceId(0),
            })
        };
        let all = Answers::Closest(vec![hit(1.0), None, hit(0.0), hit(2.0)]);
        let own = Answers::Closest(vec![hit(1.0), hit(-0.0)]);
        assert_eq!(own.differences(&all, [0, 2].into_iter()), 1);
        assert_eq!(all.differences(&all, 0..4), 0);
        assert_eq!((all.hits(), own.hits()), (3, 2));
        let any = Answers::Any(vec![true, false]);
        assert_eq!(any.differences(&Answers::Any(vec![true, true]), 0..2), 1);
    }
}
