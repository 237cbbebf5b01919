//! Several ray types, each with a payload of its own, and traces within traces.

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    AnyHit, Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

use crate::row::{along, balls};

/// Looks along the row; where it hits, asks for a shadow, and looks on from there.
struct Looking {
    world: Accel<Shapes>,
    limit: u32,
    /// What each hit does when it cannot look any further.
    settle: bool,
}

/// What a look brings back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Seen {
    hits: u32,
    shadows: u32,
    deepest: u32,
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = Seen;
    const NAME: &'static str = "radiance";
}

enum Shadow {}
impl RayType for Shadow {
    type Payload = bool;
    const NAME: &'static str = "shadow";
}

impl Pipeline for Looking {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
    fn max_trace_depth(&self) -> u32 {
        self.limit
    }
}

impl RayProgram<Radiance> for Looking {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        seen: &mut Seen,
    ) -> Result<(), Exception> {
        let depth = cx.depth();
        seen.hits += 1;
        seen.deepest = depth;
        let from = |direction| Ray {
            t_min: 0.01,
            ..Ray::new(ray.at(hit.t), direction)
        };
        let mut blocked = false;
        match cx.trace::<Shadow>(&from(-Vector3::X), &mut blocked) {
            Err(Exception::DepthExceeded { .. }) if self.settle => return Ok(()),
            result => result?,
        }
        seen.shadows += u32::from(blocked);
        let result = cx.trace::<Radiance>(&from(Vector3::X), seen);
        assert_eq!(cx.depth(), depth, "a trace leaves the depth as it was");
        result
    }
}

impl RayProgram<Shadow> for Looking {
    fn any_hit(&self, _ray: &Ray, _hit: &Hit, blocked: &mut bool) -> AnyHit {
        *blocked = true;
        AnyHit::Terminate
    }
}

impl RayGeneration for Looking {
    type Output = Seen;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut Seen) -> Result<(), Exception> {
        assert_eq!((cx.depth(), cx.rays()), (0, 0));
        let result = cx.trace::<Radiance>(&along(), output);
        assert_eq!(cx.depth(), 0);
        result
    }
}

/// A second way in: only how far it is to the first ball.
enum Distance {}
impl RayGeneration<Distance> for Looking {
    type Output = f32;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut f32) -> Result<(), Exception> {
        let mut blocked = false;
        let x = cx.launch_index()[0] as f32;
        let segment = Ray::between(Point3::ORIGIN, Point3::new(x, 0.0, 0.0));
        cx.trace::<Shadow>(&segment, &mut blocked)?;
        *output = if blocked { 1.5 } else { f32::INFINITY };
        Ok(())
    }
}

fn look(limit: u32, settle: bool) -> Result<(Seen, u64), Exception> {
    let world = balls(2, StructureKind::default());
    let looking = Looking {
        world,
        limit,
        settle,
    };
    let mut output = [Seen::default()];
    let report =
        Cpu::all_threads().launch::<(), _>(&looking, [1, 1, 1], &mut output, &Control::default());
    match report {
        Ok(report) => Ok((output[0], report.rays)),
        Err(ombra_pipeline::LaunchError::Exception(e)) => Err(e.exception),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn rays_of_two_types_nest_and_keep_their_payloads_apart() {
    // Four surfaces. The first one's shadow ray goes back to the origin and meets nothing.
    let (seen, rays) = look(16, false).unwrap();
    let expected = Seen {
        hits: 4,
        shadows: 3,
        deepest: 4,
    };
    assert_eq!(seen, expected);
    // The first look, then from each of four hits a shadow ray and another look.
    assert_eq!(rays, 1 + 4 * 2);
}

#[test]
fn a_trace_beyond_the_depth_of_the_pipeline_is_an_exception() {
    assert!(look(5, false).is_ok());
    for limit in [0, 1, 4] {
        assert_eq!(look(limit, false), Err(Exception::DepthExceeded { limit }));
    }
}

#[test]
fn whoever_traces_may_settle_an_exception_and_go_on() {
    let (seen, rays) = look(2, true).unwrap();
    assert_eq!((seen.hits, seen.deepest), (2, 2));
    assert_eq!(rays, 3, "a trace that was refused is no ray");
}

#[test]
fn a_pipeline_can_have_several_entry_points() {
    let looking = Looking {
        world: balls(1, StructureKind::default()),
        limit: 1,
        settle: false,
    };
    let mut output = [0.0; 3];
    // Index 0 traces from the origin to itself: a ray without a direction.
    let error = Cpu::all_threads()
        .launch::<Distance, _>(&looking, [3, 1, 1], &mut output, &Control::default())
        .unwrap_err();
    assert!(error.to_string().contains("invalid shadow ray"));
    assert_eq!(output, [0.0, f32::INFINITY, 1.5]);
}
