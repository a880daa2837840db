//! What stands between the lit points of a tile and one light.
//!
//! The rays towards a light run together, so that the frustum around them, with its apex at the light, is a shadow packet. It
//! walks the boxes as the frustum of the rays from the eye does; which of two things stands in the way does not matter,
//! and a ray that is blocked asks no more.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8, mask64x8};

use crate::lattice::{BoundingSphere, Child, FRUSTA, Frustum, FrustumHits, SLACK};
use crate::math::{Bounds, DVec3, LANES, Lanes, Mask, Number, ROWS, RayPacket, Rays, lanes, row_of};
use crate::solid::{
    Ball, Body, Crossing, CsgQuery, Departures, ExprView, FirstCrossings, PacketCrossings, RayStarts, Spans,
    SurfaceQuery, TRange, WorldShape, first_of_expressions, firsts_of_spans, firsts_of_surface, with_spans,
};

use super::Fast;
use super::memory::{Numbers, TileMemory};
use super::packet_culler::{PacketCuller, Slabs};
use super::slices::{SOME, Slices, slices};
use super::transmittance::{OpacityClass, Transmittance};
use super::walk::{Waits, asking, bounds_between, push_nearest_last, reach, wide};

/// The most objects that a shadow packet is asked about, for each of its rays: rays that run apart, and have so many objects
/// between them, take less time one by one.
const CROWD: u32 = 2;

/// So few rays of a block take less time one by one than their frustum does.
const FEW_RAYS: u32 = 12;

/// Rays towards a light.
#[derive(Clone, Debug)]
pub struct ShadowPacket {
    /// The rays; those that are live ask.
    pub rays: RayPacket,
    /// How far away the light is.
    pub distance: Lanes,
    /// Which of the rays are blocked.
    pub blocked: u64,
    /// What glass does to the rays that are not blocked.
    pub tint: Transmittance,
    /// Which are to be asked one by one.
    pub unsure: u64,
    /// Which have no reordering, and are to be asked in a stream.
    pub apart: u64,
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
        unsure: 0,
        apart: 0,
    };

    /// No ray asks, and nothing is known.
    pub fn clear(&mut self) {
        self.rays.live = 0;
        (self.blocked, self.unsure, self.apart) = (0, 0, 0);
        self.tint.clear();
    }

    /// All rays that ask are incoherent.
    pub fn give_up(&mut self) {
        self.apart = self.rays.live;
    }

    /// Gives those that do not ask the numbers of the first that does ([`RayPacket::close`]).
    #[inline(always)]
    pub fn close<S: Simd>(&mut self, simd: S) {
        self.rays.close(simd);
        if self.rays.live != 0 {
            self.distance.fill_rest(simd, self.rays.live, self.rays.live.trailing_zeros() as usize);
        }
    }

    /// The rays that are neither blocked nor unsure, nor incoherent.
    #[inline(always)]
    pub(super) fn open(&self) -> u64 {
        self.rays.live & !(self.blocked | self.unsure | self.apart)
    }

    /// Whether a crossing lies before the light.
    #[inline]
    pub(super) fn blocks(&self, lane: usize, crossing: &Crossing) -> bool {
        crossing.is_before(self.distance.0[lane])
    }

    /// Notes the rays that meet something before they reach the light.
    fn block(&mut self, found: &PacketCrossings) {
        for lane in lanes(found.any) {
            let blocks = found.t.0[lane] + found.error.0[lane] < self.distance.0[lane];
            self.blocked |= u64::from(blocks) << lane;
        }
    }
}

/// An object that may stand in the way of a light, as far as its box tells.
struct InTheWay<S: Simd> {
    object: u32,
    /// None where there is no glass at all.
    opacity: Option<OpacityClass>,
    /// If it is a ball, and opaque.
    round: Option<BoundingSphere>,
    slabs: Slabs<S>,
}

impl Fast<'_> {
    /// Finds which rays towards a light are blocked. `departures` has the surfaces that they leave. Answers how many shadow packets
    /// were given up, since there are too many objects between their rays.
    #[inline(always)]
    pub(super) fn blocked_of_tile<S: Simd>(
        &self,
        simd: S,
        shadow_packets: &mut [ShadowPacket],
        departures: &[Departures],
        lamp: &ShadowQuery,
        memory: &mut TileMemory,
    ) -> usize {
        for shadow_packet in &mut *shadow_packets {
            if shadow_packet.rays.live.count_ones() < FEW_RAYS {
                shadow_packet.apart = shadow_packet.rays.live;
            }
        }
        let mut open = 0_u16;
        for (k, shadow_packet) in shadow_packets.iter().enumerate() {
            open |= u16::from(shadow_packet.open() != 0) << k;
        }
        if open == 0 {
            return 0;
        }
        let asking = shadow_packets.iter().map(|shadow_packet| {
            (shadow_packet.open() != 0).then_some((&shadow_packet.rays, &shadow_packet.distance))
        });
        let whole = Frustum::towards(simd, &asking, lamp.at, &mut memory.frustums);
        memory.frusta.set(simd, &memory.frustums);
        let mut given_up = 0;
        memory.thin.iter_mut().for_each(PacketCuller::forget);
        memory.forget_sheared();
        memory.stack.clear();
        memory.stack.push(Waits::root(open));
        let mut left_to_ask = [0; FRUSTA];
        for (left, shadow_packet) in left_to_ask.iter_mut().zip(&*shadow_packets) {
            *left = CROWD * shadow_packet.open().count_ones();
        }
        while let Some(Waits { node, frustums, .. }) = memory.stack.pop() {
            let frustums = frustums & open;
            if frustums == 0 {
                continue;
            }
            let node = &self.boxes.nodes()[node as usize];
            memory.counts.cells_visited += 1;
            let (lo, hi) = node.sides(simd);
            let met = whole.meets_boxes(simd, &lo, &hi);
            let mut objects = met.boxes & !node.inner();
            while objects != 0 {
                let slot = objects.trailing_zeros() as usize;
                objects &= objects - 1;
                let Some(Child::Object(object)) = node.child(slot) else { continue };
                let (lo, hi) = node.corners(slot);
                let opacity = lamp.opacity.get(object as usize).copied();
                let is_glass = matches!(opacity, Some(OpacityClass::Clear | OpacityClass::Mixed));
                let round = node.ball(slot).filter(|_| !is_glass);
                let met = match &round {
                    Some(round) => memory.frusta.meets_ball(simd, round.center, round.outer),
                    None => memory.frusta.meets(simd, lo, hi),
                };
                let mut left = met.frustums & frustums & open;
                if left == 0 {
                    continue;
                }
                let slabs = Slabs::around(simd, wide(lo), wide(hi), self.slack);
                let in_the_way = InTheWay { object, opacity, round, slabs };
                while left != 0 {
                    let k = left.trailing_zeros() as usize;
                    left &= left - 1;
                    let Some(left_now) = left_to_ask[k].checked_sub(1) else {
                        given_up += 1;
                        shadow_packets[k].apart |= shadow_packets[k].open();
                        open &= !(1 << k);
                        continue;
                    };
                    left_to_ask[k] = left_now;
                    self.in_shadow_packet(
                        simd,
                        &in_the_way,
                        (&mut shadow_packets[k], &departures[k], lamp),
                        memory,
                        k,
                    );
                    if shadow_packets[k].open() == 0 {
                        open &= !(1 << k);
                    }
                }
                if open == 0 {
                    return given_up;
                }
            }
            // Towards the light the shadow packet narrows: what stands near it stands before most of the rays.
            let from_light = FrustumHits { near: -met.near, ..met };
            let TileMemory { frusta, stack, .. } = memory;
            push_nearest_last(simd, stack, node, &from_light, (frusta, frustums & open));
        }
        given_up
    }

    /// Asks the rays of a shadow packet about an object in their way.
    #[inline(always)]
    fn in_shadow_packet<S: Simd>(
        &self,
        simd: S,
        &InTheWay { object, opacity, ref round, ref slabs }: &InTheWay<S>,
        (shadow_packet, departures, lamp): (&mut ShadowPacket, &Departures, &ShadowQuery),
        memory: &mut TileMemory,
        k: usize,
    ) {
        if !memory.thin[k].is_known() {
            memory.thin[k].set(&shadow_packet.rays);
            memory.thin[k].look(
                #[inline(always)]
                |lane| shadow_packet.distance.0[lane] + self.slack,
            );
        }
        let passing = if let Some(round) = round {
            memory.thin[k].set_points(simd, &shadow_packet.rays);
            let (near, inside) = memory.thin[k].ball(simd, round, self.slack, shadow_packet.open());
            shadow_packet.blocked |= inside;
            memory.counts.primitive_tests += u64::from(near != 0 && near == inside);
            near & !inside
        } else {
            memory.thin[k].set_lines(simd, &shadow_packet.rays);
            memory.thin[k].passing(simd, slabs, shadow_packet.open())
        };
        if passing == 0 {
            return;
        }
        if let Some(OpacityClass::Clear | OpacityClass::Mixed) = opacity {
            self.glass_in_shadow_packet(
                simd,
                (object, passing),
                shadow_packet,
                (departures, lamp),
                memory,
                k,
            );
            return;
        }
        self.object_in_shadow_packet(simd, (object, passing), shadow_packet, departures, memory, k);
    }

    /// A ball in the way of a light.
    #[inline(always)]
    fn ball_in_shadow_packet<S: Simd>(
        &self,
        simd: S,
        (ball, form): (&Ball, &WorldShape),
        near: u64,
        shadow_packet: &mut ShadowPacket,
        departures: &Departures,
        index: u32,
    ) {
        let near = near & !departures.leaving(simd, index);
        let error = ball.most_error::<f64>();
        let start = f64x8::splat(simd, error * (1.0 + self.assembly.off / ball.off()));
        let index = f64x8::splat(simd, f64::from(index));
        for row in 0..ROWS {
            let bits = (near >> (row * LANES)) as u8;
            if bits == 0 {
                continue;
            }
            let spans = ball.spans(&shadow_packet.rays.load(simd, row));
            let met: mask64x8<S> = spans.any & mask64x8::from_bitmask(simd, u64::from(bits));
            if !met.any() {
                continue;
            }
            let here = departures.primitive.load(simd, row).is_equal(index);
            let distance = shadow_packet.distance.load(simd, row);
            let (enter, leave) = (spans.enter.t, spans.leave.t);
            // A ball ahead, well before the light; one behind, or beyond the light.
            let sure = met & !here & enter.is_above(start) & (enter + error).is_below(distance);
            let beside = !here & (leave.is_below(-start) | (enter - error).is_above(distance));
            let mut blocked = sure;
            if (met & !sure & !beside).any() {
                let inward = mask64x8::from_bitmask(simd, departures.inward >> (row * LANES) & 0xFF);
                let off = Some(departures.off.load(simd, row));
                let FirstCrossings { end, any, .. } =
                    firsts_of_spans(spans, form, &RayStarts { here, inward, off });
                blocked = any & (end.t + end.error).is_below(distance);
            }
            shadow_packet.blocked |= (blocked.bits() << (row * LANES)) & near;
        }
    }

    fn object_in_shadow_packet<S: Simd>(
        &self,
        simd: S,
        (object, passing): (u32, u64),
        shadow_packet: &mut ShadowPacket,
        departures: &Departures,
        memory: &mut TileMemory,
        k: usize,
    ) {
        let primitives = &self.assembly.primitives;
        let own = &self.assembly.objects[object as usize];
        match &own.body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                let form = &primitives[*index as usize].form;
                if let WorldShape::Ball(ball) = form {
                    simd.vectorize(
                        #[inline(always)]
                        || {
                            self.ball_in_shadow_packet(
                                simd,
                                (ball, form),
                                passing,
                                shadow_packet,
                                departures,
                                *index,
                            )
                        },
                    );
                    return;
                }
                let wanted = passing & !departures.leaving(simd, *index);
                if wanted != 0 {
                    single(simd, form, (shadow_packet, wanted), departures, *index);
                }
            }
            Body::Surface(index) => {
                memory.counts.primitive_tests += 1;
                let primitive = &primitives[*index as usize];
                let TileMemory { thin, sheared, numbers: Numbers { found, .. }, .. } = memory;
                let sheared = &mut sheared[k];
                let wanted =
                    asking(simd, &mut thin[k], &shadow_packet.rays, &primitive.form, self.slack, passing);
                if wanted == 0 {
                    return;
                }
                let wanted = wanted & !departures.leaving(simd, *index);
                if wanted != 0 {
                    let (rays, from) = (&shadow_packet.rays, Some(departures));
                    let asked = SurfaceQuery { packet: rays, wanted, departures: from };
                    firsts_of_surface(simd, &asked, primitive, *index, sheared, found);
                    shadow_packet.block(found);
                }
            }
            Body::Composite { whole, .. } => {
                let (from, to) = reach(simd, &memory.thin[k], &own.bounds, self.slack, passing);
                memory.numbers.scratch.start();
                let expression = ExprView::from(&**whole);
                let whole = self.subs.loose(object).map(|loose| (loose, expression));
                let mut slicing = Slicing { fast: self, simd, shadow_packet, departures, open: passing };
                slices(self, whole, &mut slicing, expression, (from, to), memory);
            }
        }
    }
}

/// Whose way is cut into slices.
struct Slicing<'a, S> {
    fast: &'a Fast<'a>,
    simd: S,
    shadow_packet: &'a mut ShadowPacket,
    departures: &'a Departures,
    /// The rays that have not met the object yet.
    open: u64,
}

impl<S: Simd> Slices for Slicing<'_, S> {
    /// What is nearest does not matter, only whether there is anything.
    const FEW: usize = SOME;

    fn open(&self) -> u64 {
        self.open
    }

    fn slack(&self) -> f64 {
        self.fast.slack
    }

    fn bounds(&self, from: f64, to: f64) -> Bounds {
        bounds_between(self.simd, &self.shadow_packet.rays, self.open, from, to)
    }

    fn ask(&mut self, expression: ExprView, (from, to): (f64, f64), memory: &mut TileMemory) {
        let (simd, shadow_packet) = (self.simd, &mut *self.shadow_packet);
        let reach = TRange { from: from - SLACK, to: to + SLACK };
        let primitives = &self.fast.assembly.primitives;
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        let Numbers { scratch, found, .. } = &mut memory.numbers;
        let departures = Some(self.departures);
        let asked = CsgQuery { packet: &shadow_packet.rays, wanted: self.open, departures, reach };
        first_of_expressions(simd, &asked, expression, primitives, scratch, found);
        shadow_packet.unsure |= found.unsure;
        self.open &= !(found.unsure | found.any);
        shadow_packet.block(found);
    }
}

/// One convex primitive that is an object.
fn single<S: Simd>(
    simd: S,
    form: &WorldShape,
    (shadow_packet, wanted): (&mut ShadowPacket, u64),
    departures: &Departures,
    index: u32,
) {
    #[inline(always)]
    fn rows<S: Simd>(
        simd: S,
        (form, departures, index, wanted): (&WorldShape, &Departures, u32, u64),
        shadow_packet: &mut ShadowPacket,
        spans: impl Fn(&Rays<f64x8<S>>) -> Spans<f64x8<S>>,
    ) {
        for row in 0..ROWS {
            if (wanted >> (row * LANES)) as u8 == 0 {
                continue;
            }
            let spans = spans(&shadow_packet.rays.load(simd, row));
            if !spans.any.any() {
                continue;
            }
            let here = departures.primitive.load(simd, row).is_equal(f64x8::splat(simd, f64::from(index)));
            let off = Some(departures.off.load(simd, row));
            let starts = RayStarts { here, inward: row_of(simd, departures.inward, row), off };
            let FirstCrossings { end, any, .. } = firsts_of_spans(spans, form, &starts);
            let blocked = any & (end.t + end.error).is_below(shadow_packet.distance.load(simd, row));
            shadow_packet.blocked |= blocked.bits() << (row * LANES) & wanted;
        }
    }
    let about = (form, departures, index, wanted);
    with_spans!(simd, form, rows, about, shadow_packet);
}
