//! Random numbers that are the same in every run.

use ombra_geometry::{Normal3, Point3, Vector3};

/// SplitMix64: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014.
pub(crate) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Two numbers for a sampling routine.
    pub(crate) fn xi(&mut self) -> [f32; 2] {
        [(); 2].map(|()| (self.next() >> 40) as f32 / (1_u64 << 24) as f32)
    }

    pub(crate) fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// Of a random order of magnitude between two powers of ten.
    pub(crate) fn magnitude(&mut self, lo: f64, hi: f64) -> f64 {
        10_f64.powf(self.between(lo, hi))
    }

    pub(crate) fn vector(&mut self, reach: f64) -> Vector3<f64> {
        let mut one = || self.between(-reach, reach);
        Vector3::new(one(), one(), one())
    }

    /// Uniform over all directions.
    pub(crate) fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = self.vector(1.0);
            if v.length() <= 1.0 && v.length() > 1e-3 {
                return v / v.length();
            }
        }
    }

    /// A direction of any length, sometimes along an axis.
    pub(crate) fn axis(&mut self) -> Vector3 {
        let length = self.magnitude(-3.0, 3.0);
        let axes = [Vector3::X, Vector3::Y, Vector3::Z];
        match (self.unit() * 12.0) as usize {
            i @ 0..3 => axes[i],
            i @ 3..6 => -axes[i - 3],
            _ => (self.direction() * length).cast(),
        }
    }

    pub(crate) fn normal(&mut self) -> Normal3 {
        self.axis().to_normal()
    }

    pub(crate) fn point(&mut self, reach: f64) -> Point3 {
        (Point3::new(0.0, 0.0, 0.0) + self.vector(reach)).cast()
    }
}
