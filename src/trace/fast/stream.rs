//! Rays that are incoherent: those of packets that were given up, many on their way at once.
//!
//! Each finds what it finds alone. Where that is more than one thing in one place, it is asked of the exact engine.

use crate::lattice::{Candidate, Stream, StreamRays, entry};
use crate::math::{LANES, Ray, RayIndex, RayPacket, lanes, places};
use crate::solid::{BatchKind, Crossing, Departure, Departures, RayBatch, Scratch, WorldShape};
use crate::stage::{Counts, Meter, Silent};

use super::Fast;
use super::memory::TileMemory;
use super::packet_hits::PacketHits;
use super::shadow_packet::{ShadowPacket, ShadowQuery};
use super::transmittance::OpacityClass;

/// No index of a primitive: there are fewer.
const NONE: u32 = u32::MAX;

/// Memory for incoherent rays.
#[derive(Debug, Default)]
pub struct Apart {
    stream: Stream,
    rays: Vec<Alone>,
    /// By ray, the primitive that it leaves to the outside, and [`NONE`] where it leaves none.
    leaves: Vec<u32>,
    balls: Queue,
    tubes: Queue,
    batch: RayBatch,
    scratch: Scratch,
}

/// A ray of a stream.
#[derive(Clone, Copy, Debug)]
struct Alone {
    at: RayIndex,
    ray: Ray,
    departure: Option<Departure>,
}

/// Rays that wait to be asked about a primitive of one form.
#[derive(Debug, Default)]
struct Queue(Vec<Question>);

#[derive(Clone, Copy, Debug)]
struct Question {
    meeting: Candidate,
    /// The primitive.
    index: u32,
}

impl Apart {
    #[inline]
    fn clear(&mut self) {
        self.stream.clear();
        self.rays.clear();
        self.leaves.clear();
    }

    /// One more ray, that looks as far as `to`.
    #[inline(always)]
    fn push(&mut self, at: RayIndex, ray: Ray, departure: Option<Departure>, to: f64) {
        self.stream.push(&ray, to);
        self.leaves.push(departure.filter(|d| !d.inward).map_or(NONE, |d| d.primitive));
        self.rays.push(Alone { at, ray, departure });
    }
}

/// What rays without reordering are asked about.
trait Asking {
    /// How far a crossing may be to matter.
    fn to(&self, at: RayIndex) -> f64;
    /// A crossing with an object. Answers how far the ray still looks: below 0 where no farther at all.
    fn meet(&mut self, at: RayIndex, object: u32, crossing: &Crossing) -> f64;
}

/// What rays meet first.
struct First<'a> {
    nearest: &'a mut [PacketHits],
    slack: f64,
}

impl Asking for First<'_> {
    #[inline]
    fn to(&self, RayIndex { packet, lane }: RayIndex) -> f64 {
        self.nearest[packet].t.0[lane] + self.slack
    }

    #[inline]
    fn meet(&mut self, RayIndex { packet, lane }: RayIndex, object: u32, crossing: &Crossing) -> f64 {
        self.nearest[packet].offer_one(lane, object, crossing);
        self.nearest[packet].t.0[lane] + self.slack
    }
}

/// What stands between surfaces and a light.
struct Blocked<'a> {
    shadow_packets: &'a mut [ShadowPacket],
    lamp: &'a ShadowQuery<'a>,
    slack: f64,
}

impl Asking for Blocked<'_> {
    #[inline]
    fn to(&self, RayIndex { packet, lane }: RayIndex) -> f64 {
        self.shadow_packets[packet].distance.0[lane]
    }

    #[inline]
    fn meet(&mut self, RayIndex { packet, lane }: RayIndex, object: u32, crossing: &Crossing) -> f64 {
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
        if (shadow_packet.blocked | shadow_packet.unsure) & bit != 0 { -1.0 } else { distance + self.slack }
    }
}

impl Fast<'_> {
    /// The first hits of the rays of some packets that are incoherent: those in [`PacketHits::apart`].
    pub fn first_apart(
        &self,
        packets: &[RayPacket],
        departures: Option<&[Departures]>,
        nearest: &mut [PacketHits],
        memory: &mut TileMemory,
    ) {
        let TileMemory { apart, counts, .. } = memory;
        apart.clear();
        for (k, (packet, found)) in packets.iter().zip(&mut *nearest).enumerate() {
            for at in places(k, found.apart) {
                found.forget(at.lane);
                if departures.is_some_and(|all| self.leaves_mesh(&all[k], at.lane)) {
                    found.unsure |= 1 << at.lane;
                } else {
                    let departure = departures.map(|all| all[k].get(at.lane));
                    apart.push(at, packet.ray(at.lane), departure, f64::INFINITY);
                }
            }
        }
        let mut asking = First { nearest, slack: self.slack };
        self.ask_stream(apart, &mut asking, counts);
        for found in nearest {
            for lane in lanes(std::mem::take(&mut found.apart)) {
                let t = found.t.0[lane];
                let close = found.second.0[lane] <= t + self.slack && t < f64::INFINITY;
                found.unsure |= u64::from(close) << lane;
            }
        }
    }

    /// The same as [`Fast::blocked_of`] finds, for rays of which none has company.
    #[inline]
    pub fn blocked_alone(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) {
        shadow_packets.iter_mut().for_each(ShadowPacket::give_up);
        self.blocked_apart(shadow_packets, departures, lamp, memory);
    }

    /// Which of the rays towards a light that have no reordering, those in [`ShadowPacket::apart`], are blocked, and what glass leaves
    /// of the light of the others.
    pub(super) fn blocked_apart(
        &self,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) {
        let TileMemory { apart, counts, .. } = memory;
        apart.clear();
        for (k, shadow_packet) in shadow_packets.iter_mut().enumerate() {
            shadow_packet.tint.forget(shadow_packet.apart);
            for at in places(k, std::mem::take(&mut shadow_packet.apart)) {
                if self.leaves_mesh(&departures[k], at.lane) {
                    shadow_packet.unsure |= 1 << at.lane;
                } else {
                    let (departure, to) =
                        (departures[k].get(at.lane), shadow_packet.distance.0[at.lane] + self.slack);
                    apart.push(at, shadow_packet.rays.ray(at.lane), Some(departure), to);
                }
            }
        }
        let mut asking = Blocked { shadow_packets, lamp, slack: self.slack };
        self.ask_stream(apart, &mut asking, counts);
    }

    /// Whether a ray leaves a mesh, which has many faces: of those nothing is noted for a packet.
    #[inline]
    fn leaves_mesh(&self, departures: &Departures, lane: usize) -> bool {
        let primitive = departures.primitive.0[lane];
        primitive >= 0.0 && matches!(self.assembly.primitives[primitive as usize].form, WorldShape::Mesh(_))
    }

    /// Asks all rays of a stream.
    fn ask_stream(&self, apart: &mut Apart, asking: &mut impl Asking, counts: &mut Counts) {
        let Apart { stream, rays, leaves, balls, tubes, batch, scratch } = apart;
        let mut visited = 0;
        let mut meter = Meter::new(Silent);
        self.boxes.walk_stream(stream, &mut visited, &mut |met: &[Candidate], ways: &mut StreamRays| {
            for meeting in met {
                if !ways.matters(meeting) {
                    continue;
                }
                let Candidate { ray: number, object, .. } = *meeting;
                let (kind, index) = self.assembly.kind(object);
                if kind != BatchKind::Other {
                    // What is convex is not met again by a ray that leaves it.
                    if leaves[number as usize] != index {
                        let queue = if kind == BatchKind::Ball { &mut *balls } else { &mut *tubes };
                        queue.0.push(Question { meeting: *meeting, index });
                    }
                    continue;
                }
                let Alone { at, ray, departure } = &rays[number as usize];
                let to = asking.to(*at);
                if let Some(crossing) = self.exact.object(object, ray, *departure, to, scratch, &mut meter) {
                    ways.look(number, asking.meet(*at, object, &crossing));
                }
            }
            // Where few rays are left none waits for company.
            let least = if met.len() < LANES { 1 } else { LANES };
            for (queue, is_tubes) in [(&mut *balls, false), (&mut *tubes, true)] {
                while queue.0.len() >= least {
                    let some = queue.0.len().saturating_sub(LANES);
                    meter.counts.primitive_tests += (queue.0.len() - some) as u64;
                    self.ask_batch((&queue.0[some..], is_tubes), rays, batch, asking, ways);
                    queue.0.truncate(some);
                }
            }
        });
        *counts += meter.counts;
        counts.cells_visited += visited;
    }

    /// Asks up to eight rays about a primitive each, all of one form.
    fn ask_batch(
        &self,
        (questions, tubes): (&[Question], bool),
        rays: &[Alone],
        batch: &mut RayBatch,
        asking: &mut impl Asking,
        ways: &mut StreamRays,
    ) {
        let primitives = &self.assembly.primitives;
        for (lane, Question { meeting, index }) in questions.iter().enumerate() {
            batch.set(lane, &rays[meeting.ray as usize].ray, &primitives[*index as usize]);
        }
        if tubes {
            batch.meet_tubes(self.level);
        } else {
            batch.meet_balls(self.level);
        }
        let met = batch.met(tubes);
        for (lane, Question { meeting, index }) in questions.iter().enumerate() {
            if met >> lane & 1 == 1 && ways.matters(meeting) {
                let Alone { at, departure, .. } = &rays[meeting.ray as usize];
                if let Some(crossing) = batch.first(lane, &primitives[*index as usize], *index, *departure) {
                    ways.look(meeting.ray, asking.meet(*at, meeting.object, &crossing));
                }
            }
        }
    }
}
