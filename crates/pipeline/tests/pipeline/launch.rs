//! Launches: their sizes and indices, their buffers, and that threads do not show.

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, LaunchError, Pipeline, RayGeneration, RayProgram, RayType,
};
use proptest::prelude::*;

use crate::row::balls;

/// Writes down where it is, or what it sees from there.
struct Places {
    world: Accel<Shapes>,
}

fn places() -> Places {
    Places {
        world: balls(4, StructureKind::default()),
    }
}

enum Sight {}
impl RayType for Sight {
    type Payload = f32;
    const NAME: &'static str = "sight";
}

impl Pipeline for Places {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

impl RayProgram<Sight> for Places {
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        hit: &Hit,
        sum: &mut f32,
    ) -> Result<(), Exception> {
        *sum += hit.t;
        Ok(())
    }
}

/// Where it is.
enum Index {}
impl RayGeneration<Index> for Places {
    type Output = Option<[u32; 3]>;
    fn generate(
        &self,
        cx: &mut Context<'_, Self>,
        output: &mut Self::Output,
    ) -> Result<(), Exception> {
        assert_eq!(*output, None, "each element is written once");
        assert!((0..3).all(|k| cx.launch_index()[k] < cx.launch_size()[k]));
        *output = Some(cx.launch_index());
        Ok(())
    }
}

/// What it sees: as many rays as x says, added to what was there.
enum Fan {}
impl RayGeneration<Fan> for Places {
    type Output = f32;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut f32) -> Result<(), Exception> {
        let [x, y, _] = cx.launch_index();
        for i in 0..x % 5 {
            let aim = Vector3::new(1.0, 0.1 * i as f32, 0.01 * y as f32);
            cx.trace::<Sight>(&Ray::new(Point3::ORIGIN, aim), output)?;
        }
        Ok(())
    }
}

fn indices(size: [u32; 3], cpu: &Cpu) -> Vec<Option<[u32; 3]>> {
    let mut output = vec![None; size.iter().product::<u32>() as usize];
    let report = cpu
        .launch::<Index, _>(&places(), size, &mut output, &Control::default())
        .unwrap();
    assert_eq!(report.indices, output.len() as u64);
    assert!(!report.stopped);
    output
}

#[test]
fn launches_of_one_two_and_three_dimensions_run_x_fastest() {
    let cpu = Cpu::with_threads(2).unwrap();
    assert_eq!(
        indices([3, 1, 1], &cpu),
        [[0, 0, 0], [1, 0, 0], [2, 0, 0]].map(Some)
    );
    assert_eq!(
        indices([2, 2, 1], &cpu),
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]].map(Some)
    );
    let third = [[0, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]].map(Some);
    assert_eq!(indices([1, 2, 2], &cpu), third);
}

#[test]
fn a_launch_without_indices_runs_nothing() {
    for size in [[0, 1, 1], [5, 0, 1], [5, 5, 0], [0, 0, 0]] {
        assert_eq!(indices(size, &Cpu::all_threads()), []);
    }
    // Not even where the other dimensions alone are beyond 64 bits.
    assert!(
        Cpu::all_threads()
            .launch::<Index, _>(
                &places(),
                [u32::MAX, u32::MAX, 0],
                &mut [],
                &Control::default()
            )
            .is_ok()
    );
}

#[test]
fn a_buffer_of_another_size_is_refused_before_anything_runs() {
    for (size, length) in [
        ([2, 2, 1], 3),
        ([2, 2, 1], 5),
        ([0, 1, 1], 1),
        ([1, 1, 1], 0),
    ] {
        let mut output = vec![7.0; length];
        let error =
            Cpu::all_threads().launch::<Fan, _>(&places(), size, &mut output, &Control::default());
        let launch = size.iter().map(|&n| u128::from(n)).product();
        let expected = LaunchError::BufferSize {
            launch,
            buffer: length,
        };
        assert_eq!(error, Err(expected));
        assert_eq!(output, vec![7.0; length]);
    }
}

#[test]
fn a_launch_beyond_64_bits_says_its_true_size() {
    let n = u32::MAX;
    let error = Cpu::all_threads()
        .launch::<Fan, _>(&places(), [n; 3], &mut [0.0], &Control::default())
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "a launch of 79228162458924105385300197375 indices needs a buffer of as many elements, \
         not 1"
    );
}

#[test]
fn a_program_adds_to_what_the_buffer_held() {
    let mut once = vec![0.0; 40];
    let mut again = vec![0.0; 40];
    let run = |output: &mut Vec<f32>| {
        Cpu::all_threads()
            .launch::<Fan, _>(&places(), [8, 5, 1], output, &Control::default())
            .unwrap()
    };
    run(&mut once);
    run(&mut again);
    run(&mut again);
    assert!(once.iter().any(|&sum| sum > 0.0));
    // Sums of a few numbers below 10, in another order.
    let twice = |(a, b): (&f32, &f32)| (a * 2.0 - b).abs() < 1e-4;
    assert!(once.iter().zip(&again).all(twice));
}

#[test]
fn no_number_of_threads_shows_in_the_result() {
    let run = |threads| {
        let mut output = vec![0.0; 90 * 70];
        let report = Cpu::with_threads(threads)
            .unwrap()
            .launch::<Fan, _>(&places(), [90, 70, 1], &mut output, &Control::default())
            .unwrap();
        (
            output.iter().map(|x: &f32| x.to_bits()).collect::<Vec<_>>(),
            report,
        )
    };
    let (alone, report) = run(1);
    assert_eq!(report.rays, 70 * (90 / 5) * (1 + 2 + 3 + 4));
    for threads in [2, 3, 8, 0] {
        assert_eq!(
            (&alone, report),
            (&run(threads).0, run(threads).1),
            "{threads} threads"
        );
    }
}

#[test]
fn a_device_has_as_many_threads_as_it_was_given() {
    for threads in [1, 3] {
        let cpu = Cpu::with_threads(threads).unwrap();
        assert_eq!(cpu.threads(), threads);
        assert_eq!(cpu.install(|| cpu.threads()), threads);
    }
    assert!(Cpu::with_threads(0).unwrap().threads() >= 1);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn every_index_of_any_launch_runs_once_on_its_own_element(
        width in 0_u32..90,
        height in 0_u32..40,
        depth in 0_u32..4,
    ) {
        let output = indices([width, height, depth], &Cpu::all_threads());
        for (element, index) in output.iter().enumerate() {
            let [x, y, z] = index.unwrap();
            prop_assert_eq!(element as u32, (z * height + y) * width + x);
        }
    }
}
