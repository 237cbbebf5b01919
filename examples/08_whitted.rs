//! Whitted's ray tracer: programs that trace.
//!
//! The closest-hit program adds three things up: the local light, what the mirror shows, and
//! (elsewhere) what shines through. The mirror shows whatever another ray finds, so the program
//! traces one: that is the recursion of the lecture's `trace(point, direction, step)`. It ends
//! where the step is too deep, or where what a ray could still add is too little to see: that is
//! what `importance` in the lecture's payload is for.

use ombra_accel::{Accel, AnyHit, Shapes, StructureKind};
use ombra_examples::write_ppm;
use ombra_geometry::shape::{Sphere, Surface};
use ombra_geometry::{Hit, Normal3, Point3, Ray, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 200;
const MAX_STEP: u32 = 6;
const SCENE_EPSILON: f32 = 1e-3;

/// A colour, and how much of the mirror it shows.
struct Paint {
    colour: [f32; 3],
    mirror: f32,
}

struct Whitted {
    spheres: Vec<Sphere>,
    paints: Vec<Paint>,
    to_light: Vector3,
    world: Accel<Shapes>,
}

/// The lecture's per-ray data; its depth is [`Context::depth`].
struct PerRayData {
    result: [f32; 3],
    importance: f32,
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = PerRayData;
    const NAME: &'static str = "radiance";
}

enum Shadow {}
impl RayType for Shadow {
    type Payload = bool;
    const NAME: &'static str = "shadow";
}

impl Pipeline for Whitted {
    type World = Accel<Shapes>;
    fn world(&self) -> &Accel<Shapes> {
        &self.world
    }
}

impl Whitted {
    /// Phong's local term: even scattering and a highlight, if the light is seen at all.
    fn local(&self, cosine: f32, highlight: f32, colour: [f32; 3]) -> [f32; 3] {
        colour.map(|c| c * (0.1 + 0.9 * cosine.max(0.0)) + 0.4 * highlight.max(0.0).powi(40))
    }
}

impl RayProgram<Radiance> for Whitted {
    fn closest_hit(
        &self,
        cx: &mut Context<'_, Self>,
        ray: &Ray,
        hit: &Hit,
        prd: &mut PerRayData,
    ) -> Result<(), Exception> {
        let point = ray.at(hit.t);
        let sphere = &self.spheres[hit.primitive.index()];
        let normal: Normal3 = sphere.surface_at(point.wide()).normal.cast();
        let mut paint = self.paints[hit.primitive.index()].colour;
        // The ground, which is the first sphere, is chequered.
        let odd = (point.x.floor() + point.z.floor()).rem_euclid(2.0) != 0.0;
        if hit.primitive.0 == 0 && odd {
            paint = paint.map(|c| 0.3 * c);
        }
        let from_here = |direction| Ray {
            t_min: SCENE_EPSILON,
            ..Ray::new(point, direction)
        };
        let mirrored = ray.direction.reflect(normal);

        let mut blocked = false;
        cx.trace::<Shadow>(&from_here(self.to_light), &mut blocked)?;
        prd.result = if blocked {
            self.local(0.0, 0.0, paint)
        } else {
            self.local(
                normal.dot(self.to_light),
                mirrored.dot(self.to_light),
                paint,
            )
        };

        let mirror = self.paints[hit.primitive.index()].mirror;
        let importance = prd.importance * mirror;
        if cx.depth() < MAX_STEP && importance > 0.01 {
            let mut reflected = PerRayData {
                result: [0.0; 3],
                importance,
            };
            cx.trace::<Radiance>(&from_here(mirrored), &mut reflected)?;
            for (sum, seen) in prd.result.iter_mut().zip(reflected.result) {
                *sum += mirror * seen;
            }
        }
        Ok(())
    }

    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        ray: &Ray,
        prd: &mut PerRayData,
    ) -> Result<(), Exception> {
        let up = ray.direction.y.max(0.0);
        prd.result = [0.8 - 0.5 * up, 0.9 - 0.4 * up, 1.0];
        Ok(())
    }
}

impl RayProgram<Shadow> for Whitted {
    fn any_hit(&self, _ray: &Ray, _hit: &Hit, blocked: &mut bool) -> AnyHit {
        *blocked = true;
        AnyHit::Terminate
    }
}

impl RayGeneration for Whitted {
    type Output = [f32; 3];
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut [f32; 3]) -> Result<(), Exception> {
        let [x, y, _] = cx.launch_index();
        let right = (x as f32 + 0.5) / WIDTH as f32 - 0.5;
        let up = (0.5 - (y as f32 + 0.5) / HEIGHT as f32) * HEIGHT as f32 / WIDTH as f32;
        let direction = Vector3::new(right, up - 0.12, -0.8);
        let eye = Point3::new(0.0, 1.5, 5.0);
        let ray = Ray::new(eye, direction.normalized().unwrap_or(direction));
        let mut prd = PerRayData {
            result: [0.0; 3],
            importance: 1.0,
        };
        cx.trace::<Radiance>(&ray, &mut prd)?;
        *output = prd.result;
        Ok(())
    }
}

/// The picture, and how many rays it took.
fn launch(mirrors: bool) -> anyhow::Result<(Vec<[f32; 3]>, u64)> {
    let things = [
        ([0.0, -1000.0, 0.0], 1000.0, [0.8, 0.8, 0.7], 0.05),
        ([-1.1, 1.0, 0.0], 1.0, [0.1, 0.1, 0.1], 0.8),
        ([1.1, 0.8, 0.4], 0.8, [0.8, 0.2, 0.1], 0.2),
        ([0.2, 0.35, 1.6], 0.35, [0.1, 0.3, 0.8], 0.3),
    ];
    let sphere = |([x, y, z], r, ..): &([f32; 3], f32, [f32; 3], f32)| {
        Sphere::new(Point3::new(*x, *y, *z), *r)
    };
    let spheres: Vec<_> = things.iter().map(sphere).collect();
    let paint = |&(_, _, colour, mirror): &([f32; 3], f32, [f32; 3], f32)| Paint {
        colour,
        mirror: if mirrors { mirror } else { 0.0 },
    };
    let shapes = spheres.iter().copied().map(Into::into).collect();
    let program = Whitted {
        paints: things.iter().map(paint).collect(),
        to_light: Vector3::new(0.48, 0.8, 0.36),
        world: Accel::build(Shapes(shapes), StructureKind::default()),
        spheres,
    };
    let mut picture = vec![[0.0; 3]; (WIDTH * HEIGHT) as usize];
    let size = [WIDTH, HEIGHT, 1];
    let report = Cpu::all_threads().launch(&program, size, &mut picture, &Control::default())?;
    Ok((picture, report.rays))
}

fn main() -> anyhow::Result<()> {
    let (picture, rays) = launch(true)?;
    let path = write_ppm("08_whitted", WIDTH as usize, &picture)?;
    println!(
        "{rays} rays for {} pixels; wrote {}",
        picture.len(),
        path.display()
    );
    Ok(())
}

#[test]
fn the_mirror_shows_what_is_not_in_front_of_it() -> anyhow::Result<()> {
    let (mirrors, rays) = launch(true)?;
    let (matt, fewer) = launch(false)?;
    assert!(rays > fewer);
    // A little above the middle of the mirror ball, and a piece of sky that no ball hides.
    let at = |picture: &[[f32; 3]], x: u32, y: u32| picture[(y * WIDTH + x) as usize];
    assert!(at(&mirrors, 104, 80)[2] > at(&matt, 104, 80)[2] + 0.2);
    assert_eq!(at(&mirrors, 2, 2), at(&matt, 2, 2));
    Ok(())
}
