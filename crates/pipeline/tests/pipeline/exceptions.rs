//! Exceptions: where they say they happened, who settles them, and what a panic does.

use std::panic::{AssertUnwindSafe, catch_unwind};

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, LaunchError, LaunchException, LaunchReport, Pipeline,
    RayGeneration, RayProgram, RayType,
};

use crate::row::{along, balls, past};

/// What goes wrong at a launch index.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Ray(Ray),
    Depth,
    Stack,
    Index,
    Hit,
    Miss,
    Own,
    Panic,
}

const SIZE: [u32; 3] = [40, 30, 2];
const DONE: u8 = 1;
const SETTLED: u8 = 2;

/// Goes wrong at some launch indices.
struct Faulty {
    world: Accel<Shapes>,
    fault: Fault,
    at: Vec<[u32; 3]>,
    settle: bool,
}

enum Probe {}
impl RayType for Probe {
    type Payload = ();
    const NAME: &'static str = "probe";
}

impl Pipeline for Faulty {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
    fn max_trace_depth(&self) -> u32 {
        if self.fault == Fault::Stack {
            u32::MAX
        } else {
            3
        }
    }
}

impl RayProgram<Probe> for Faulty {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        _hit: &Hit,
        payload: &mut (),
    ) -> Result<(), Exception> {
        match self.fault {
            Fault::Hit => Err(Exception::user(1, "hit")),
            _ => cx.trace::<Probe>(ray, payload),
        }
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        _payload: &mut (),
    ) -> Result<(), Exception> {
        Err(Exception::user(2, String::from("miss")))
    }
}

impl RayGeneration for Faulty {
    type Output = u8;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut u8) -> Result<(), Exception> {
        if self.at.contains(&cx.launch_index()) {
            match self.fault {
                Fault::Ray(ray) => cx.trace::<Probe>(&ray, &mut ())?,
                Fault::Depth | Fault::Stack | Fault::Hit => {
                    cx.trace::<Probe>(&along(), &mut ())?;
                }
                Fault::Miss => cx.trace::<Probe>(&past(), &mut ())?,
                Fault::Index => *output = *cx.element(&[1, 2, 3], 3)?,
                Fault::Own => return Err(Exception::user(3, "own")),
                Fault::Panic => panic!("at {:?}", cx.launch_index()),
            }
        }
        *output = DONE;
        Ok(())
    }

    fn exception(
        &self,
        exception: LaunchException,
        output: &mut u8,
    ) -> Result<(), LaunchException> {
        if self.settle {
            *output = SETTLED;
            return Ok(());
        }
        Err(exception)
    }
}

fn faulty(fault: Fault) -> Faulty {
    Faulty {
        world: balls(2, StructureKind::default()),
        fault,
        at: vec![[39, 29, 1], [7, 20, 0], [8, 20, 0], [0, 0, 1]],
        settle: false,
    }
}

fn launch(program: &Faulty, threads: usize) -> (Result<LaunchReport, LaunchError>, Vec<u8>) {
    let mut output = vec![0; 2400];
    let cpu = Cpu::with_threads(threads).unwrap();
    let result = cpu.launch(program, SIZE, &mut output, &Control::default());
    (result, output)
}

fn exception_of(fault: Fault) -> Exception {
    let program = faulty(fault);
    let mut exceptions = [1, 2, 3, 8].map(|threads| {
        let (result, output) = launch(&program, threads);
        // The others were done nonetheless.
        assert_eq!(output.iter().filter(|&&x| x == DONE).count(), 2396);
        match result {
            Err(LaunchError::Exception(LaunchException { index, exception })) => {
                assert_eq!(index, [7, 20, 0], "the smallest, with {threads} threads");
                Some(exception)
            }
            other => panic!("{other:?}"),
        }
    });
    let first = exceptions[0].take().unwrap();
    assert!(exceptions[1..].iter().all(|e| e.as_ref() == Some(&first)));
    first
}

#[test]
fn rays_without_an_answer_are_exceptions_that_show_the_ray() {
    let bad = [
        Ray::new(Point3::ORIGIN, Vector3::ZERO),
        Ray::new(Point3::ORIGIN, Vector3::new(1.0, f32::INFINITY, 0.0)),
        Ray {
            t_min: 2.0,
            t_max: 1.0,
            ..along()
        },
    ];
    for ray in bad {
        let ray_type = "probe";
        assert_eq!(
            exception_of(Fault::Ray(ray)),
            Exception::InvalidRay { ray_type, ray }
        );
    }
    // NaN is not equal to itself, so one thread and the words must do.
    let nan = Ray::new(Point3::new(f32::NAN, 0.0, 0.0), Vector3::X);
    let message = launch(&faulty(Fault::Ray(nan)), 1)
        .0
        .unwrap_err()
        .to_string();
    assert!(message.starts_with("at launch index (7, 20, 0): invalid probe ray: Ray"));
    assert!(message.contains("NaN"));
}

#[test]
fn traces_nested_too_deep_are_exceptions() {
    let expected = Exception::DepthExceeded { limit: 3 };
    assert_eq!(exception_of(Fault::Depth), expected);
}

#[test]
fn a_depth_without_limit_ends_in_an_exception_before_the_stack_does() {
    match exception_of(Fault::Stack) {
        Exception::StackOverflow { depth } => assert!(depth > 100, "{depth}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_index_out_of_range_is_an_exception() {
    let expected = Exception::IndexOutOfRange {
        index: 3,
        length: 3,
    };
    assert_eq!(exception_of(Fault::Index), expected);
}

#[test]
fn the_users_own_exceptions_come_out_of_every_program() {
    assert_eq!(exception_of(Fault::Own), Exception::user(3, "own"));
    assert_eq!(exception_of(Fault::Hit), Exception::user(1, "hit"));
    assert_eq!(exception_of(Fault::Miss), Exception::user(2, "miss"));
}

#[test]
fn the_exception_program_can_settle_it_and_the_launch_goes_on() {
    for fault in [Fault::Own, Fault::Depth, Fault::Index] {
        for threads in [1, 2, 3, 8] {
            let program = Faulty {
                settle: true,
                ..faulty(fault)
            };
            let (result, output) = launch(&program, threads);
            let report = result.unwrap();
            assert_eq!((report.indices, report.stopped), (2400, false));
            let settled = |&at: &[u32; 3]| {
                let [x, y, z] = at.map(|i| i as usize);
                output[x + 40 * (y + 30 * z)] == SETTLED
            };
            assert!(program.at.iter().all(settled));
            assert_eq!(output.iter().filter(|&&x| x == DONE).count(), 2396);
        }
    }
}

#[test]
fn a_panic_in_a_program_reaches_whoever_launched_and_leaves_the_device_sound() {
    let cpu = Cpu::with_threads(2).unwrap();
    let mut output = vec![0; 2400];
    let program = Faulty {
        at: vec![[7, 20, 0]],
        ..faulty(Fault::Panic)
    };
    let launch = || cpu.launch(&program, SIZE, &mut output, &Control::default());
    let panic = catch_unwind(AssertUnwindSafe(launch)).unwrap_err();
    assert_eq!(panic.downcast_ref::<String>().unwrap(), "at [7, 20, 0]");

    let sound = Faulty {
        at: vec![],
        ..program
    };
    cpu.launch(&sound, SIZE, &mut output, &Control::default())
        .unwrap();
    assert_eq!(output, vec![DONE; 2400]);
}
