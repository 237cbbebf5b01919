//! What goes wrong in a program, and where.
//!
//! A ray without direction, an index past the end of a buffer, a recursion without end: on a
//! device these are exceptions, and the exception program is told at which launch index. It may
//! write something into the picture that nobody overlooks, and let the launch go on; or it may let
//! the launch fail, and then the one with the smallest index is reported, whatever the number of
//! threads.

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, LaunchError, LaunchException, Pipeline, RayGeneration,
    RayProgram, RayType,
};

const MAGENTA: [f32; 3] = [1.0, 0.0, 1.0];

struct Faulty {
    /// One entry too few.
    directions: Vec<Vector3>,
    /// Whether exceptions become magenta, or fail the launch.
    settle: bool,
    world: Accel<Shapes>,
}

impl Pipeline for Faulty {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
    fn max_trace_depth(&self) -> u32 {
        4
    }
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = [f32; 3];
    const NAME: &'static str = "radiance";
}

impl RayProgram<Radiance> for Faulty {
    /// Inside the ball, where rays along z start from, a hit looks back for ever.
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        _hit: &Hit,
        colour: &mut [f32; 3],
    ) -> Result<(), Exception> {
        if ray.direction.y > 0.0 {
            return Err(Exception::user(7, "nobody should look up"));
        }
        if ray.direction.z != 0.0 {
            return cx.trace::<Radiance>(&Ray::new(ray.origin, -ray.direction), colour);
        }
        *colour = [0.0, 1.0, 0.0];
        Ok(())
    }
}

impl RayGeneration for Faulty {
    type Output = [f32; 3];
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut [f32; 3]) -> Result<(), Exception> {
        let direction = *cx.element(&self.directions, cx.launch_index()[0] as usize)?;
        cx.trace::<Radiance>(&Ray::new(Point3::ORIGIN, direction), output)
    }

    fn exception(
        &self,
        exception: LaunchException,
        output: &mut [f32; 3],
    ) -> Result<(), LaunchException> {
        if !self.settle {
            return Err(exception);
        }
        println!("settled {exception}");
        *output = MAGENTA;
        Ok(())
    }
}

fn launch(settle: bool) -> (Result<u64, LaunchError>, Vec<[f32; 3]>) {
    let ball = Sphere::new(Point3::ORIGIN, 1.0);
    let program = Faulty {
        directions: vec![
            Vector3::X,
            Vector3::ZERO,
            Vector3::Z,
            Vector3::Y,
            -Vector3::X,
        ],
        settle,
        world: Accel::build(Shapes(vec![ball.into()]), StructureKind::default()),
    };
    let mut output = vec![[0.0; 3]; 6];
    let report = Cpu::all_threads().launch(&program, [6, 1, 1], &mut output, &Control::default());
    (report.map(|report| report.indices), output)
}

fn main() {
    println!("Each exception settled:");
    let (report, picture) = launch(true);
    println!("  the launch: {report:?}\n  the picture: {picture:?}\n");
    println!("None settled:");
    if let (Err(error), _) = launch(false) {
        println!("  the launch failed {error}");
    }
}

#[test]
fn four_of_six_go_wrong_each_in_its_own_way() {
    let (report, picture) = launch(true);
    assert_eq!(report, Ok(6));
    let wrong: Vec<_> = picture.iter().map(|&colour| colour == MAGENTA).collect();
    assert_eq!(wrong, [false, true, true, true, false, true]);

    let (failed, picture) = launch(false);
    let text = failed.unwrap_err().to_string();
    assert!(
        text.starts_with("at launch index (1, 0, 0): invalid radiance ray"),
        "{text}"
    );
    assert_eq!(picture[4], [0.0, 1.0, 0.0], "the others were done");
}
