//! Random numbers that are the same on every machine.

/// PCG-XSH-RR 64/32 (O'Neill, "PCG", 2014, section 6.3.1).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Another seed gives other numbers.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Thirty-two bits.
    pub const fn bits(&mut self) -> u32 {
        let state = self.0;
        self.0 = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let mixed = (((state >> 18) ^ state) >> 27) as u32;
        mixed.rotate_right((state >> 59) as u32)
    }

    /// In `[0, 1)`.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// In `[low, high)`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// In the unit ball of three dimensions, not near its centre. By rejection: square roots and
    /// products are the same everywhere, sines are not.
    pub fn in_ball(&mut self) -> [f32; 3] {
        loop {
            let p = [(); 3].map(|()| self.between(-1.0, 1.0));
            let square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
            if (1e-4..=1.0).contains(&square) {
                return p;
            }
        }
    }

    /// In the unit disk.
    pub fn in_disk(&mut self) -> [f32; 2] {
        loop {
            let p = [(); 2].map(|()| self.between(-1.0, 1.0));
            if p[0] * p[0] + p[1] * p[1] <= 1.0 {
                return p;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_the_same_numbers_and_another_seed_others() {
        let three = |seed| {
            let mut random = Random::new(seed);
            [(); 3].map(|()| random.bits())
        };
        assert_eq!(three(7), three(7));
        assert_ne!(three(7), three(8));
    }

    #[test]
    fn places_lie_where_they_are_said_to() {
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let ball = random.in_ball().map(|x| x * x).iter().sum::<f32>();
            let disk = random.in_disk().map(|x| x * x).iter().sum::<f32>();
            assert!(ball <= 1.0 && disk <= 1.0);
            assert!((2.0..3.0).contains(&random.between(2.0, 3.0)));
        }
    }
}
