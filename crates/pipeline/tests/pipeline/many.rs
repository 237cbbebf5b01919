//! Launch indices that are generated at once.

use std::sync::atomic::AtomicBool;

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Point3, Ray};
use ombra_pipeline::{
    Batch, Context, Control, Cpu, Exception, LaunchError, LaunchException, Pipeline, RayGeneration,
    RayProgram, RayType,
};

use crate::row::{along, balls};

/// Asks at each launch index how far it is to a ball, from further and further aside.
struct Aside {
    world: Accel<Shapes>,
    /// Whether indices are generated at once.
    at_once: bool,
    /// From this index on rays are invalid.
    sound: u32,
}

enum Distance {}
impl RayType for Distance {
    type Payload = f32;
    const NAME: &'static str = "distance";
}

impl Aside {
    fn ray(&self, [x, y, _]: [u32; 3]) -> Ray {
        let aside = if x < self.sound { 0.004 } else { f32::NAN };
        let ray = along();
        let moved = Point3::new(ray.origin.x, x as f32 * aside, y as f32 * 0.01);
        Ray::new(moved, ray.direction)
    }
}

impl Pipeline for Aside {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

impl RayProgram<Distance> for Aside {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        _ray: &Ray,
        hit: &Hit,
        distance: &mut f32,
    ) -> Result<(), Exception> {
        assert_eq!(cx.depth(), 1);
        *distance = hit.t;
        Ok(())
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        distance: &mut f32,
    ) -> Result<(), Exception> {
        *distance = -1.0;
        Ok(())
    }
}

impl RayGeneration for Aside {
    type Output = f32;

    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut f32) -> Result<(), Exception> {
        cx.trace::<Distance>(&self.ray(cx.launch_index()), output)
    }

    fn generate_many(&self, batch: &mut Batch<'_, Self>, outputs: &mut [f32]) -> bool {
        if !self.at_once {
            return false;
        }
        assert_eq!(batch.len(), outputs.len());
        let contexts = (0..batch.len()).map(|k| batch.context(k));
        let rays: Vec<Ray> = contexts.map(|cx| self.ray(cx.launch_index())).collect();
        let mut hits = vec![None; rays.len()];
        batch.intersect_many(&rays, &mut hits);
        let mut found = vec![0.0; rays.len()];
        for (k, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
            let mut cx = batch.context(k);
            if cx
                .shade::<Distance>(ray, hit.as_ref(), &mut found[k])
                .is_err()
            {
                return false;
            }
            batch.count(&cx);
        }
        outputs.copy_from_slice(&found);
        true
    }
}

fn launched(at_once: bool, sound: u32) -> (Result<u64, LaunchError>, Vec<f32>) {
    let program = Aside {
        world: balls(3, StructureKind::default()),
        at_once,
        sound,
    };
    let mut output = vec![0.5; 700 * 3];
    let control = Control::default();
    let report = Cpu::all_threads().launch(&program, [700, 3, 1], &mut output, &control);
    (report.map(|report| report.rays), output)
}

#[test]
fn what_is_generated_at_once_is_what_is_generated_one_by_one() {
    let (rays, distances) = launched(true, 700);
    assert_eq!((rays.clone(), distances.clone()), launched(false, 700));
    assert_eq!(rays, Ok(2100));
    assert!(distances.iter().any(|&t| t > 0.0) && distances.contains(&-1.0));
}

#[test]
fn an_exception_is_met_where_it_belongs_and_the_others_are_done() {
    let (result, at_once) = launched(true, 650);
    let (expected, one_by_one) = launched(false, 650);
    assert_eq!(at_once, one_by_one);
    for result in [result, expected] {
        let Err(LaunchError::Exception(LaunchException { index, exception })) = result else {
            panic!("rays that are not valid are exceptions");
        };
        assert_eq!(index, [650, 0, 0]);
        assert!(matches!(exception, Exception::InvalidRay { .. }));
    }
    assert!(at_once[..650].iter().all(|&t| t != 0.5) && at_once[650] == 0.5);
}

#[test]
fn a_launch_that_is_stopped_generates_nothing_at_once_either() {
    let program = Aside {
        world: balls(1, StructureKind::default()),
        at_once: true,
        sound: 700,
    };
    let stop = AtomicBool::new(true);
    let control = Control {
        stop: Some(&stop),
        ..Control::default()
    };
    let mut output = vec![0.5; 700];
    let report = Cpu::all_threads().launch(&program, [700, 1, 1], &mut output, &control);
    let report = report.unwrap();
    assert!(report.stopped && report.rays == 0 && output.iter().all(|&t| t == 0.5));
}
