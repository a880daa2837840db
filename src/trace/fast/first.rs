//! What the rays of a tile meet first: the walk takes the nearest nodes first, and what lies behind the
//! farthest hit of all rays is never looked at.

use fearless_simd::{Simd, f32x8};

use crate::math::RayPacket;

use super::Fast;
use super::memory::TileMemory;
use super::object::PacketTest;
use super::packet_hits::PacketHits;
use super::precision::Precision;
use super::source::{PacketSources, TracedPackets, TracedTile};
use super::walk::{Target, TestBudget, TileVisitor, walk_tile};

/// The most objects that a packet is intersected with, for each of its rays: where a dot holds many objects,
/// or rays diverge, they are incoherent. Fewer than for a shadow packet, whose rays end at the first thing
/// that they meet.
const TESTS_PER_RAY: u32 = 1;

impl Fast<'_> {
    /// The first hits of the rays of a tile.
    #[inline(always)]
    pub(super) fn first_of_tile<S: Simd, T: Precision>(
        &self,
        simd: S,
        sources: &mut PacketSources,
        traced: &mut TracedPackets<T>,
        memory: &mut TileMemory,
    ) -> TracedTile {
        let slack = self.slack_of::<T>();
        let whole = sources.whole(simd);
        let are_made_late = matches!(sources, PacketSources::Primary { .. });
        memory.forget_tile();
        memory.ends_at_light = false;
        memory.far.clear();
        for (k, found) in traced.nearest.iter_mut().enumerate() {
            memory.far.push(if sources.is_blind(k) { f64::NEG_INFINITY } else { f64::INFINITY });
            if are_made_late {
                found.clear_ray_bits();
            } else {
                found.clear();
            }
        }
        let mut visitor = FirstVisitor {
            fast: self,
            slack,
            sources,
            are_made_late,
            own: traced.own,
            nearest: traced.nearest,
            budget: TestBudget::NONE,
            tile: TracedTile { touched: 0, given_up: 0 },
        };
        walk_tile(simd, self.boxes, &whole, slack, &mut visitor, memory);
        visitor.tile
    }
}

/// Keeps the nearest hit of each ray.
struct FirstVisitor<'v, 's, 'b, T> {
    fast: &'v Fast<'v>,
    slack: f64,
    sources: &'v mut PacketSources<'s, 'b>,
    are_made_late: bool,
    own: &'v mut [RayPacket<T>],
    nearest: &'v mut [PacketHits<T>],
    budget: TestBudget,
    tile: TracedTile,
}

impl<S: Simd, T: Precision> TileVisitor<S> for FirstVisitor<'_, '_, '_, T> {
    #[inline(always)]
    fn open(&self) -> u16 {
        u16::MAX
    }

    #[inline(always)]
    fn is_beyond(&self, rank: f64, memory: &TileMemory) -> bool {
        let farthest = memory.far.iter().fold(f64::NEG_INFINITY, |most, &far| f64::max(most, far));
        rank > farthest + self.slack
    }

    #[inline(always)]
    fn spread(&mut self, simd: S, memory: &mut TileMemory) {
        self.sources.spread(simd, self.fast.level, &mut memory.frustums, &mut memory.frusta);
    }

    #[inline(always)]
    fn rank(near: f32x8<S>) -> f32x8<S> {
        near
    }

    #[inline(always)]
    fn takes_ball(&self, _: u32) -> bool {
        true
    }

    #[inline(always)]
    fn visit(&mut self, simd: S, target: &Target<S>, k: usize, near: f32, memory: &mut TileMemory) {
        // What is not a number is not known to be farther.
        if f64::from(near) > memory.far[k] + self.slack {
            return;
        }
        let nearest = &mut self.nearest[k];
        if self.tile.touched >> k & 1 == 0 {
            self.tile.touched |= 1 << k;
            if self.are_made_late {
                self.sources.make(k);
                nearest.clear();
            }
            let packet = self.sources.get(k).rays;
            T::take(simd, packet, self.own, k);
            self.budget.grant(k, TESTS_PER_RAY, packet.live);
            memory.cullers[k].set(packet);
        }
        let source = T::source(self.sources.get(k), self.own, k);
        let packet = source.full_rays;
        if !self.budget.spend(k) {
            self.tile.given_up += 1;
            nearest.incoherent = packet.live;
            memory.far[k] = f64::NEG_INFINITY;
            return;
        }
        let (passing, _) = target.cull(simd, &mut memory.cullers[k], packet, packet.live);
        if passing == 0 {
            return;
        }
        let test = PacketTest { source, k, passing, farthest: memory.far[k] + self.slack };
        if self.fast.object_of_packet(simd, target.object, &test, nearest, memory) {
            memory.far[k] = nearest.farthest(simd, source.rays);
            let slack = self.slack;
            memory.cullers[k].limit(
                #[inline(always)]
                |lane| nearest.reach_of(lane) + slack,
            );
        }
    }
}
