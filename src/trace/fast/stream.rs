//! Incoherent rays, those of packets that were given up: single rays, many of them under way at once.
//!
//! Each finds what it finds by itself. Where that is more than one thing in one place, it is left to the
//! exact engine.

use crate::lattice::{Candidate, StreamRays, entry};
use crate::math::{LANES, RayIndex, RayPacket, lanes, places};
use crate::solid::{BatchKind, Crossing, Departures, RayBatch};
use crate::stage::{Counts, Meter, Silent};

use super::Fast;
use super::incoherent::{IncoherentRays, QueuedTest, StreamRay};
use super::memory::TileMemory;
use super::packet_hits::PacketHits;
use super::shadow_packet::{ShadowPacket, ShadowQuery};
use super::transmittance::OpacityClass;

/// What the rays of a stream look for: the first hit, or any before a light.
trait StreamVisitor {
    /// How far away a crossing may be to matter.
    fn limit(&self, at: RayIndex) -> f64;
    /// Takes a crossing with an object. Answers how far away boxes may be that the ray is still to be tested
    /// against: below 0 where none are.
    fn visit(&mut self, at: RayIndex, object: u32, crossing: &Crossing) -> f64;
}

/// Keeps the nearest hit of each ray.
struct FirstHits<'a> {
    nearest: &'a mut [PacketHits],
    slack: f64,
}

impl StreamVisitor for FirstHits<'_> {
    #[inline]
    fn limit(&self, RayIndex { packet, lane }: RayIndex) -> f64 {
        self.nearest[packet].t.0[lane] + self.slack
    }

    #[inline]
    fn visit(&mut self, RayIndex { packet, lane }: RayIndex, object: u32, crossing: &Crossing) -> f64 {
        self.nearest[packet].offer_one(lane, object, crossing);
        self.nearest[packet].t.0[lane] + self.slack
    }
}

/// Notes what stands between surfaces and a light.
struct BlockedRays<'a> {
    shadow_packets: &'a mut [ShadowPacket],
    lamp: &'a ShadowQuery<'a>,
    slack: f64,
}

impl StreamVisitor for BlockedRays<'_> {
    #[inline]
    fn limit(&self, RayIndex { packet, lane }: RayIndex) -> f64 {
        self.shadow_packets[packet].distance.0[lane]
    }

    #[inline]
    fn visit(&mut self, RayIndex { packet, lane }: RayIndex, object: u32, crossing: &Crossing) -> f64 {
        let (shadow_packet, bit) = (&mut self.shadow_packets[packet], 1 << lane);
        let distance = shadow_packet.distance.0[lane];
        match self.lamp.opacity.get(object as usize).copied() {
            _ if !shadow_packet.blocks(lane, crossing) => {}
            Some(OpacityClass::Clear | OpacityClass::Mixed) => {
                let left = self.lamp.lets_through[crossing.primitive as usize];
                let dark = self.lamp.dark_of(object, self.slack);
                let clear = dark.is_none_or(|dark| entry(&shadow_packet.rays.ray(lane), &dark).is_none());
                shadow_packet.glass(lane, clear, left);
            }
            _ => shadow_packet.blocked |= bit,
        }
        if (shadow_packet.blocked | shadow_packet.uncertain) & bit != 0 {
            -1.0
        } else {
            distance + self.slack
        }
    }
}

/// Rays that are to be intersected with a primitive each, all of one form.
struct QueuedTests<'a> {
    /// Up to eight.
    tests: &'a [QueuedTest],
    /// Whether the primitives are tubes; balls if not.
    are_tubes: bool,
    /// All rays of the stream.
    rays: &'a [StreamRay],
}

impl Fast<'_> {
    /// The first hits of the rays of some packets that are incoherent: those in [`PacketHits::incoherent`].
    pub fn first_of_incoherent(
        &self,
        packets: &[RayPacket],
        departures: Option<&[Departures]>,
        nearest: &mut [PacketHits],
        memory: &mut TileMemory,
    ) {
        let TileMemory { incoherent, counts, .. } = memory;
        incoherent.clear();
        for (k, (packet, found)) in packets.iter().zip(&mut *nearest).enumerate() {
            for at in places(k, found.incoherent) {
                found.forget(at.lane);
                let departure = departures.map(|all| all[k].get(at.lane));
                incoherent.push(at, packet.ray(at.lane), departure, f64::INFINITY);
            }
        }
        let mut visitor = FirstHits { nearest, slack: self.slack };
        self.trace_stream(incoherent, &mut visitor, counts);
        for found in nearest {
            for lane in lanes(std::mem::take(&mut found.incoherent)) {
                let t = found.t.0[lane];
                let close = found.second.0[lane] <= t + self.slack && t < f64::INFINITY;
                found.uncertain |= u64::from(close) << lane;
            }
        }
    }

    /// The same as [`Fast::blocked_of`] finds, for rays none of which are coherent.
    #[inline]
    pub fn blocked_of_incoherent(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) {
        shadow_packets.iter_mut().for_each(ShadowPacket::give_up);
        self.stream_blocked(shadow_packets, departures, lamp, memory);
    }

    /// Which of the rays towards a light that are incoherent, those in [`ShadowPacket::incoherent`], are
    /// blocked, and what glass leaves of the light of the others.
    pub(super) fn stream_blocked(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) {
        let TileMemory { incoherent, counts, .. } = memory;
        incoherent.clear();
        for (k, shadow_packet) in shadow_packets.iter_mut().enumerate() {
            shadow_packet.tint.forget(shadow_packet.incoherent);
            for at in places(k, std::mem::take(&mut shadow_packet.incoherent)) {
                let (departure, to) =
                    (departures[k].get(at.lane), shadow_packet.distance.0[at.lane] + self.slack);
                incoherent.push(at, shadow_packet.rays.ray(at.lane), Some(departure), to);
            }
        }
        let mut visitor = BlockedRays { shadow_packets, lamp, slack: self.slack };
        self.trace_stream(incoherent, &mut visitor, counts);
    }

    /// Traces all rays of a stream.
    fn trace_stream(
        &self,
        incoherent: &mut IncoherentRays,
        visitor: &mut impl StreamVisitor,
        counts: &mut Counts,
    ) {
        let IncoherentRays { stream, rays, leaves, balls, tubes, eight, scratch } = incoherent;
        let mut visited = 0;
        let mut meter = Meter::new(Silent);
        self.boxes.walk_stream(stream, &mut visited, &mut |met: &[Candidate], limits: &mut StreamRays| {
            for candidate in met {
                if !limits.matters(candidate) {
                    continue;
                }
                let Candidate { ray: number, object, .. } = *candidate;
                let (kind, index) = self.assembly.kind(object);
                if matches!(kind, BatchKind::Ball | BatchKind::Tube) {
                    // What is convex is not met again by a ray that leaves it.
                    if leaves[number as usize] != index {
                        let queue = if kind == BatchKind::Ball { &mut *balls } else { &mut *tubes };
                        queue.0.push(QueuedTest { candidate: *candidate, index });
                    }
                    continue;
                }
                let StreamRay { at, ray, departure } = &rays[number as usize];
                let to = visitor.limit(*at);
                if let Some(crossing) = self.exact.object(object, ray, *departure, to, scratch, &mut meter) {
                    limits.limit(number, visitor.visit(*at, object, &crossing));
                }
            }
            // Where few rays are left, registers are not filled first.
            let least = if met.len() < LANES { 1 } else { LANES };
            for (queue, are_tubes) in [(&mut *balls, false), (&mut *tubes, true)] {
                while queue.0.len() >= least {
                    let some = queue.0.len().saturating_sub(LANES);
                    meter.counts.primitive_tests += (queue.0.len() - some) as u64;
                    let tests = QueuedTests { tests: &queue.0[some..], are_tubes, rays };
                    self.intersect_queued(&tests, eight, visitor, limits);
                    queue.0.truncate(some);
                }
            }
        });
        *counts += meter.counts;
        counts.cells_visited += visited;
    }

    /// Intersects up to eight rays with a primitive each, all of one form.
    fn intersect_queued(
        &self,
        &QueuedTests { tests, are_tubes, rays }: &QueuedTests,
        eight: &mut RayBatch,
        visitor: &mut impl StreamVisitor,
        limits: &mut StreamRays,
    ) {
        let primitives = &self.assembly.primitives;
        for (lane, QueuedTest { candidate, index }) in tests.iter().enumerate() {
            eight.set(lane, &rays[candidate.ray as usize].ray, &primitives[*index as usize]);
        }
        if are_tubes {
            eight.meet_tubes(self.level);
        } else {
            eight.meet_balls(self.level);
        }
        let met = eight.met(are_tubes);
        for (lane, QueuedTest { candidate, index }) in tests.iter().enumerate() {
            if met >> lane & 1 == 1 && limits.matters(candidate) {
                let StreamRay { at, departure, .. } = &rays[candidate.ray as usize];
                if let Some(crossing) = eight.first(lane, &primitives[*index as usize], *index, *departure) {
                    limits.limit(candidate.ray, visitor.visit(*at, candidate.object, &crossing));
                }
            }
        }
    }
}
