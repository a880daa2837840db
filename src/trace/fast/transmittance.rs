//! Glass between the lit points of a tile and one light.
//!
//! A glass object takes its share of the light once, however often a ray crosses its surface, and whatever else is on the
//! way: so what a ray meets of it first is all there is to know. A ray through three of them is asked alone: the last digit of
//! their product is that of the order of their numbers.

use fearless_simd::Simd;

use crate::lattice::FRUSTA;
use crate::math::{Bounds, DVec3, Lanes, lanes};
use crate::solid::Departures;

use super::Fast;
use super::memory::TileMemory;
use super::packet_culler::Slabs;
use super::shadow_packet::{ShadowPacket, ShadowQuery};
use super::source::PacketSource;

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
    /// None.
    pub const NONE: Self = Self { rays: 0, share: Lanes::filled(1.0), two: 0 };

    /// Forgets all.
    pub fn clear(&mut self) {
        (self.rays, self.two) = (0, 0);
    }

    /// Forgets what some rays met.
    pub(super) fn forget(&mut self, rays: u64) {
        self.rays &= !rays;
        self.two &= !rays;
    }

    /// A ray meets a glass object that leaves so much of its light. Answers whether what is left is certain.
    fn add(&mut self, lane: usize, left: f64) -> bool {
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

impl ShadowPacket {
    /// A ray meets a glass object before the light, which leaves so much of it. `clear`: it meets nothing of that object that
    /// is opaque.
    pub(super) fn glass(&mut self, lane: usize, clear: bool, left: f64) {
        if !(clear && self.tint.add(lane, left)) {
            self.unsure |= 1 << lane;
        }
    }
}

impl ShadowQuery<'_> {
    /// A box around what is opaque of a glass object, if anything is, and `slack` around it: no surface of that seems to lie
    /// farther outside.
    pub(super) fn dark_of(&self, object: u32, slack: f64) -> Option<Bounds> {
        let is_mixed = self.opacity.get(object as usize) == Some(&OpacityClass::Mixed);
        is_mixed.then(|| self.dark[object as usize].padded(DVec3::splat(slack)))
    }
}

impl Fast<'_> {
    /// Glass in the way of a light; `about` is the object, and which rays may pass its box.
    pub(super) fn glass_in_shadow_packet<S: Simd>(
        &self,
        simd: S,
        about: (u32, u64),
        shadow_packet: &mut ShadowPacket,
        (departures, lamp): (&Departures, &ShadowQuery),
        memory: &mut TileMemory,
        k: usize,
    ) {
        let mut met = std::mem::take(&mut memory.met);
        met.clear();
        memory.far.resize(FRUSTA, 0.0);
        memory.far[k] = shadow_packet.distance.largest(simd);
        let source = PacketSource::new(&shadow_packet.rays, Some(departures));
        self.object_of_packet(simd, about, source, &mut met, memory, k);
        shadow_packet.unsure |= met.unsure & shadow_packet.rays.live;
        let dark = match lamp.dark_of(about.0, self.slack) {
            Some(Bounds { lo, hi }) => {
                let thin = &memory.thin[k];
                simd.vectorize(
                    #[inline(always)]
                    || thin.passing(simd, &Slabs::around(simd, lo, hi, 0.0), shadow_packet.open()),
                )
            }
            None => 0,
        };
        for lane in lanes(shadow_packet.open()) {
            // Infinite where nothing was met.
            if met.t.0[lane] + met.error.0[lane] < shadow_packet.distance.0[lane] {
                let left = lamp.lets_through[met.primitive.0[lane] as usize];
                shadow_packet.glass(lane, dark >> lane & 1 == 0, left);
            }
        }
        memory.met = met;
    }
}
