//! Tracing all rays of a workload: once for the answers, then on the clock.

use std::sync::Mutex;
use std::time::Instant;

use ombra_geometry::{GeometryId, Hit, InstanceId, PrimitiveId};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::engine::{Engine, Way};
use super::float_mode::Flushed;
use super::judge::Answer;
use super::processor;
use super::rays::Workload;

/// Rays that a thread takes at a time.
pub(super) const CHUNK: usize = 4096;

/// Chunks that are traced off the clock first: what the one before left in the caches is not ours.
const WARM_UP: usize = 16;

/// An engine and how it is asked.
#[derive(Clone, Copy)]
pub(super) struct Contestant<'a> {
    pub(super) engine: &'a dyn Engine,
    pub(super) way: Way,
}

impl Contestant<'_> {
    pub(super) fn name(&self) -> String {
        format!("{}, {}", self.engine.name(), self.way)
    }
}

/// Places for the answers of a workload.
#[derive(Debug)]
pub(super) struct Places {
    hits: Vec<Option<Hit>>,
    occluded: Vec<bool>,
}

/// An answer that nobody gives, so that who writes nothing does not pass with the answers of the one
/// before.
const NONSENSE: Hit = Hit {
    t: f32::NAN,
    u: 0.0,
    v: 0.0,
    primitive: PrimitiveId(0),
    geometry: GeometryId(0),
    instance: InstanceId(0),
};

impl Places {
    pub(super) fn new(count: usize) -> Self {
        Self {
            hits: vec![None; count],
            occluded: vec![false; count],
        }
    }
}

/// Threads, and the clock that suits them.
#[derive(Debug)]
pub(super) struct Threads {
    pool: ThreadPool,
    pub(super) count: usize,
}

impl Threads {
    /// So many; 0 is all of the machine.
    ///
    /// # Errors
    /// When the system does not give them.
    pub(super) fn new(count: usize) -> anyhow::Result<Self> {
        let pool = ThreadPoolBuilder::new().num_threads(count).build()?;
        let count = pool.current_num_threads();
        Ok(Self { pool, count })
    }

    /// Traces the first `count` rays of a workload; gives seconds: of the thread where there is one,
    /// otherwise of the clock on the wall. Denormals are flushed if `flush` says so.
    fn trace(
        &self,
        who: Contestant<'_>,
        work: &Workload,
        count: usize,
        places: &mut Places,
        flush: bool,
    ) -> f64 {
        let rays = &work.rays[..count.min(work.rays.len())];
        let chunks = rays.chunks(CHUNK);
        let hits = places.hits.chunks_mut(CHUNK);
        let occluded = places.occluded.chunks_mut(CHUNK);
        let jobs = Mutex::new(chunks.zip(hits.zip(occluded)));
        let next = || jobs.lock().ok().and_then(|mut jobs| jobs.next());
        let work_off = || {
            let _flushed = flush.then(Flushed::on);
            while let Some((rays, (hits, occluded))) = next() {
                if work.any {
                    who.engine
                        .occluded(who.way, rays, &mut occluded[..rays.len()]);
                } else {
                    let hits = &mut hits[..rays.len()];
                    who.engine.intersect(who.way, rays, work.coherent, hits);
                }
            }
        };
        if self.count == 1 {
            return self.pool.install(|| {
                let begin = processor::thread_seconds();
                work_off();
                processor::thread_seconds() - begin
            });
        }
        let begin = Instant::now();
        self.pool.scope(|scope| {
            for _ in 0..self.count {
                scope.spawn(|_| work_off());
            }
        });
        begin.elapsed().as_secs_f64()
    }

    /// What a contestant says of every ray.
    pub(super) fn answers(
        &self,
        who: Contestant<'_>,
        work: &Workload,
        places: &mut Places,
        flush: bool,
    ) -> Vec<Answer> {
        let count = work.rays.len();
        if !work.any {
            places.hits.fill(Some(NONSENSE));
            self.trace(who, work, count, places, flush);
            let answer = |hit: &Option<Hit>| hit.map_or(Answer::Miss, |hit| Answer::At(hit.t));
            return places.hits[..count].iter().map(answer).collect();
        }
        let answers = |places: &Places| {
            let answer = |blocked: &bool| {
                if *blocked {
                    Answer::Blocked
                } else {
                    Answer::Miss
                }
            };
            places.occluded[..count].iter().map(answer).collect()
        };
        places.occluded.fill(true);
        self.trace(who, work, count, places, flush);
        let first: Vec<Answer> = answers(places);
        places.occluded.fill(false);
        self.trace(who, work, count, places, flush);
        let second: Vec<Answer> = answers(places);
        // A yes or no leaves no room for nonsense: what was not written differs from time to time.
        let both = first.into_iter().zip(second);
        both.map(|(a, b)| if a == b { a } else { Answer::At(f32::NAN) })
            .collect()
    }

    /// The seconds of all contestants, one entry a round. Each round begins with another one.
    pub(super) fn times(
        &self,
        contestants: &[Contestant<'_>],
        work: &Workload,
        rounds: usize,
        places: &mut Places,
    ) -> Vec<Vec<f64>> {
        let mut times = vec![Vec::with_capacity(rounds); contestants.len()];
        for round in 0..rounds {
            for turn in 0..contestants.len() {
                let who = (round + turn) % contestants.len();
                let contestant = contestants[who];
                self.trace(contestant, work, WARM_UP * CHUNK, places, true);
                let count = work.rays.len();
                times[who].push(self.trace(contestant, work, count, places, true));
            }
        }
        times
    }
}
