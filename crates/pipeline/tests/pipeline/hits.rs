//! Any hit, closest hit, miss: what is called, how often, with which hit.

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{
    AnyHit, Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

use crate::row::{along, balls, past};

/// Traces one ray and answers each hit as `answer` says.
struct Probe<A> {
    world: Accel<Shapes>,
    ray: Ray,
    answer: A,
}

/// What the programs of one ray saw.
#[derive(Clone, Debug, Default, PartialEq)]
struct Log {
    asked: Vec<f32>,
    closest: Vec<f32>,
    misses: usize,
}

enum Probing {}
impl RayType for Probing {
    type Payload = Log;
    const NAME: &'static str = "probing";
}

impl<A: Fn(&Hit) -> AnyHit + Sync> Pipeline for Probe<A> {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

impl<A: Fn(&Hit) -> AnyHit + Sync> RayProgram<Probing> for Probe<A> {
    fn any_hit(&self, ray: &Ray, hit: &Hit, log: &mut Log) -> AnyHit {
        assert_eq!(*ray, self.ray);
        assert!(log.closest.is_empty() && log.misses == 0, "asked too late");
        log.asked.push(hit.t);
        (self.answer)(hit)
    }

    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        log: &mut Log,
    ) -> Result<(), Exception> {
        assert_eq!((cx.depth(), *ray), (1, self.ray));
        log.closest.push(hit.t);
        Ok(())
    }

    fn miss(&self, cx: &mut Context<'_, Self>, ray: &Ray, log: &mut Log) -> Result<(), Exception> {
        assert_eq!((cx.depth(), *ray), (1, self.ray));
        log.misses += 1;
        Ok(())
    }
}

impl<A: Fn(&Hit) -> AnyHit + Sync> RayGeneration for Probe<A> {
    type Output = Log;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut Log) -> Result<(), Exception> {
        cx.trace::<Probing>(&self.ray, output)
    }
}

/// What the programs saw, with every structure.
fn logs(ray: Ray, answer: impl Fn(&Hit) -> AnyHit + Sync + Copy) -> Vec<Log> {
    let kinds = StructureKind::ALL.iter();
    kinds
        .map(|&kind| {
            let world = balls(3, kind);
            let probe = Probe { world, ray, answer };
            let mut output = [Log::default()];
            let report = Cpu::all_threads()
                .launch(&probe, [1, 1, 1], &mut output, &Control::default())
                .unwrap();
            assert_eq!((report.rays, report.indices), (1, 1));
            output[0].clone()
        })
        .collect()
}

#[test]
fn accepting_every_hit_leaves_the_nearest() {
    for log in logs(along(), |_| AnyHit::Accept) {
        assert_eq!(log.closest, [1.5]);
        assert_eq!(log.misses, 0);
    }
}

#[test]
fn the_closest_hit_is_the_nearest_accepted_one() {
    let answer = |hit: &Hit| match hit.t {
        t if t < 4.0 => AnyHit::Ignore,
        _ => AnyHit::Accept,
    };
    for log in logs(along(), answer) {
        assert_eq!(log.closest, [4.5]);
        assert_eq!(log.misses, 0);
    }
}

#[test]
fn ignoring_every_hit_is_a_miss_that_was_asked_of_each_crossing_once() {
    for log in logs(along(), |_| AnyHit::Ignore) {
        assert_eq!((log.closest.len(), log.misses), (0, 1));
        let mut asked = log.asked;
        asked.sort_by(f32::total_cmp);
        assert_eq!(asked, [1.5, 2.5, 3.5, 4.5, 5.5, 6.5]);
    }
}

#[test]
fn terminating_commits_the_hit_and_asks_no_further() {
    for log in logs(along(), |_| AnyHit::Terminate) {
        assert_eq!(log.asked.len(), 1);
        assert_eq!(log.closest, log.asked);
        assert_eq!(log.misses, 0);
    }
}

#[test]
fn terminating_later_commits_that_hit() {
    let answer = |hit: &Hit| match hit.t {
        5.5 => AnyHit::Terminate,
        _ => AnyHit::Ignore,
    };
    for log in logs(along(), answer) {
        assert_eq!(log.asked.last(), Some(&5.5));
        assert_eq!(log.closest, [5.5]);
    }
}

#[test]
fn a_ray_past_everything_asks_nothing_and_misses_once() {
    for log in logs(past(), |_| panic!("there is no hit")) {
        let expected = Log {
            misses: 1,
            ..Log::default()
        };
        assert_eq!(log, expected);
    }
}

#[test]
fn hits_beyond_the_ends_of_the_ray_do_not_exist() {
    let segment = Ray {
        t_min: 2.0,
        t_max: 4.0,
        ..along()
    };
    for log in logs(segment, |_| AnyHit::Ignore) {
        let mut asked = log.asked;
        asked.sort_by(f32::total_cmp);
        assert_eq!(asked, [2.5, 3.5]);
    }
}
