//! A city: a box a lot, 30 % of them turned, on undulating ground.

use ombra_geometry::{MeshError, Point3, TriangleMesh};

use super::builder::{Builder, circle};
use crate::random::Random;

/// How wide a lot is.
const LOT: f32 = 10.0;

/// With `lots²` boxes of 12 triangles and `lots²/4` quads of ground. 400 give two millions.
pub(super) fn mesh(lots: u32) -> Result<TriangleMesh, MeshError> {
    let mut city = Builder::default();
    let mut random = Random::new(7);
    for j in 0..lots {
        for i in 0..lots {
            building(&mut city, &mut random, [i, j], lots);
        }
    }
    let side = LOT * lots as f32;
    let quads = lots / 2;
    city.sheet(quads, quads, |u, v| {
        let height = wave(u * quads as f32 * 0.06) + wave(v * quads as f32 * 0.037 + 0.5);
        Point3::new(u * side, 0.25 * height, v * side)
    });
    city.finish()
}

fn building(city: &mut Builder, random: &mut Random, [i, j]: [u32; 2], lots: u32) {
    let middle = [i, j].map(|i| LOT * (i as f32 + 0.5));
    let half = [(); 2].map(|()| random.between(2.0, 4.2));
    // Towers stand in the middle of the city, most of them low.
    let away = middle.map(|x| x * 2.0 / (LOT * lots as f32) - 1.0);
    let near = 1.0 - (away[0] * away[0] + away[1] * away[1]).sqrt().min(1.0);
    let tall = random.unit();
    let height = random.between(3.0, 15.0) + near * near * 60.0 * tall * tall * tall;
    let turned = random.unit() < 0.3;
    let turn = random.unit() * 0.25;
    // Turned ones are smaller, so that they stay on their lots.
    let ([c, s], size) = if turned {
        (circle(turn), 0.75)
    } else {
        ([1.0, 0.0], 1.0)
    };
    city.hexahedron(|x, y, z| {
        let side = |upper, half: f32| if upper { half * size } else { -half * size };
        let (x, z) = (side(x, half[0]), side(z, half[1]));
        Point3::new(
            middle[0] + x * c - z * s,
            if y { height } else { 0.0 },
            middle[1] + x * s + z * c,
        )
    });
}

/// Up and down between −1 and 1 once a unit, of products alone.
fn wave(x: f32) -> f32 {
    let x = 2.0 * x.rem_euclid(1.0) - 1.0;
    4.0 * x * (1.0 - x.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lot_has_a_box_and_ground() {
        let mesh = mesh(20).unwrap();
        assert_eq!(mesh.triangles().len(), 400 * 12 + 100 * 2);
        assert!(mesh.bounds().is_finite());
    }

    #[test]
    fn the_whole_city_has_two_million_triangles() {
        assert_eq!(400 * 400 * 12 + 200 * 200 * 2, 2_000_000);
    }
}
