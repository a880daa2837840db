//! How objects treat light, and what glass leaves of it.

use crate::math::Lanes;

/// What glass leaves of the light of a shadow packet's rays.
#[derive(Clone, Debug)]
pub struct Transmittance {
    /// Which of the rays meet glass.
    pub rays: u64,
    /// What is left of their light.
    pub share: Lanes,
    /// Which of them meet two glass objects.
    two: u64,
}

/// How an object treats light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpacityClass {
    /// It lets none through.
    Opaque,
    /// All of it lets some through.
    Clear,
    /// Parts of it do.
    Mixed,
}

impl Transmittance {
    /// No ray meets glass.
    pub const NONE: Self = Self { rays: 0, share: Lanes::filled(1.0), two: 0 };

    /// Forgets what all rays met.
    pub fn clear(&mut self) {
        (self.rays, self.two) = (0, 0);
    }

    /// Forgets what some rays met.
    pub(super) fn forget(&mut self, rays: u64) {
        self.rays &= !rays;
        self.two &= !rays;
    }

    /// A ray meets a glass object that leaves so much of its light. Answers whether what is left is certain.
    pub(super) fn add(&mut self, lane: usize, left: f64) -> bool {
        let bit = 1 << lane;
        if self.rays & bit == 0 {
            self.rays |= bit;
            self.share.0[lane] = left;
            return true;
        }
        let is_second = self.two & bit == 0;
        self.two |= bit;
        self.share.0[lane] *= left;
        is_second
    }
}
