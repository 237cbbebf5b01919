//! Whose answers differ, and who is right.

use ombra_geometry::TriangleMesh;
use serde::Serialize;

use super::judge::{Answer, Fineness, Verdict, truths};
use super::rays::Workload;
use super::trace::{Contestant, Places, Threads};

/// The most rays of a workload on which tracers differ that are judged.
pub(super) const MOST_JUDGED: usize = 256;

/// Rays that are judged whether tracers differ on them or not.
const SAMPLE: usize = 64;

/// What a contestant's answers to a workload are worth.
#[derive(Clone, Debug, Serialize)]
pub struct AnswerRecord {
    /// Which scene.
    pub scene: String,
    /// Which rays.
    pub workload: &'static str,
    /// Whose.
    pub contestant: String,
    /// How many rays.
    pub rays: usize,
    /// How many hit something, in the answers of the first contestant.
    pub hits: usize,
    /// Where this one and the first differ on whether something is hit.
    pub other_hits: usize,
    /// Where both hit, at distances that differ by more than one part in ten thousand.
    pub other_distances: usize,
    /// On how many rays of this workload anybody differs from the first.
    pub disputed: usize,
    /// How many rays were judged: those on which anybody differs, evenly picked if there are more
    /// than 256, and 64 from all.
    pub judged: usize,
    /// Where it is wrong, of those.
    pub wrong: usize,
    /// Where it is wrong, but would be right if triangles were larger or smaller by a hair (a part
    /// in a hundred thousand), or is off by no more than coordinates of the scene are rounded.
    pub wrong_by_a_hair: usize,
    /// Some of the rays where it is wrong, for whoever looks into it.
    pub examples: Vec<Example>,
    /// Where its answer is another when denormal numbers are kept; ombra only.
    pub changed_by_flushing: Option<usize>,
}

/// An answer that is wrong.
#[derive(Clone, Debug, Serialize)]
pub struct Example {
    /// Where the ray starts.
    pub origin: [f32; 3],
    /// Where to.
    pub direction: [f32; 3],
    /// To how far; nothing if for ever.
    pub t_max: Option<f32>,
    /// What the contestant says, as t; nothing for a miss, or where it says only that there is a hit.
    pub said: Option<f32>,
    /// The nearest crossing in double precision.
    pub truth: Option<f64>,
}

/// How many examples are kept of a contestant and a workload.
const EXAMPLES: usize = 4;

/// Asks everybody, compares with the first, and judges.
pub(super) fn compare(
    scene: &str,
    mesh: &TriangleMesh,
    work: &Workload,
    contestants: &[Contestant<'_>],
    threads: &Threads,
    places: &mut Places,
) -> Vec<AnswerRecord> {
    let fineness = Fineness::of(mesh.bounds().extent().length());
    let all: Vec<Vec<Answer>> = contestants
        .iter()
        .map(|&who| threads.answers(who, work, places, true))
        .collect();
    let Some(first) = all.first() else {
        return Vec::new();
    };
    let differ = |&ray: &usize| all.iter().any(|own| !own[ray].agrees(first[ray], fineness));
    let disputed: Vec<usize> = (0..work.rays.len()).filter(differ).collect();
    let mut judged = pick(&disputed, MOST_JUDGED);
    judged.extend(pick(&(0..work.rays.len()).collect::<Vec<_>>(), SAMPLE));
    judged.sort_unstable();
    judged.dedup();
    let rays: Vec<_> = judged.iter().map(|&ray| work.rays[ray]).collect();
    let truths = truths(mesh, &rays, fineness);
    let hits = first.iter().filter(|answer| **answer != Answer::Miss);
    let hits = hits.count();
    let record = |(who, own): (&Contestant<'_>, &Vec<Answer>)| {
        let pairs = || own.iter().zip(first);
        let miss_only_once =
            |(a, b): &(&Answer, &Answer)| (**a == Answer::Miss) != (**b == Answer::Miss);
        let other_hits = pairs().filter(miss_only_once).count();
        let differing = pairs().filter(|(a, b)| !a.agrees(**b, fineness)).count();
        let verdicts: Vec<Verdict> = judged
            .iter()
            .zip(&truths)
            .map(|(&ray, truth)| truth.verdict(own[ray], fineness))
            .collect();
        let count = |wanted| {
            verdicts
                .iter()
                .filter(|verdict| **verdict == wanted)
                .count()
        };
        let wrong = (0..judged.len()).filter(|&i| verdicts[i] == Verdict::Wrong);
        let example = |i: usize| {
            let ray = &work.rays[judged[i]];
            let said = match own[judged[i]] {
                Answer::At(t) => Some(t),
                Answer::Miss | Answer::Blocked => None,
            };
            Example {
                origin: [ray.origin.x, ray.origin.y, ray.origin.z],
                direction: [ray.direction.x, ray.direction.y, ray.direction.z],
                t_max: Some(ray.t_max).filter(|t| t.is_finite()),
                said,
                truth: truths[i].exact(),
            }
        };
        AnswerRecord {
            scene: scene.to_owned(),
            workload: work.name,
            contestant: who.name(),
            rays: work.rays.len(),
            hits,
            other_hits,
            other_distances: differing - other_hits,
            disputed: disputed.len(),
            judged: judged.len(),
            wrong: count(Verdict::Wrong),
            wrong_by_a_hair: count(Verdict::ByAHair),
            examples: wrong.take(EXAMPLES).map(example).collect(),
            changed_by_flushing: None,
        }
    };
    let mut records: Vec<_> = contestants.iter().zip(&all).map(record).collect();
    for ((record, own), &who) in records.iter_mut().zip(&all).zip(contestants) {
        if who.engine.peer().is_none() {
            let kept = threads.answers(who, work, places, false);
            let changed = |(a, b): &(&Answer, &Answer)| a != b;
            record.changed_by_flushing = Some(own.iter().zip(&kept).filter(changed).count());
        }
    }
    records
}

/// So many of a list, evenly.
fn pick(all: &[usize], most: usize) -> Vec<usize> {
    let count = all.len().min(most);
    (0..count).map(|i| all[i * all.len() / count]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_of_many_are_spread_over_all() {
        let all: Vec<usize> = (0..1000).collect();
        assert_eq!(pick(&all, 4), [0, 250, 500, 750]);
        assert_eq!(pick(&all[..3], 4), [0, 1, 2]);
        assert!(pick(&[], 4).is_empty());
    }
}
