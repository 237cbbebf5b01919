//! A second ray type: shadows.
//!
//! From every place that the eye sees, one more ray goes to the light. It asks something else (is
//! anything in the way?), carries something else (yes or no), and so it is a ray type of its own,
//! with programs of its own: the any-hit program of a shadow ray ends it at the first thing met.

use ombra_accel::{Accel, AnyHit, Shapes, StructureKind};
use ombra_examples::ascii;
use ombra_geometry::shape::{Sphere, Surface};
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

const WIDTH: u32 = 72;
const HEIGHT: u32 = 28;

/// A shadow ray starts this far from the surface, so that it does not meet it again: the
/// lecture's `sceneEpsilon`. The crate `ombra-scene` derives it from rounding instead.
const SCENE_EPSILON: f32 = 1e-3;

struct Lit {
    spheres: Vec<Sphere>,
    to_light: Vector3,
    world: Accel<Shapes>,
}

impl Pipeline for Lit {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = f32;
    const NAME: &'static str = "radiance";
}

enum Shadow {}
impl RayType for Shadow {
    type Payload = bool;
    const NAME: &'static str = "shadow";
}

impl RayProgram<Radiance> for Lit {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        shade: &mut f32,
    ) -> Result<(), Exception> {
        let point = ray.at(hit.t);
        let sphere = &self.spheres[hit.primitive.index()];
        let normal = sphere.surface_at(point.wide()).normal.cast();
        let facing: f32 = normal.dot(self.to_light);
        let mut blocked = facing <= 0.0;
        if !blocked {
            let shadow = Ray {
                t_min: SCENE_EPSILON,
                ..Ray::new(point, self.to_light)
            };
            cx.trace::<Shadow>(&shadow, &mut blocked)?;
        }
        *shade = if blocked { 0.1 } else { 0.1 + 0.9 * facing };
        Ok(())
    }
}

impl RayProgram<Shadow> for Lit {
    fn any_hit(&self, _ray: &Ray, _hit: &Hit, blocked: &mut bool) -> AnyHit {
        *blocked = true;
        AnyHit::Terminate
    }
}

impl RayGeneration for Lit {
    type Output = f32;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut f32) -> Result<(), Exception> {
        let [x, y, _] = cx.launch_index();
        let right = (x as f32 + 0.5) / WIDTH as f32 - 0.5;
        let down = (y as f32 + 0.5) / HEIGHT as f32;
        let direction = Vector3::new(1.2 * right, -0.1 - 0.9 * down, -1.0);
        let eye = Point3::new(0.0, 4.0, 6.0);
        cx.trace::<Radiance>(&Ray::new(eye, direction), output)
    }
}

/// The shades of the picture, and how many rays they took.
fn launch() -> anyhow::Result<(Vec<f32>, u64)> {
    let spheres = vec![
        Sphere::new(Point3::new(0.0, -1000.0, 0.0), 1000.0),
        Sphere::new(Point3::new(0.0, 1.2, 0.0), 1.0),
    ];
    let shapes = spheres.iter().copied().map(Into::into).collect();
    let program = Lit {
        to_light: Vector3::new(-0.6, 0.8, 0.0),
        world: Accel::build(Shapes(shapes), StructureKind::default()),
        spheres,
    };
    let mut shades = vec![0.0; (WIDTH * HEIGHT) as usize];
    let size = [WIDTH, HEIGHT, 1];
    let report = Cpu::all_threads().launch(&program, size, &mut shades, &Control::default())?;
    Ok((shades, report.rays))
}

fn main() -> anyhow::Result<()> {
    let (shades, rays) = launch()?;
    print!("{}", ascii(WIDTH as usize, &shades));
    println!("{rays} rays for {} pixels", shades.len());
    Ok(())
}

#[test]
fn the_ball_throws_a_shadow_away_from_the_light() -> anyhow::Result<()> {
    let (shades, rays) = launch()?;
    let (pixels, width) = (u64::from(WIDTH * HEIGHT), WIDTH as usize);
    assert!(
        pixels < rays && rays <= 2 * pixels,
        "at most one shadow ray a pixel"
    );
    let row = &shades[17 * width..18 * width];
    let dark = |half: &[f32]| half.iter().filter(|&&shade| shade == 0.1).count();
    // The light is on the left.
    assert!(dark(&row[width / 2..]) > dark(&row[..width / 2]) + 5);
    Ok(())
}
