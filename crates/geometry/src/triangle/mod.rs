//! Where a line crosses a triangle, three ways.
//!
//! Each kernel is two steps: what can be worked out once a ray, and the test of one triangle. They
//! are chosen by name ([`TriangleTest`]); the watertight one is the default for meshes. Beside them is
//! the other question about a triangle: which of its points is [nearest](nearest()).

mod barycentric;
mod cramer;
mod moller_trumbore;
mod nearest;
mod watertight;

use std::fmt;
use std::str::FromStr;

use crate::{Crossing, EdgeRule, Point3, Ray, Real};

pub use cramer::Cramer;
pub use moller_trumbore::MollerTrumbore;
pub(crate) use nearest::share;
pub use nearest::{Nearest, nearest};
pub use watertight::Watertight;

/// A ray–triangle test. `T` is the precision that it works in.
pub trait TriangleKernel<T: Real>: Sized {
    /// Works out what only depends on the ray, which must be valid.
    fn new(ray: &Ray<T>) -> Self;

    /// Where the ray crosses a triangle, `u` and `v` being the barycentric weights of the second
    /// and third corner; `None` if it does not, or outside the ray's `[t_min, t_max]`. Both sides
    /// count. A triangle with a NaN corner or with two corners in one place is never crossed. One
    /// whose three corners lie on a line is not either, unless rounding in the test gives it some
    /// area; the watertight test must count it then, or a mesh that has such triangles would leak.
    fn crossing(&self, ray: &Ray<T>, corners: [Point3<T>; 3], rule: EdgeRule) -> Option<Crossing>;
}

/// The ray–triangle tests, by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TriangleTest {
    /// [`Watertight`]: no ray escapes through an edge or a vertex.
    #[default]
    Watertight,
    /// [`MollerTrumbore`]: the classic; rays can escape through edges.
    MollerTrumbore,
    /// [`Cramer`]: as taught, four determinants; rays can escape through edges.
    Cramer,
}

impl TriangleTest {
    /// All of them, the default first.
    pub const ALL: [Self; 3] = [Self::Watertight, Self::MollerTrumbore, Self::Cramer];

    /// The name that a person types.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Watertight => "watertight",
            Self::MollerTrumbore => "moller-trumbore",
            Self::Cramer => "cramer",
        }
    }

    /// What it is, in one line.
    #[must_use]
    pub const fn line(self) -> &'static str {
        match self {
            Self::Watertight => "Woop, Benthin, Wald 2013: no ray escapes through an edge",
            Self::MollerTrumbore => "Möller, Trumbore 1997: Cramer's rule, common parts once",
            Self::Cramer => "as taught: the 3 × 3 system by Cramer's rule",
        }
    }

    /// Makes the test ready for one ray, which must be valid. `single` allows single precision,
    /// which is enough for the watertight test where the triangles are not far away compared with
    /// their extent. The other two compute in double precision all the same: in single precision
    /// the t of a sliver can be off by any amount (see `barycentric.rs`).
    #[must_use]
    #[inline]
    pub fn prepare(self, ray: &Ray<f64>, single: bool, rule: EdgeRule) -> PreparedTriangleTest {
        let kernel = match self {
            Self::Watertight if single => {
                let near = Ray {
                    origin: ray.origin.cast(),
                    direction: ray.direction.cast(),
                    t_min: ray.t_min as f32,
                    t_max: ray.t_max as f32,
                };
                Kernel::WatertightSingle(near, Watertight::new(&near))
            }
            Self::Watertight => Kernel::WatertightDouble(*ray, Watertight::new(ray)),
            Self::MollerTrumbore => Kernel::MollerTrumbore(*ray),
            Self::Cramer => Kernel::Cramer(*ray),
        };
        PreparedTriangleTest { kernel, rule }
    }
}

impl fmt::Display for TriangleTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that no ray–triangle test has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownTriangleTest(String);

impl fmt::Display for UnknownTriangleTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = TriangleTest::ALL.map(TriangleTest::name).join(", ");
        let asked = &self.0;
        write!(
            f,
            "there is no triangle test \"{asked}\"; there are: {names}"
        )
    }
}

impl std::error::Error for UnknownTriangleTest {}

impl FromStr for TriangleTest {
    type Err = UnknownTriangleTest;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|test| test.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownTriangleTest(name.to_owned()))
    }
}

/// A ray–triangle test that is ready for one ray.
#[derive(Clone, Copy, Debug)]
pub struct PreparedTriangleTest {
    kernel: Kernel,
    rule: EdgeRule,
}

#[derive(Clone, Copy, Debug)]
enum Kernel {
    WatertightSingle(Ray<f32>, Watertight<f32>),
    WatertightDouble(Ray<f64>, Watertight<f64>),
    MollerTrumbore(Ray<f64>),
    Cramer(Ray<f64>),
}

impl PreparedTriangleTest {
    /// See [`TriangleKernel::crossing`].
    #[must_use]
    #[inline]
    pub fn crossing(&self, corners: [Point3; 3]) -> Option<Crossing> {
        let rule = self.rule;
        let wide = || corners.map(Point3::wide);
        match &self.kernel {
            Kernel::WatertightSingle(ray, test) => test.crossing(ray, corners, rule),
            Kernel::WatertightDouble(ray, test) => test.crossing(ray, wide(), rule),
            Kernel::MollerTrumbore(ray) => MollerTrumbore.crossing(ray, wide(), rule),
            Kernel::Cramer(ray) => Cramer.crossing(ray, wide(), rule),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_test_goes_by_its_name() {
        for test in TriangleTest::ALL {
            assert_eq!(test.name().parse(), Ok(test));
        }
        let unknown = "plucker".parse::<TriangleTest>().unwrap_err();
        assert_eq!(
            unknown.to_string(),
            "there is no triangle test \"plucker\"; there are: watertight, moller-trumbore, cramer"
        );
    }
}
