//! Watching a launch and stopping it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Ray};
use ombra_pipeline::{
    Context, Control, Cpu, Done, Exception, LaunchError, LaunchException, Pipeline, RayGeneration,
    RayProgram, RayType,
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

/// Every other launch index traces for ever, each ray from within the one before up to a depth: it
/// would take 2⁶⁰ rays.
struct Endless {
    world: Accel<Shapes>,
    stop: AtomicBool,
}

const DEPTH: u32 = 60;

impl Pipeline for Endless {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
    fn max_trace_depth(&self) -> u32 {
        DEPTH
    }
}

impl RayProgram<Probe> for Endless {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        _hit: &Hit,
        _payload: &mut (),
    ) -> Result<(), Exception> {
        if cx.rays() == 5000 {
            self.stop.store(true, Ordering::Relaxed);
        }
        if cx.depth() < DEPTH {
            cx.trace::<Probe>(ray, &mut ())?;
            cx.trace::<Probe>(ray, &mut ())?;
        }
        Ok(())
    }
}

impl RayGeneration for Endless {
    type Output = u8;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut u8) -> Result<(), Exception> {
        if cx.launch_index()[0] % 2 == 1 {
            cx.trace::<Probe>(&along(), &mut ())?;
        }
        *output += 1;
        Ok(())
    }

    fn exception(&self, exception: LaunchException, _: &mut u8) -> Result<(), LaunchException> {
        panic!("asked about {exception}");
    }
}

#[test]
fn a_launch_index_that_traces_for_ever_stops_and_counts_as_not_run() {
    let program = Endless {
        world: balls(1, StructureKind::default()),
        stop: AtomicBool::new(false),
    };
    let indices = AtomicU64::new(0);
    let rays = AtomicU64::new(0);
    let progress = |done: Done| {
        indices.fetch_add(done.indices, Ordering::Relaxed);
        rays.fetch_add(done.rays, Ordering::Relaxed);
    };
    let control = Control {
        stop: Some(&program.stop),
        progress: Some(&progress),
    };
    let mut output = [7; 4];
    let report = Cpu::with_threads(1)
        .unwrap()
        .launch(&program, [4, 1, 1], &mut output, &control)
        .unwrap();
    assert!(report.stopped);
    assert_eq!(output, [8, 7, 7, 7]);
    assert_eq!(report.indices, 1);
    assert!((5000..7000).contains(&report.rays), "{report:?}");
    assert_eq!(indices.into_inner(), report.indices);
    assert_eq!(rays.into_inner(), report.rays);
}

/// Claims to have been stopped.
struct Pretending(Accel<Shapes>);

impl Pipeline for Pretending {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.0
    }
}

impl RayGeneration for Pretending {
    type Output = ();
    fn generate(&self, _: &mut Context<'_, Self>, _: &mut ()) -> Result<(), Exception> {
        Err(Exception::Stopped)
    }
}

#[test]
fn a_stop_that_nobody_asked_for_is_an_exception_like_any_other() {
    let program = Pretending(balls(1, StructureKind::default()));
    let launch = Cpu::all_threads().launch(&program, [2, 1, 1], &mut [(), ()], &Control::default());
    let exception = LaunchException {
        index: [0; 3],
        exception: Exception::Stopped,
    };
    assert_eq!(launch, Err(LaunchError::Exception(exception)));
}
