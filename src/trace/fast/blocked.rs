//! What stands between the lit points of a tile and one light.
//!
//! The rays towards a light run together, so that the frustum around them has its apex at the light. It walks
//! the boxes as the frustum of the rays from the eye does; which of two things stands in the way does not
//! matter, and a ray that is blocked is traced no further.

use fearless_simd::{Simd, f32x8};

use crate::lattice::Frustum;
use crate::math::{Lanes, Number, Real};
use crate::solid::Departures;

use super::Fast;
use super::glass::GlassTest;
use super::memory::TileMemory;
use super::mesh_walk::MeshObject;
use super::object::PacketTest;
use super::packet_culler::PacketCuller;
use super::packet_hits::HitCandidate;
use super::shadow_packet::{ShadowPacket, ShadowQuery};
use super::sink::{HitSink, SOME_LEAVES};
use super::source::PacketSource;
use super::transmittance::OpacityClass;
use super::walk::{Target, TestBudget, TileVisitor, walk_tile};

/// The most objects that a shadow packet is intersected with, for each of its rays: incoherent rays, which
/// have so many objects between them, take less time in a stream.
const TESTS_PER_RAY: u32 = 2;

/// So few rays of a block take less time in a stream than their frustum does.
const FEW_RAYS: u32 = 12;

impl Fast<'_> {
    /// Finds which rays towards a light are blocked. `departures` has the surfaces that they leave. Answers
    /// how many shadow packets were given up, since there are too many objects between their rays.
    #[inline(always)]
    pub(super) fn blocked_of_tile<S: Simd>(
        &self,
        simd: S,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) -> usize {
        let (mut open, mut budget) = (0_u16, TestBudget::NONE);
        for (k, shadow_packet) in shadow_packets.iter_mut().enumerate() {
            if shadow_packet.rays.live.count_ones() < FEW_RAYS {
                shadow_packet.give_up();
            }
            let rays = shadow_packet.open();
            open |= u16::from(rays != 0) << k;
            budget.grant(k, TESTS_PER_RAY, rays);
        }
        if open == 0 {
            return 0;
        }
        let packets = shadow_packets.iter().map(|shadow_packet| {
            (shadow_packet.open() != 0).then_some((&shadow_packet.rays, &shadow_packet.distance))
        });
        let whole = Frustum::towards(simd, &packets, lamp.at, &mut memory.frustums);
        memory.frusta.set(simd, &memory.frustums);
        memory.cullers.iter_mut().for_each(PacketCuller::forget);
        memory.forget_tile();
        memory.ends_at_light = true;
        let mut visitor =
            BlockedVisitor { fast: self, shadow_packets, departures, lamp, open, budget, given_up: 0 };
        walk_tile(simd, self.boxes, &whole, self.slack, &mut visitor, memory);
        visitor.given_up
    }
}

/// Notes which rays anything blocks.
struct BlockedVisitor<'v, 'a> {
    fast: &'v Fast<'a>,
    shadow_packets: &'v mut [ShadowPacket],
    departures: &'v [Departures],
    lamp: &'v ShadowQuery<'v>,
    open: u16,
    budget: TestBudget,
    given_up: usize,
}

impl BlockedVisitor<'_, '_> {
    fn is_glass(&self, object: u32) -> bool {
        let opacity = self.lamp.opacity.get(object as usize);
        matches!(opacity, Some(OpacityClass::Clear | OpacityClass::Mixed))
    }

    /// Intersects the rays of a shadow packet with an object in their way.
    #[inline(always)]
    fn intersect<S: Simd>(&mut self, simd: S, target: &Target<S>, k: usize, memory: &mut TileMemory) {
        let shadow_packet = &mut self.shadow_packets[k];
        let (culler, slack) = (&mut memory.cullers[k], self.fast.slack);
        if !culler.is_known() {
            culler.set(&shadow_packet.rays);
            culler.limit(
                #[inline(always)]
                |lane| shadow_packet.distance.0[lane] + slack,
            );
        }
        let (near, inside) = target.cull(simd, culler, &shadow_packet.rays, shadow_packet.open());
        shadow_packet.blocked |= inside;
        memory.counts.primitive_tests += u64::from(near != 0 && near == inside);
        let passing = near & !inside;
        if passing == 0 {
            return;
        }
        let object = target.object;
        if self.is_glass(object) {
            let test = GlassTest { object, departures: &self.departures[k], lamp: self.lamp, k, passing };
            self.fast.glass_in_shadow_packet(simd, &test, &mut self.shadow_packets[k], memory);
            return;
        }
        let ShadowPacket { rays, distance, blocked, uncertain, .. } = &mut self.shadow_packets[k];
        if let Some((primitive, mesh)) = self.fast.assembly.mesh(object) {
            let of = MeshObject { object, primitive, mesh };
            let source = PacketSource::new(rays, Some(&self.departures[k]));
            let answer = self.fast.mesh_answer(simd, &of, source, k, passing, memory);
            *blocked |= answer.hits;
            *uncertain |= answer.uncertain;
            return;
        }
        let source = PacketSource::new(rays, Some(&self.departures[k]));
        let test = PacketTest { source, k, passing, farthest: f64::INFINITY };
        self.fast.object_of_packet(
            simd,
            object,
            &test,
            &mut Blockers { distance, blocked, uncertain },
            memory,
        );
    }
}

impl<S: Simd> TileVisitor<S> for BlockedVisitor<'_, '_> {
    #[inline(always)]
    fn open(&self) -> u16 {
        self.open
    }

    #[inline(always)]
    fn is_beyond(&self, _: f64, _: &TileMemory) -> bool {
        false
    }

    /// Towards the light the frustum narrows: what stands near it stands before most of the rays.
    #[inline(always)]
    fn rank(near: f32x8<S>) -> f32x8<S> {
        -near
    }

    /// A ray that goes through glass is not blocked.
    #[inline(always)]
    fn takes_ball(&self, object: u32) -> bool {
        !self.is_glass(object)
    }

    #[inline(always)]
    fn visit(&mut self, simd: S, target: &Target<S>, k: usize, _: f32, memory: &mut TileMemory) {
        if self.budget.spend(k) {
            self.intersect(simd, target, k, memory);
        } else {
            self.given_up += 1;
            self.shadow_packets[k].incoherent |= self.shadow_packets[k].open();
        }
        if self.shadow_packets[k].open() == 0 {
            self.open &= !(1 << k);
        }
    }
}

/// Takes what shadow rays meet before the light: which is nearest does not matter.
struct Blockers<'a> {
    /// How far away the light is.
    distance: &'a Lanes,
    blocked: &'a mut u64,
    uncertain: &'a mut u64,
}

impl HitSink<f64> for Blockers<'_> {
    const FEW_LEAVES: usize = SOME_LEAVES;
    const NEEDS_SIDES: bool = false;

    #[inline(always)]
    fn offer<S: Simd>(&mut self, simd: S, register: usize, met: &HitCandidate<f64, S>) {
        let blocks = met.any & (met.t + met.error).is_below(self.distance.load(simd, register));
        *self.blocked |= f64::bits_of(simd, blocks, register);
    }

    fn mark_uncertain(&mut self, rays: u64) {
        *self.uncertain |= rays;
    }
}
