//! Many rays, by one placed mesh after another: the rays of a batch are asked of each together.
//!
//! A walk down the upper level takes each ray to its own meshes. With few meshes it is quicker to take
//! all rays to the first, then all to the second with what they have found as the end of their range,
//! and so on: below, rays that go the same way go together.
//!
//! Answers are those of the walk, to the bit. A hit of a mesh that stands as it is lies in its
//! triangle's padded box (see `traversal_ray.rs`), and so in that of the placement. Where a mesh is
//! moved, the box of the placement is asked as the walk does; a ray that it turns away is left to the
//! walk.

use ombra_geometry::{EdgeRule, Hit, InstanceId, Ray};

use super::{Entry, Instances};
use crate::bvh8::{Wide, not_above, rounded};
use crate::search::Search;
use crate::{AnyHit, Candidate, Primitives, Reach, Span, TraversalRay, Visitor as _};

/// With more placements than this the walk is quicker.
const MOST: usize = 16;

/// Rays at a time, so that what is noted of each stays near.
const BLOCK: usize = 4096;

/// What is known of a ray.
#[derive(Clone, Copy)]
struct Known {
    best: Option<Candidate>,
    /// The end of its range: that of the ray, then its best hit.
    t_max: f64,
    /// Nothing more need be found out.
    done: bool,
}

/// What is asked.
#[derive(Clone, Copy, PartialEq)]
enum Question {
    Closest,
    Any,
}

/// Rays on their way to one mesh.
#[derive(Default)]
struct Batch {
    /// Which of the block.
    numbers: Vec<usize>,
    /// In the space of the mesh.
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    any: Vec<bool>,
    /// Which of the batch are not for the kernels.
    slow: Vec<usize>,
}

impl<P: Primitives> Instances<P> {
    /// See [`Primitives::closest_many`].
    pub(super) fn closest_in_turn(
        &self,
        rays: &[Ray],
        hits: &mut [Option<Hit>],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        self.in_turn(rays, Question::Closest, reach, slow, &mut |k, known| {
            hits[k] = known.best.map(|best| best.hit());
        })
    }

    /// See [`Primitives::any_many`].
    pub(super) fn any_in_turn(
        &self,
        rays: &[Ray],
        hits: &mut [bool],
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
    ) -> bool {
        self.in_turn(rays, Question::Any, reach, slow, &mut |k, known| {
            hits[k] = known.done;
        })
    }

    fn in_turn(
        &self,
        rays: &[Ray],
        question: Question,
        reach: &Reach,
        slow: &mut dyn FnMut(usize),
        answer: &mut dyn FnMut(usize, &Known),
    ) -> bool {
        if self.entries.len() > MOST {
            return false;
        }
        let (mut meshes, mut others) = (Vec::new(), Vec::new());
        for (number, entry) in (0..).zip(&self.entries) {
            let bounds = self.bounds(number);
            match self.mesh(entry) {
                _ if bounds.is_empty() => {}
                Some(tree) if bounds.is_finite() => meshes.push((number, tree)),
                _ => others.push(number),
            }
        }
        if meshes.is_empty() {
            return false;
        }
        let mut batch = Batch::default();
        for (block, rays) in rays.chunks(BLOCK).enumerate() {
            let first = block * BLOCK;
            let mut known: Vec<Known> = (rays.iter())
                .map(|ray| self.among_others(ray, &others, question, reach))
                .collect();
            let mut left = |k: usize, known: &mut Known| {
                slow(first + k);
                known.done = true;
            };
            for &(number, tree) in &meshes {
                self.ask(
                    number,
                    tree,
                    rays,
                    (question, reach),
                    &mut known,
                    &mut batch,
                    &mut left,
                );
            }
            for (k, known) in known.iter().enumerate() {
                answer(first + k, known);
            }
        }
        true
    }

    /// The tree of an entry that is a mesh for the kernels.
    fn mesh(&self, entry: &Entry) -> Option<&Wide> {
        let accel = &self.geometries[entry.geometry.index()];
        let tree = accel.structure.wide().filter(|tree| tree.is_of_triangles());
        // What has no end there is not in the tree.
        tree.filter(|_| entry.shape.is_none() && accel.unbounded.is_empty() && entry.mask != 0)
    }

    /// What a ray meets of shapes, and of anything else that is no mesh for the kernels.
    fn among_others(&self, ray: &Ray, others: &[u32], question: Question, reach: &Reach) -> Known {
        let mut known = Known {
            best: None,
            t_max: ray.t_max.into(),
            done: false,
        };
        if others.is_empty() {
            return known;
        }
        if let Some(ray) = TraversalRay::new(&(*ray).into(), reach) {
            let mut said = |_: &Candidate| match question {
                Question::Closest => AnyHit::Accept,
                Question::Any => AnyHit::Terminate,
            };
            let counter = &mut ();
            let mut search = Search::new(self, &ray, EdgeRule::Closed, counter, &mut said);
            // Broken off or not, what was accepted is in the search.
            let _ = search.leaf(others, Span::ALL);
            known.best = search.best();
            known.t_max = known.best.map_or(known.t_max, |best| best.t);
            known.done = question == Question::Any && known.best.is_some();
        }
        known
    }

    /// Asks one mesh about all rays that are not done.
    #[expect(clippy::too_many_arguments, reason = "one step of a loop")]
    fn ask(
        &self,
        number: u32,
        tree: &Wide,
        rays: &[Ray],
        (question, reach): (Question, &Reach),
        known: &mut [Known],
        batch: &mut Batch,
        left: &mut dyn FnMut(usize, &mut Known),
    ) {
        let entry = self.entries[number as usize];
        let moves = self.object_from_world[entry.instance as usize].is_some();
        let below = self.geometries[entry.geometry.index()].reach();
        batch.clear();
        for (k, (ray, known)) in rays.iter().zip(&mut *known).enumerate() {
            if known.done {
                continue;
            }
            let t_max = not_above(known.t_max);
            let local = if moves {
                let Some(ray) = TraversalRay::new(&(*ray).into(), reach) else {
                    continue;
                };
                let local = self.local(entry.instance, &ray, known.t_max);
                match TraversalRay::new(&local, below).map(|ray| rounded(&ray)) {
                    // It is not valid there.
                    None => continue,
                    Some(None) => {
                        left(k, known);
                        continue;
                    }
                    Some(Some(local)) => local,
                }
            } else {
                Ray { t_max, ..*ray }
            };
            batch.numbers.push(k);
            batch.rays.push(local);
        }
        // Whether there is a hit suffices where none can be turned away.
        if question == Question::Any && !moves {
            batch.any(tree);
            for (&k, &any) in batch.numbers.iter().zip(&batch.any) {
                known[k].done |= any;
            }
        } else {
            batch.closest(tree);
            for (&k, hit) in batch.numbers.iter().zip(&batch.hits) {
                let (Some(hit), known) = (hit, &mut known[k]) else {
                    continue;
                };
                let candidate = Candidate {
                    t: hit.t.into(),
                    u: hit.u,
                    v: hit.v,
                    primitive: hit.primitive,
                    geometry: entry.geometry,
                    instance: InstanceId(entry.instance),
                };
                if moves && !self.lies_in_box(number, &rays[k], &candidate, reach) {
                    left(k, known);
                } else if known.best.is_none_or(|best| candidate.precedes(&best)) {
                    known.best = Some(candidate);
                    known.t_max = candidate.t;
                    known.done = question == Question::Any;
                }
            }
        }
        for &place in &batch.slow {
            let k = batch.numbers[place];
            left(k, &mut known[k]);
        }
    }

    /// Whether a hit counts; see [`Search::leaf`].
    fn lies_in_box(&self, number: u32, ray: &Ray, found: &Candidate, reach: &Reach) -> bool {
        TraversalRay::new(&(*ray).into(), reach).is_some_and(|ray| {
            let padded = self.bounds(number).wide().padded(ray.hit_pad);
            padded.contains(ray.ray.at(found.t))
        })
    }
}

impl Batch {
    fn clear(&mut self) {
        self.numbers.clear();
        self.rays.clear();
        self.slow.clear();
    }

    fn closest(&mut self, tree: &Wide) {
        self.hits.clear();
        self.hits.resize(self.rays.len(), None);
        let slow = &mut self.slow;
        tree.closest_many(&self.rays, &mut self.hits, &mut |k| slow.push(k));
    }

    fn any(&mut self, tree: &Wide) {
        self.any.clear();
        self.any.resize(self.rays.len(), false);
        let slow = &mut self.slow;
        tree.any_many(&self.rays, &mut self.any, &mut |k| slow.push(k));
    }
}
