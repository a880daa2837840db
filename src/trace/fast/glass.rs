//! Glass between the lit points of a tile and one light.
//!
//! A glass object takes its share of the light once, however often a ray crosses its surface, and whatever
//! else is on the way: so what a ray meets of it first is all there is to know. A ray through three of them
//! is left to the exact engine: the last digit of their product depends on their order.

use fearless_simd::Simd;

use crate::math::{Bounds, DVec3, lanes};
use crate::solid::Departures;

use super::Fast;
use super::memory::TileMemory;
use super::object::PacketTest;
use super::packet_culler::Slabs;
use super::shadow_packet::{ShadowPacket, ShadowQuery};
use super::source::PacketSource;
use super::transmittance::OpacityClass;

/// Rays of a shadow packet that may meet a glass object.
#[derive(Clone, Copy)]
pub(super) struct GlassTest<'a> {
    /// By its index in the assembly.
    pub object: u32,
    /// The surfaces that the rays leave.
    pub departures: &'a Departures,
    pub lamp: &'a ShadowQuery<'a>,
    /// The packet's number in the tile.
    pub k: usize,
    /// The rays that may pass the object's box, a bit for each.
    pub passing: u64,
}

impl ShadowPacket {
    /// Takes what a glass object before the light leaves of one ray's light. `clear`: the ray meets nothing
    /// of that object that is opaque.
    pub(super) fn glass(&mut self, lane: usize, clear: bool, left: f64) {
        if !(clear && self.tint.add(lane, left)) {
            self.uncertain |= 1 << lane;
        }
    }
}

impl ShadowQuery<'_> {
    /// A box around what is opaque of a glass object, if anything is, and `slack` around it: no surface of
    /// that seems to lie farther outside.
    pub(super) fn dark_of(&self, object: u32, slack: f64) -> Option<Bounds> {
        let is_mixed = self.opacity.get(object as usize) == Some(&OpacityClass::Mixed);
        is_mixed.then(|| self.dark[object as usize].padded(DVec3::splat(slack)))
    }
}

impl Fast<'_> {
    /// Finds what a glass object in the way of a light leaves of it.
    pub(super) fn glass_in_shadow_packet<S: Simd>(
        &self,
        simd: S,
        test: &GlassTest,
        shadow_packet: &mut ShadowPacket,
        memory: &mut TileMemory,
    ) {
        let GlassTest { object, departures, lamp, k, passing } = *test;
        let mut met = std::mem::take(&mut memory.met);
        met.clear();
        let source = PacketSource::new(&shadow_packet.rays, Some(departures));
        let farthest = shadow_packet.distance.largest(simd) + self.slack;
        let packet_test = PacketTest { source, k, passing, farthest };
        self.object_of_packet(simd, object, &packet_test, &mut *met, memory);
        shadow_packet.uncertain |= met.uncertain & shadow_packet.rays.live;
        let dark = match lamp.dark_of(object, self.slack) {
            Some(Bounds { lo, hi }) => {
                let culler = &memory.cullers[k];
                simd.vectorize(
                    #[inline(always)]
                    || culler.passing(simd, &Slabs::around(simd, lo, hi, 0.0), shadow_packet.open()),
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
