//! Random numbers that are the same in every run: Steele, Lea and Flood's `SplitMix64` (OOPSLA 2014).

use ray13::math::{DMat3, DVec3};

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub struct Chance(u64);

impl Chance {
    /// A stream of its own for each test and, in it, for each case.
    pub fn new(test: &str, case: u64) -> Self {
        let seed =
            test.bytes().fold(13, |seed: u64, byte| (seed ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
        Self(seed.wrapping_add(case.wrapping_mul(0x2545_f491_4f6c_dd1d)))
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Even in `low..high`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        // 53 bits over 2^53.
        let share = (self.bits() >> 11) as f64 * (0.5 * f64::EPSILON);
        low + (high - low) * share
    }

    /// One of `0..count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    pub fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }

    /// Even in the exponent of 10, `low..high`.
    pub fn decade(&mut self, low: f64, high: f64) -> f64 {
        libm::pow(10.0, self.within(low, high))
    }

    pub fn sign(&mut self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }

    /// Even in the cube `−1..1`.
    pub fn point(&mut self) -> DVec3 {
        DVec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0))
    }

    /// Of length 1, even on the sphere.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point();
            if (0.01..=1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }

    /// Any turn.
    pub fn turn(&mut self) -> DMat3 {
        let first = self.direction();
        let second = first.cross(self.direction()).normalize_or(first.any_orthonormal_vector());
        DMat3::from_cols(first, second, first.cross(second))
    }

    pub fn shuffle<T>(&mut self, all: &mut [T]) {
        for i in (1..all.len()).rev() {
            let j = self.below(i + 1);
            all.swap(i, j);
        }
    }
}
