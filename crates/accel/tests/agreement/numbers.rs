//! Numbers without a pattern that are the same in every run (Steele et al. 2014, SplitMix).

use ombra_geometry::{Point3, Vector3};

pub(crate) struct Numbers(u64);

impl Numbers {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn within(&mut self, from: f32, to: f32) -> f32 {
        from + (to - from) * ((self.bits() >> 40) as f32 / 16_777_216.0)
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    /// In a cube about the origin.
    pub(crate) fn point(&mut self, half: f32) -> Point3 {
        Point3::from([(); 3].map(|()| self.within(-half, half)))
    }

    pub(crate) fn direction(&mut self) -> Vector3 {
        loop {
            let v = self.point(1.0).to_vector();
            if v.length() <= 1.0
                && let Some(unit) = v.normalized()
            {
                return unit;
            }
        }
    }
}
