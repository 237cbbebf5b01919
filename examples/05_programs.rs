//! The first ray programs: what a hit means, what a miss means.
//!
//! So far a loop asked for hits and looked at the answers. Turned around, one writes small
//! programs and the engine calls them: ray generation once a pixel, then closest hit or miss once a
//! ray. This is the shape of OptiX; what the programs share is one struct, what a ray carries is
//! its payload.

use ombra_accel::{Accel, Shapes, StructureKind};
use ombra_examples::write_ppm;
use ombra_geometry::shape::Sphere;
use ombra_geometry::{Hit, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

const SIZE: u32 = 128;

/// What the programs share.
struct Picture {
    world: Accel<Shapes>,
}

impl Pipeline for Picture {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

/// The one kind of ray here. It carries a colour back.
enum Radiance {}
impl RayType for Radiance {
    type Payload = [f32; 3];
    const NAME: &'static str = "radiance";
}

impl RayProgram<Radiance> for Picture {
    /// A hit shows its place on the sphere, as two colours.
    fn closest_hit(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        hit: &Hit,
        colour: &mut [f32; 3],
    ) -> Result<(), Exception> {
        *colour = [hit.u, hit.v, 0.5];
        Ok(())
    }

    /// A miss shows the sky.
    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        colour: &mut [f32; 3],
    ) -> Result<(), Exception> {
        let up = 0.5 + ray.direction.y;
        *colour = [1.0 - 0.5 * up, 1.0 - 0.3 * up, 1.0];
        Ok(())
    }
}

impl RayGeneration for Picture {
    type Output = [f32; 3];
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut [f32; 3]) -> Result<(), Exception> {
        let [x, y, _] = cx.launch_index();
        let place = |i: u32| (i as f32 + 0.5) / SIZE as f32 - 0.5;
        let direction = Vector3::new(place(x), -place(y), -1.0);
        cx.trace::<Radiance>(&Ray::new(Point3::ORIGIN, direction), output)
    }
}

fn launch() -> anyhow::Result<Vec<[f32; 3]>> {
    let ball = Sphere::new(Point3::new(0.0, 0.0, -3.0), 1.0);
    let program = Picture {
        world: Accel::build(Shapes(vec![ball.into()]), StructureKind::default()),
    };
    let mut picture = vec![[0.0; 3]; (SIZE * SIZE) as usize];
    let size = [SIZE, SIZE, 1];
    let report = Cpu::all_threads().launch(&program, size, &mut picture, &Control::default())?;
    println!("{} rays", report.rays);
    Ok(picture)
}

fn main() -> anyhow::Result<()> {
    let picture = launch()?;
    let path = write_ppm("05_programs", SIZE as usize, &picture)?;
    println!("wrote {}", path.display());
    Ok(())
}

#[test]
fn hits_and_misses_have_their_colours() -> anyhow::Result<()> {
    let picture = launch()?;
    let hits = picture.iter().filter(|colour| colour[2] == 0.5).count();
    // Seen from three radii away the ball is a circle of radius tan(asin(1/3)) on a screen of 1.
    let circle = std::f32::consts::PI / 8.0;
    let expected = circle * (SIZE * SIZE) as f32;
    assert!(
        (hits as f32 - expected).abs() < 0.01 * expected,
        "{hits}, not {expected}"
    );
    assert_eq!(picture[0][2], 1.0, "the sky is in the corner");
    Ok(())
}
