//! The lecture's program: how long does each place of a city lie in shadow?
//!
//! After "Shadow Accrual Maps: Efficient Accumulation of City-Scale Shadows Over Time" (Miranda et
//! al., 2019), line by line as the lecture shows it: a point buffer, a direction buffer, one launch
//! a direction, one ray a point. Whatever the ray meets, the result is 1 and the ray ends; if it
//! meets nothing, the result is 0. The output buffer adds the results up.

use std::f32::consts::PI;

use ombra_accel::{Accel, AnyHit, Mesh, StructureKind};
use ombra_examples::ascii;
use ombra_geometry::{Hit, Point3, Ray, TriangleMesh, Vector3};
use ombra_pipeline::{
    Context, Control, Cpu, Exception, Pipeline, RayGeneration, RayProgram, RayType,
};

const WIDTH: usize = 72;
const HEIGHT: usize = 30;
const SCENE_EPSILON: f32 = 1e-3;

/// The lecture's context: buffers and the top object.
struct City {
    point_buffer: Vec<Point3>,
    direction_buffer: Vec<Vector3>,
    /// Which direction this launch is for: the lecture's `i`.
    i: usize,
    top_object: Accel<Mesh>,
}

impl Pipeline for City {
    type World = Accel<Mesh>;
    fn world(&self) -> &Accel<Mesh> {
        &self.top_object
    }
}

/// The lecture's `PerRayData_radiance`.
#[derive(Default)]
struct PerRayData {
    result: f32,
}

enum Radiance {}
impl RayType for Radiance {
    type Payload = PerRayData;
    const NAME: &'static str = "radiance";
}

impl RayGeneration for City {
    type Output = f32;
    fn generate(&self, cx: &mut Context<'_, Self>, output: &mut f32) -> Result<(), Exception> {
        let pos = *cx.element(&self.point_buffer, cx.launch_index()[0] as usize)?;
        let dir = *cx.element(&self.direction_buffer, self.i)?;
        let ray = Ray {
            t_min: SCENE_EPSILON,
            ..Ray::new(pos, dir)
        };
        let mut prd = PerRayData::default();
        cx.trace::<Radiance>(&ray, &mut prd)?;
        *output += prd.result;
        Ok(())
    }
}

impl RayProgram<Radiance> for City {
    fn miss(
        &self,
        _cx: &mut Context<'_, Self>,
        _ray: &Ray,
        prd: &mut PerRayData,
    ) -> Result<(), Exception> {
        prd.result = 0.0;
        Ok(())
    }

    fn any_hit(&self, _ray: &Ray, _hit: &Hit, prd: &mut PerRayData) -> AnyHit {
        prd.result = 1.0;
        AnyHit::Terminate
    }
    // The lecture's closest-hit program does the same again; any hit has already done it.
}

/// Houses as boxes on the ground: west, south, width, depth and height. x is east, y north, z up.
const HOUSES: [[f32; 5]; 5] = [
    [10.0, 6.0, 6.0, 4.0, 8.0],
    [24.0, 12.0, 4.0, 4.0, 16.0],
    [36.0, 5.0, 10.0, 3.0, 5.0],
    [40.0, 16.0, 5.0, 5.0, 10.0],
    [56.0, 9.0, 4.0, 8.0, 7.0],
];

fn houses() -> anyhow::Result<Mesh> {
    // The corners of a box are numbered by their bits: 1 is east, 2 is north, 4 is up.
    const SIDES: [[u32; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let (mut corners, mut triangles) = (vec![], vec![]);
    for [x, y, width, depth, height] in HOUSES {
        let first = corners.len() as u32;
        for bits in 0..8_u8 {
            let far = |bit: u8, length: f32| if bits & bit == 0 { 0.0 } else { length };
            corners.push(Point3::new(
                x + far(1, width),
                y + far(2, depth),
                far(4, height),
            ));
        }
        for [a, b, c, d] in SIDES.map(|side| side.map(|corner| corner + first)) {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Ok(Mesh::new(TriangleMesh::new(corners, triangles)?))
}

/// Toward the sun, hour by hour from 6 to 18, on a day when it culminates at 50° in the south.
fn sun() -> Vec<Vector3> {
    let (sin, cos) = 50_f32.to_radians().sin_cos();
    let hour = |h: u8| {
        // From east (0) over south to west (π) along a tilted circle.
        let way = PI * f32::from(h - 6) / 12.0;
        Vector3::new(way.cos(), -way.sin() * cos, way.sin() * sin)
    };
    // At 6 and at 18 the sun is on the horizon; those hours do not count.
    (7..18).map(hour).collect()
}

/// Hours in shadow for each point of the ground, north at the top.
fn accrue() -> anyhow::Result<Vec<f32>> {
    let ground = |i| {
        let (column, row) = (i % WIDTH, i / WIDTH);
        Point3::new(column as f32 + 0.5, (HEIGHT - row) as f32 - 0.5, 0.0)
    };
    let mut city = City {
        point_buffer: (0..WIDTH * HEIGHT).map(ground).collect(),
        direction_buffer: sun(),
        i: 0,
        top_object: Accel::build(houses()?, StructureKind::default()),
    };
    let mut output_buffer = vec![0.0; city.point_buffer.len()];
    let size = [city.point_buffer.len() as u32, 1, 1];
    let cpu = Cpu::all_threads();
    for i in 0..city.direction_buffer.len() {
        city.i = i;
        cpu.launch(&city, size, &mut output_buffer, &Control::default())?;
    }
    Ok(output_buffer)
}

fn main() -> anyhow::Result<()> {
    let hours = accrue()?;
    let all = sun().len() as f32;
    let shades: Vec<_> = hours.iter().map(|hours| hours / all).collect();
    print!("{}", ascii(WIDTH, &shades));
    println!("hours in shadow of {all}: blank is none, @ is all; north is up");
    let sum: f32 = hours.iter().sum();
    println!("{:.2} on average", sum / hours.len() as f32);
    Ok(())
}

#[test]
fn shadow_hours_are_where_the_sun_says() -> anyhow::Result<()> {
    let hours = accrue()?;
    let at = |east: usize, north: usize| hours[(HEIGHT - 1 - north) * WIDTH + east];
    let all = sun().len() as f32;
    assert!(
        hours
            .iter()
            .all(|&h| (0.0..=all).contains(&h) && h.fract() == 0.0)
    );
    // Beneath a house it is always dark, far south of all it never is.
    assert_eq!(at(12, 7), all);
    assert_eq!(at(30, 0), 0.0);
    // The tower is 16 high. At noon its shadow is 16 / tan 50° = 13.4 long, so it ends at 29.4.
    let noon = |north: f32| {
        let dir = sun()[5];
        let shadow_end = 16.0 + 16.0 * -dir.y / dir.z;
        north < shadow_end
    };
    assert!(noon(29.0) && !noon(30.0));
    assert!(at(26, 28) >= 1.0);
    // Nearer to the wall it is dark for longer.
    assert!(at(26, 17) > at(26, 28));
    Ok(())
}
