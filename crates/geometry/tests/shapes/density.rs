//! Areas and samples, by the formula of Cauchy and Crofton: of lines drawn evenly through a ball, the
//! mean number of crossings with a surface inside is its area over 2 π times the square of the
//! ball's radius, and the crossings are spread over the surface evenly. So the crossings, which are
//! held against the reference already, measure the area and are what samples must be spread like.

use std::collections::HashMap;
use std::f64::consts::PI;

use ombra_geometry::shape::Surface;
use ombra_geometry::{Point3, Ray};

use crate::random::Random;
use crate::reference::{Case, cases};
use crate::{extent, gradient};

const LINES: usize = 30_000;

/// Crossings with lines that are spread evenly over a ball around the shape, and that ball's radius.
fn even_crossings(case: &Case, random: &mut Random) -> (Vec<Point3<f64>>, f64) {
    let (centre, reach) = extent(case);
    let radius = reach * 1.01;
    let mut found = Vec::new();
    for _ in 0..LINES {
        let direction = random.direction();
        let (x, y) = direction.orthonormal_basis();
        let (out, angle) = (random.unit().sqrt() * radius, random.between(0.0, 2.0 * PI));
        let across = (x * angle.cos() + y * angle.sin()) * out;
        let ray = Ray::new(centre + across - direction * (2.0 * radius), direction);
        found.extend(case.shape.crossings(&ray).iter().map(|c| ray.at(c.t)));
    }
    (found, radius)
}

/// Those shapes that have an area.
fn finite_cases() -> impl Iterator<Item = Case> {
    let all = (0..4).flat_map(|set| cases(set * 17 + 3));
    all.filter(|case| case.shape.area().is_finite())
}

#[test]
fn areas_are_what_lines_measure() {
    for case in finite_cases() {
        let (crossings, radius) = even_crossings(&case, &mut Random(5));
        let mean = crossings.len() as f64 / LINES as f64;
        let (area, measured) = (case.shape.area(), mean * 2.0 * PI * radius * radius);
        // Crossings come in up to four a line, so their number varies more than Poisson's.
        let deviation = 2.0 / (crossings.len() as f64).sqrt();
        let off = (measured / area - 1.0).abs();
        assert!(
            off < 4.0 * deviation,
            "{}: {area}, not {measured}: {:?}",
            case.name,
            case.shape
        );
    }
}

#[test]
fn samples_are_on_the_surface_with_its_normal() {
    for case in finite_cases() {
        let (centre, reach) = extent(&case);
        let tolerance = 1e-9 * reach + 1e-13 * (centre - Point3::new(0.0, 0.0, 0.0)).length();
        let bounds = case.shape.bounds().wide().padded(tolerance);
        let random = &mut Random(11);
        let corners = [
            [0.0, 0.0],
            [0.0, 1.0_f32.next_down()],
            [1.0_f32.next_down(), 0.5],
        ];
        for xi in (0..2000).map(|_| random.xi()).chain(corners) {
            let sample = case.shape.sample(xi).unwrap();
            let (off, out) = ((case.carrier)(sample.point), (case.domain)(sample.point));
            assert!(
                off.abs() < tolerance && out < tolerance,
                "{}: {off}, {out}",
                case.name
            );
            assert!(bounds.contains(sample.point), "{}", case.name);
            assert_eq!(sample.pdf, 1.0 / case.shape.area());
            if let Some(gradient) = gradient(&case, sample.point) {
                assert!(sample.normal.dot(gradient) > 1.0 - 1e-4, "{}", case.name);
            }
        }
    }
}

#[test]
fn samples_are_spread_like_crossings() {
    for case in finite_cases() {
        let random = &mut Random(23);
        let (crossings, _) = even_crossings(&case, random);
        let samples = (0..crossings.len()).map(|_| case.shape.sample(random.xi()).unwrap().point);
        // Counted in the cells of a lattice over the bounds, which cuts caps, faces and sides.
        let bounds = case.shape.bounds().wide();
        let size = bounds.extent().max_norm() * 1.001;
        let cell = |p: Point3<f64>| {
            let part = (p - bounds.min) / size * 5.0 + random_shift();
            part.to_array().map(|x| x.floor() as i32)
        };
        let mut counts: HashMap<[i32; 3], [f64; 2]> = HashMap::new();
        for point in samples {
            counts.entry(cell(point)).or_default()[0] += 1.0;
        }
        for &point in &crossings {
            counts.entry(cell(point)).or_default()[1] += 1.0;
        }
        // Two samples of equal size: (a − b)² / (a + b) adds up to χ². Small cells are put together.
        let (mut chi, mut cells, mut rest) = (0.0, 0.0, [0.0, 0.0]);
        let mut add = |[a, b]: [f64; 2]| {
            chi += (a - b) * (a - b) / (a + b);
            cells += 1.0;
        };
        for &[a, b] in counts.values() {
            if a + b >= 40.0 {
                add([a, b]);
            } else {
                rest = [rest[0] + a, rest[1] + b];
            }
        }
        if rest[0] + rest[1] > 0.0 {
            add(rest);
        }
        // Crossings of one line go together, which widens the distribution a little.
        let limit = 1.5 * (cells + 4.0 * (2.0_f64 * cells).sqrt());
        assert!(
            chi < limit,
            "{}: χ² {chi} over {cells} cells: {:?}",
            case.name,
            case.shape
        );
    }
}

/// Moves the lattice so that no face lies along a boundary between cells.
fn random_shift() -> ombra_geometry::Vector3<f64> {
    ombra_geometry::Vector3::new(0.37, 0.61, 0.23)
}
