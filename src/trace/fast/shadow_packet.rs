//! Rays towards a light, and what is found of them.

use fearless_simd::Simd;

use crate::math::{Bounds, DVec3, Lanes, RayPacket};
use crate::solid::Crossing;

use super::transmittance::{OpacityClass, Transmittance};

/// Rays towards a light.
#[derive(Clone, Debug)]
pub struct ShadowPacket {
    /// The rays; those that are live are traced.
    pub rays: RayPacket,
    /// How far away the light is from each start.
    pub distance: Lanes,
    /// Which of the rays are blocked, a bit for each.
    pub blocked: u64,
    /// What glass leaves of the light of the rays that are not blocked.
    pub tint: Transmittance,
    /// Which are to be traced by the exact engine.
    pub uncertain: u64,
    /// Which are incoherent, and are to be traced in a stream.
    pub incoherent: u64,
}

/// A light, and what it shines through.
#[derive(Clone, Copy, Debug)]
pub struct ShadowQuery<'a> {
    /// Where it stands.
    pub at: DVec3,
    /// By object; empty where all are opaque.
    pub opacity: &'a [OpacityClass],
    /// By object, as far as it is glass and parts of it are opaque: a box around those.
    pub dark: &'a [Bounds],
    /// By primitive: the share of the light that its material lets through.
    pub lets_through: &'a [f64],
}

impl ShadowPacket {
    /// No rays.
    pub const EMPTY: Self = Self {
        rays: RayPacket::EMPTY,
        distance: Lanes::filled(0.0),
        blocked: 0,
        tint: Transmittance::NONE,
        uncertain: 0,
        incoherent: 0,
    };

    /// Takes all rays out, and forgets what was found of them.
    pub fn clear(&mut self) {
        self.rays.live = 0;
        (self.blocked, self.uncertain, self.incoherent) = (0, 0, 0);
        self.tint.clear();
    }

    /// Marks all live rays as incoherent.
    pub fn give_up(&mut self) {
        self.incoherent = self.rays.live;
    }

    /// Gives the lanes that are not live the numbers of the first that is ([`RayPacket::close`]).
    #[inline(always)]
    pub fn close<S: Simd>(&mut self, simd: S) {
        self.rays.close(simd);
        if self.rays.live != 0 {
            self.distance.fill_rest(simd, self.rays.live, self.rays.live.trailing_zeros() as usize);
        }
    }

    /// The rays that are neither blocked nor uncertain, nor incoherent.
    #[inline(always)]
    pub(super) fn open(&self) -> u64 {
        self.rays.live & !(self.blocked | self.uncertain | self.incoherent)
    }

    /// Whether a crossing of one ray lies before the light.
    #[inline]
    pub(super) fn blocks(&self, lane: usize, crossing: &Crossing) -> bool {
        crossing.is_before(self.distance.0[lane])
    }
}
