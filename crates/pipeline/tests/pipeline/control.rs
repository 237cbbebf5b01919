//! Watching a launch and stopping it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_pipeline::{
    Context, Control, Cpu, Done, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

use crate::row::{along, balls};

/// Traces a ray for each launch index and pulls the stop at one of them.
struct Stopping<'a> {
    world: Accel<Shapes>,
    stop: &'a AtomicBool,
    at: u32,
}

enum Probe {}
impl RayType for Probe {
    type Payload = ();
    const NAME: &'static str = "probe";
}

impl Pipeline for Stopping<'_> {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

impl RayProgram<Probe> for Stopping<'_> {}

impl RayGeneration for Stopping<'_> {
    type Output = bool;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut bool) -> Result<(), Exception> {
        cx.trace::<Probe>(&along(), &mut ())?;
        if cx.launch_index()[0] == self.at {
            self.stop.store(true, Ordering::Relaxed);
        }
        *output = true;
        Ok(())
    }
}

const SIZE: u32 = 10_000;

fn stopping(stop: &AtomicBool, at: u32) -> Stopping<'_> {
    Stopping {
        world: balls(1, StructureKind::default()),
        stop,
        at,
    }
}

#[test]
fn progress_adds_up_to_what_was_done() {
    let indices = AtomicU64::new(0);
    let rays = AtomicU64::new(0);
    let calls = AtomicU64::new(0);
    let progress = |done: Done| {
        indices.fetch_add(done.indices, Ordering::Relaxed);
        rays.fetch_add(done.rays, Ordering::Relaxed);
        calls.fetch_add(1, Ordering::Relaxed);
    };
    let control = Control {
        progress: Some(&progress),
        ..Control::default()
    };
    let stop = AtomicBool::new(false);
    let mut output = vec![false; SIZE as usize];
    let report = Cpu::all_threads()
        .launch(&stopping(&stop, SIZE), [SIZE, 1, 1], &mut output, &control)
        .unwrap();
    assert_eq!(indices.into_inner(), report.indices);
    assert_eq!(rays.into_inner(), report.rays);
    assert_eq!((report.indices, report.rays), (10_000, 10_000));
    assert!(calls.into_inner() > 100);
}

#[test]
fn a_stop_finishes_what_was_begun_and_leaves_the_rest_alone() {
    let stop = AtomicBool::new(false);
    let control = Control {
        stop: Some(&stop),
        ..Control::default()
    };
    let mut output = vec![false; SIZE as usize];
    let report = Cpu::with_threads(1)
        .unwrap()
        .launch(&stopping(&stop, 1234), [SIZE, 1, 1], &mut output, &control)
        .unwrap();
    assert!(report.stopped);
    assert!(output[1234], "the one that pulled the stop was finished");
    let done = output.iter().filter(|&&done| done).count() as u64;
    assert_eq!((report.indices, report.rays), (done, done));
    assert!(done < u64::from(SIZE));
}

#[test]
fn a_launch_that_is_stopped_before_it_begins_does_nothing() {
    let stop = AtomicBool::new(true);
    let progress = |_| panic!("nothing was done");
    let control = Control {
        stop: Some(&stop),
        progress: Some(&progress),
    };
    let mut output = vec![false; SIZE as usize];
    let report = Cpu::all_threads()
        .launch(&stopping(&stop, 0), [SIZE, 1, 1], &mut output, &control)
        .unwrap();
    assert_eq!((report.stopped, report.indices, report.rays), (true, 0, 0));
    assert!(!output.contains(&true));
}

#[test]
fn control_says_what_it_does() {
    let text = format!("{:?}", Control::default());
    assert_eq!(text, "Control { stop: None, progress: false }");
}
