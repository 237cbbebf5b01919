//! Who is right: every triangle is tested in double precision.

use ombra_geometry::{Point3, Ray, TriangleMesh, Vector3};
use rayon::prelude::*;

/// How far, in barycentric coordinates and as a share of t, an answer may be off and still be wrong
/// only by a hair.
const HAIR: f64 = 1e-5;

/// By which share of t two distances may differ and still be the same.
const SAME: f64 = 1e-4;

/// By which share of a scene's diagonal distances are taken for as short as they can be.
const LEAST: f64 = 1e-6;

/// How finely distances can be told in a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fineness {
    /// Below this t, differences count as if t were this.
    pub(super) least: f64,
    /// What single precision rounds of coordinates as large as the scene: an answer that is off by
    /// less is wrong by a hair only.
    pub(super) rounding: f64,
}

impl Fineness {
    /// Of a scene whose box has a diagonal of this length.
    pub(super) fn of(diagonal: f32) -> Self {
        let diagonal = f64::from(diagonal);
        Self {
            least: LEAST * diagonal,
            rounding: f64::from(f32::EPSILON) * diagonal,
        }
    }
}

/// Triangles that a thread takes at a time.
const CHUNK: usize = 1 << 13;

/// The distance of the closest hit, or whether there is any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Answer {
    Miss,
    /// At this t.
    At(f32),
    /// Somewhere.
    Blocked,
}

impl Answer {
    /// Whether two tracers say the same.
    pub(super) fn agrees(self, other: Self, fineness: Fineness) -> bool {
        match (self, other) {
            (Self::At(a), Self::At(b)) => same(a.into(), b.into(), fineness.least),
            (a, b) => a == b,
        }
    }
}

fn same(a: f64, b: f64, least: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs()).max(least)
}

/// How an answer stands before the judge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Right,
    /// It would be right if triangles were larger or smaller by a hair.
    ByAHair,
    Wrong,
}

/// What a ray meets in truth.
#[derive(Clone, Debug, Default)]
pub(super) struct Truth {
    /// The nearest crossing with a triangle, its edges included.
    exact: Option<f64>,
    /// The nearest crossing that is farther than a hair from every edge and from the ray's ends.
    firm: Option<f64>,
    /// All crossings that are within a hair of an edge or an end, on either side.
    close: Vec<f64>,
}

impl Truth {
    /// The nearest crossing.
    pub(super) const fn exact(&self) -> Option<f64> {
        self.exact
    }

    /// What a ray meets of a triangle.
    fn meet(&mut self, ray: &Ray<f64>, [a, b, c]: [Point3<f64>; 3], fineness: Fineness) {
        let (ab, ac) = (b - a, c - a);
        let across: Vector3<f64> = ray.direction.cross(ac);
        let determinant = ab.dot(across);
        if determinant == 0.0 {
            return;
        }
        let from = ray.origin - a;
        let u = from.dot(across) / determinant;
        if !(-HAIR..=1.0 + HAIR).contains(&u) {
            return;
        }
        let other = from.cross(ab);
        let v = ray.direction.dot(other) / determinant;
        let inner = u.min(v).min(1.0 - u - v);
        if inner < -HAIR {
            return;
        }
        let t = ac.dot(other) / determinant;
        // How near to the ray's ends is a hair.
        let off = (HAIR * t.abs()).max(fineness.rounding);
        let within = (t - ray.t_min).min(ray.t_max - t);
        if within < -off {
            return;
        }
        if inner >= 0.0 && within >= 0.0 {
            keep_nearest(&mut self.exact, t);
        }
        if inner > HAIR && within > off {
            keep_nearest(&mut self.firm, t);
        } else {
            self.close.push(t);
        }
    }

    fn join(mut self, other: Self) -> Self {
        for (own, t) in [(&mut self.exact, other.exact), (&mut self.firm, other.firm)] {
            t.into_iter().for_each(|t| keep_nearest(own, t));
        }
        self.close.extend(other.close);
        self
    }

    /// Judges an answer.
    pub(super) fn verdict(&self, answer: Answer, fineness: Fineness) -> Verdict {
        let (right, by_a_hair) = match answer {
            Answer::Miss => (self.exact.is_none(), self.firm.is_none()),
            Answer::Blocked => (self.exact.is_some(), !self.close.is_empty()),
            Answer::At(t) => {
                let t = f64::from(t);
                let is = |there: &f64| same(t, *there, fineness.least);
                let nearly = |there: &f64| is(there) || (t - there).abs() <= fineness.rounding;
                // Nothing that is there for sure may lie before it.
                let open = self.firm.is_none_or(|firm| t <= firm || nearly(&firm));
                let close = self.close.iter().chain(&self.firm).any(nearly);
                (self.exact.as_ref().is_some_and(is), open && close)
            }
        };
        match (right, by_a_hair) {
            (true, _) => Verdict::Right,
            (false, true) => Verdict::ByAHair,
            (false, false) => Verdict::Wrong,
        }
    }
}

fn keep_nearest(nearest: &mut Option<f64>, t: f64) {
    if nearest.is_none_or(|before| t < before) {
        *nearest = Some(t);
    }
}

/// What some rays meet of a mesh.
pub(super) fn truths(mesh: &TriangleMesh, rays: &[Ray], fineness: Fineness) -> Vec<Truth> {
    let rays: Vec<Ray<f64>> = rays.iter().map(|&ray| ray.into()).collect();
    let nothing = || vec![Truth::default(); rays.len()];
    let count = mesh.triangles().len();
    (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .fold(nothing, |mut truths, chunk| {
            for triangle in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                let corners = mesh.corners(triangle).map(Point3::wide);
                for (ray, truth) in rays.iter().zip(&mut truths) {
                    truth.meet(ray, corners, fineness);
                }
            }
            truths
        })
        .reduce(nothing, |one, other| {
            let pairs = one.into_iter().zip(other);
            pairs.map(|(one, other)| one.join(other)).collect()
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FINE: Fineness = Fineness {
        least: 1e-6,
        rounding: 1e-7,
    };

    /// A triangle in the plane z = 0, and a ray down on it from a height of 2.
    fn truth(x: f32, y: f32) -> Truth {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let corners = corners.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec();
        let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]]).unwrap();
        let ray = Ray::new(Point3::new(x, y, 2.0), -Vector3::Z);
        truths(&mesh, &[ray], FINE).remove(0)
    }

    #[test]
    fn a_clear_hit_has_one_right_answer() {
        let truth = truth(0.2, 0.2);
        let verdict = |answer| truth.verdict(answer, FINE);
        assert_eq!(verdict(Answer::At(2.0)), Verdict::Right);
        assert_eq!(verdict(Answer::Blocked), Verdict::Right);
        for wrong in [
            Answer::Miss,
            Answer::At(1.9),
            Answer::At(2.1),
            Answer::At(f32::NAN),
        ] {
            assert_eq!(verdict(wrong), Verdict::Wrong, "{wrong:?}");
        }
    }

    #[test]
    fn a_clear_miss_has_one_right_answer() {
        let truth = truth(0.8, 0.8);
        assert_eq!(truth.verdict(Answer::Miss, FINE), Verdict::Right);
        assert_eq!(truth.verdict(Answer::At(2.0), FINE), Verdict::Wrong);
        assert_eq!(truth.verdict(Answer::Blocked, FINE), Verdict::Wrong);
    }

    #[test]
    fn beside_an_edge_the_other_answer_is_wrong_by_a_hair_only() {
        for (x, right, wrong) in [
            (1e-6, Answer::At(2.0), Answer::Miss),
            (-1e-6, Answer::Miss, Answer::At(2.0)),
            (-1e-6, Answer::Miss, Answer::Blocked),
        ] {
            let truth = truth(x, 0.5);
            assert_eq!(truth.verdict(right, FINE), Verdict::Right, "{x}");
            assert_eq!(truth.verdict(wrong, FINE), Verdict::ByAHair, "{x}");
            assert_eq!(truth.verdict(Answer::At(1.0), FINE), Verdict::Wrong, "{x}");
        }
    }

    #[test]
    fn close_to_its_start_a_ray_is_judged_by_what_coordinates_can_tell() {
        let truth = Truth {
            exact: Some(1e-5),
            firm: Some(1e-5),
            close: Vec::new(),
        };
        let verdict = |t| truth.verdict(Answer::At(t), FINE);
        assert_eq!(verdict(1.000_05e-5), Verdict::Right);
        assert_eq!(verdict(1.005e-5), Verdict::ByAHair);
        assert_eq!(verdict(1.05e-5), Verdict::Wrong);
    }

    #[test]
    fn distances_agree_to_a_part_in_ten_thousand() {
        assert!(Answer::At(1.0).agrees(Answer::At(1.00005), FINE));
        assert!(!Answer::At(1.0).agrees(Answer::At(1.0005), FINE));
        assert!(!Answer::At(1.0).agrees(Answer::Miss, FINE));
        assert!(!Answer::At(f32::NAN).agrees(Answer::At(f32::NAN), FINE));
        assert!(Answer::Miss.agrees(Answer::Miss, FINE));
    }
}
