//! What the rays of a tile meet first.
//!
//! The frustum of the whole tile walks the boxes once, nearest first. Where it meets objects, each packet of the tile
//! asks with a frustum of its own, and the objects that are left are asked by eight rays at a time, or by sixteen in single precision. What lies behind
//! the farthest hit of all rays is never looked at.

use fearless_simd::Simd;

use crate::lattice::{Child, FRUSTA, SLACK};
use crate::math::{Bounds, Mask, Number, RayPacket, Rays, Real};
use crate::solid::{
    Ball, Body, CsgQuery, Ends, ExprView, FirstCrossings, PacketCrossings, Spans, Starts, TRange, WorldShape,
    first_of_expressions, firsts_of_spans, firsts_of_surface, with_spans,
};

use super::Fast;
use super::memory::{Asks, Numbers, TileMemory};
use super::packet_culler::Slabs;
use super::packet_hits::{HitCandidate, PacketHits};
use super::slices::{Slices, slices};
use super::source::{PacketSource, PacketSources};
use super::walk::{Waits, asking, bounds_between, push_nearest_last, reach, wide};

/// The most objects that a packet is asked about, for each of its rays: where a dot holds many objects, or rays run apart,
/// they are incoherent. Fewer than for a shadow packet, which ends at the first thing that it meets.
const CROWD: u32 = 1;

impl Fast<'_> {
    /// The first hits of the rays of a tile. `nearest` has as many as there are packets. Answers which packets may have met
    /// anything, and how many were given up. Of those that were still to be made the others are not: that none of their rays
    /// is unsure or without reordering is all that is known of them.
    #[inline(always)]
    pub(super) fn first_of_tile<S: Simd, T: Asks>(
        &self,
        simd: S,
        sources: &mut PacketSources,
        (own, nearest): (&mut [RayPacket<T>], &mut [PacketHits<T>]),
        memory: &mut TileMemory,
    ) -> (u16, usize) {
        let slack = self.slack_of::<T>();
        let whole = sources.whole(simd);
        let seen = matches!(sources, PacketSources::Primary { .. });
        memory.forget_sheared();
        let TileMemory { far, stack, .. } = memory;
        far.clear();
        for (k, found) in nearest.iter_mut().enumerate() {
            far.push(if sources.is_blind(k) { f64::NEG_INFINITY } else { f64::INFINITY });
            if seen {
                found.forget_rays();
            } else {
                found.clear();
            }
        }
        stack.clear();
        stack.push(Waits::root(u16::MAX));
        let mut spread = false;
        let (mut touched, mut given_up) = (0, 0);
        let mut left_to_ask = [0; FRUSTA];
        while let Some(Waits { near, node, frustums }) = memory.stack.pop() {
            let farthest = memory.far.iter().fold(f64::NEG_INFINITY, |most, &far| f64::max(most, far));
            if near > farthest + slack {
                continue;
            }
            let node = &self.boxes.nodes()[node as usize];
            memory.counts.cells_visited += 1;
            let (lo, hi) = node.sides(simd);
            let met = whole.meets_boxes(simd, &lo, &hi);
            if met.boxes == 0 {
                continue;
            }
            if !spread {
                spread = true;
                sources.spread(simd, self.level, (&mut memory.frustums, &mut memory.frusta));
            }
            let mut objects = met.boxes & !node.inner();
            while objects != 0 {
                let slot = objects.trailing_zeros() as usize;
                objects &= objects - 1;
                let Some(Child::Object(object)) = node.child(slot) else { continue };
                let (lo, hi) = node.corners(slot);
                let round = node.ball(slot);
                let met = match &round {
                    Some(round) => memory.frusta.meets_ball(simd, round.center, round.outer),
                    None => memory.frusta.meets(simd, lo, hi),
                };
                let mut left = met.frustums & frustums;
                if left == 0 {
                    continue;
                }
                let slabs = Slabs::around(simd, wide(lo), wide(hi), slack);
                while left != 0 {
                    let k = left.trailing_zeros() as usize;
                    left &= left - 1;
                    // What is not a number is not known to be farther.
                    let behind = f64::from(met.near[k]) > memory.far[k] + slack;
                    if !behind {
                        let nearest = &mut nearest[k];
                        if touched >> k & 1 == 0 {
                            touched |= 1 << k;
                            if seen {
                                sources.make(k);
                                nearest.clear();
                            }
                            let packet = sources.get(k).rays;
                            T::take(simd, packet, own, k);
                            left_to_ask[k] = CROWD * packet.live.count_ones();
                            memory.thin[k].set(packet);
                        }
                        let source = T::source(sources.get(k), own, k);
                        let packet = source.full_rays;
                        let Some(left_to_ask_now) = left_to_ask[k].checked_sub(1) else {
                            given_up += 1;
                            nearest.apart = packet.live;
                            memory.far[k] = f64::NEG_INFINITY;
                            continue;
                        };
                        left_to_ask[k] = left_to_ask_now;
                        let passing = if let Some(round) = &round {
                            memory.thin[k].set_points(simd, packet);
                            memory.thin[k].ball(simd, round, slack, packet.live).0
                        } else {
                            memory.thin[k].set_lines(simd, packet);
                            memory.thin[k].passing(simd, &slabs, packet.live)
                        };
                        if passing != 0
                            && self.object_of_packet(simd, (object, passing), source, nearest, memory, k)
                        {
                            memory.far[k] = nearest.farthest(simd, source.rays);
                            memory.thin[k].look(
                                #[inline(always)]
                                |lane| nearest.reach_of(lane) + slack,
                            );
                        }
                    }
                }
            }
            let TileMemory { frusta, stack, .. } = memory;
            push_nearest_last(simd, stack, node, &met, (frusta, frustums));
        }
        (touched, given_up)
    }

    /// The first hits of a packet with one object, whose box some of its rays may pass. Answers whether any ray came near it.
    pub(super) fn object_of_packet<S: Simd, T: Asks>(
        &self,
        simd: S,
        (object, passing): (u32, u64),
        source: PacketSource<T>,
        nearest: &mut PacketHits<T>,
        memory: &mut TileMemory,
        k: usize,
    ) -> bool {
        let slack = self.slack_of::<T>();
        let primitives = &self.assembly.primitives;
        let own = &self.assembly.objects[object as usize];
        match &own.body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                let form = &primitives[*index as usize].form;
                let doubtful = self.single(simd, form, (source, passing), nearest, [object, *index]);
                if !T::DECIDES && doubtful != 0 {
                    memory.counts.primitive_tests += 1;
                    let met = &mut *memory.met;
                    met.clear();
                    self.single(simd, form, (source.full(), doubtful), met, [object, *index]);
                    offer_met(simd, met, doubtful, object, nearest);
                }
                true
            }
            Body::Surface(index) => {
                memory.counts.primitive_tests += 1;
                let primitive = &primitives[*index as usize];
                let TileMemory { thin, sheared, numbers: Numbers { found, .. }, .. } = memory;
                let sheared = &mut sheared[k];
                let wanted = asking(simd, &mut thin[k], source.full_rays, &primitive.form, slack, passing);
                if wanted == 0 {
                    return false;
                }
                let (rays, departures) = (source.full_rays, source.full_departures);
                firsts_of_surface(simd, rays, wanted, (primitive, *index), departures, sheared, found);
                if found.any != 0 {
                    offer_found(simd, found, object, nearest);
                }
                found.any != 0
            }
            Body::Composite { whole, .. } => {
                let (from, to) = reach(simd, &memory.thin[k], &own.bounds, slack, passing);
                let way = (passing, from, to.min(memory.far[k] + slack));
                self.composite(simd, (object, ExprView::from(&**whole)), source, way, nearest, memory);
                true
            }
        }
    }

    /// The first hits of the rays of a packet with one convex primitive that is an object. Answers of which double precision are to
    /// say whether they meet it.
    fn single<S: Simd, T: Asks>(
        &self,
        simd: S,
        form: &WorldShape,
        (source, passing): (PacketSource<T>, u64),
        nearest: &mut PacketHits<T>,
        indices: [u32; 2],
    ) -> u64 {
        let WorldShape::Ball(ball) = form else {
            return convex_of_packet(simd, form, (source, passing), nearest, indices);
        };
        simd.vectorize(
            #[inline(always)]
            || {
                let start = match source.departures {
                    None => 2.0 * ball.most_error::<T>(),
                    Some(_) => ball.most_error::<T>() * (1.0 + self.assembly.off / ball.off()),
                };
                ball_of_packet(simd, (ball, form, start), passing, source, nearest, indices)
            },
        )
    }

    /// The first hits of a packet with a composite object: its way through the object's box in slices, each with what the
    /// expression is there.
    fn composite<S: Simd, T: Asks>(
        &self,
        simd: S,
        (object, expression): (u32, ExprView),
        source: PacketSource<T>,
        (open, from, to): (u64, f64, f64),
        nearest: &mut PacketHits<T>,
        memory: &mut TileMemory,
    ) {
        T::numbers(memory).scratch.start();
        let whole = self.subs.loose(object).map(|loose| (loose, expression));
        let mut slicing = Slicing { fast: self, simd, source, object, open, nearest };
        slices(self, whole, &mut slicing, expression, (from, to), memory);
    }
}

/// Which rays may have a span, or start on a surface, and may not: of these none is left.
#[inline(always)]
fn doubts<N: Number>(spans: &mut Spans<N>, form: &WorldShape, starts: &Starts<N>) -> N::Mask {
    let at_start = starts.near(&spans.enter, form) | starts.near(&spans.leave, form);
    let doubtful = spans.may & (!spans.any | at_start);
    spans.any = spans.any & !doubtful;
    doubtful
}

/// Offers what some rays met of one object by double precision.
fn offer_met<S: Simd, T: Real>(
    simd: S,
    met: &PacketHits,
    rays: u64,
    object: u32,
    nearest: &mut PacketHits<T>,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            for row in 0..T::ROWS {
                if !T::has_any(rays, row) {
                    continue;
                }
                let t = met.t.load_nearest::<T, S>(simd, row);
                let met = HitCandidate {
                    any: T::row_of(simd, rays, row) & t.is_below(T::all(simd, f64::INFINITY)),
                    t,
                    error: loosened::<T, S>(met.error.load_nearest::<T, S>(simd, row), t),
                    entering: T::row_of(simd, met.entering, row),
                    object,
                    primitive: met.primitive.load_nearest::<T, S>(simd, row),
                    surface: met.surface.load_nearest::<T, S>(simd, row),
                };
                nearest.offer(simd, row, &met);
            }
        },
    );
}

/// The first hits of the rays of a packet that are near a ball. A crossing beyond `start` lies at the start of no ray. Answers
/// of which double precision are to say.
#[inline(always)]
fn ball_of_packet<S: Simd, T: Asks>(
    simd: S,
    (ball, form, start): (&Ball, &WorldShape, f64),
    near: u64,
    source: PacketSource<T>,
    nearest: &mut PacketHits<T>,
    [object, index]: [u32; 2],
) -> u64 {
    let mut doubtful = 0;
    let yes = T::row_of(simd, u64::MAX, 0);
    let (surface, primitive) = (T::all(simd, 0.0), T::all(simd, f64::from(index)));
    let start = T::all(simd, start);
    for row in 0..T::ROWS {
        if !T::has_any(near, row) {
            continue;
        }
        let mut spans = ball.spans(&source.rays.load(simd, row));
        if !spans.may.any() {
            continue;
        }
        let starts = source.starts(simd, row, primitive);
        if !T::DECIDES {
            doubtful |= T::bits_of(simd, doubts(&mut spans, form, &starts), row);
        }
        let ahead = spans.enter.t.is_above(start) & !starts.here;
        let met = if (spans.any & !ahead).any() {
            let FirstCrossings { end, entering, any } = firsts_of_spans(spans, form, &starts);
            HitCandidate { any, t: end.t, error: end.error, entering, object, primitive, surface }
        } else {
            let Ends { t, error, .. } = spans.enter;
            HitCandidate { any: spans.any, t, error, entering: yes, object, primitive, surface }
        };
        nearest.offer(simd, row, &met);
    }
    doubtful & near
}

/// Whose way is cut into slices.
struct Slicing<'a, S, T> {
    fast: &'a Fast<'a>,
    simd: S,
    source: PacketSource<'a, T>,
    object: u32,
    /// The rays that have not met the object yet.
    open: u64,
    nearest: &'a mut PacketHits<T>,
}

impl<S: Simd, T: Asks> Slices for Slicing<'_, S, T> {
    /// What lies behind the nearest is mostly hidden: measured on solids of OpenSCAD, as [`SOME`](super::slices::SOME) is.
    const FEW: usize = 3;

    fn open(&self) -> u64 {
        self.open
    }

    fn slack(&self) -> f64 {
        self.fast.slack_of::<T>()
    }

    fn bounds(&self, from: f64, to: f64) -> Bounds {
        bounds_between(self.simd, self.source.rays, self.open, from, to)
    }

    fn ask(&mut self, expression: ExprView, (from, to): (f64, f64), memory: &mut TileMemory) {
        let (simd, PacketSource { rays: packet, departures, .. }) = (self.simd, self.source);
        let slack = SLACK * T::COARSER;
        let reach = TRange { from: from - slack, to: to + slack };
        let primitives = &self.fast.assembly.primitives;
        memory.counts.primitive_tests += expression.leaves.len() as u64;
        memory.counts.csg_evaluations += 1;
        let Numbers { scratch, found, .. } = T::numbers(memory);
        let asked = CsgQuery { packet, wanted: self.open, departures, reach };
        first_of_expressions(simd, &asked, expression, primitives, scratch, found);
        if found.any != 0 {
            self.open &= !found.any;
            offer_found(simd, found, self.object, self.nearest);
        }
        let mut unsure = found.unsure;
        if unsure != 0 && !T::DECIDES {
            memory.counts.primitive_tests += expression.leaves.len() as u64;
            memory.counts.csg_evaluations += 1;
            let Numbers { scratch, found, .. } = f64::numbers(memory);
            scratch.start();
            let PacketSource { rays: packet, departures, .. } = self.source.full();
            let asked = CsgQuery { packet, wanted: unsure, departures, reach };
            first_of_expressions(simd, &asked, expression, primitives, scratch, found);
            if found.any != 0 {
                self.open &= !found.any;
                offer_found(simd, found, self.object, self.nearest);
            }
            unsure = found.unsure;
        }
        self.nearest.unsure |= unsure;
        self.open &= !unsure;
    }
}

/// How far a distance may be off that was rounded to single precision: by half an ulp more.
#[inline(always)]
fn loosened<T: Real, S: Simd>(error: T::SimdReal<S>, t: T::SimdReal<S>) -> T::SimdReal<S> {
    if T::DECIDES { error } else { error + t.magnitude() * (0.5 * f64::EPSILON * T::COARSER) }
}

/// Offers what an expression's crossings are.
fn offer_found<S: Simd, T: Real, U: Real>(
    simd: S,
    found: &PacketCrossings<U>,
    object: u32,
    nearest: &mut PacketHits<T>,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            for row in 0..T::ROWS {
                if !T::has_any(found.any, row) {
                    continue;
                }
                let t = found.t.load_nearest::<T, S>(simd, row);
                let met = HitCandidate {
                    any: T::row_of(simd, found.any, row),
                    t,
                    error: loosened::<T, S>(found.error.load_nearest::<T, S>(simd, row), t),
                    entering: T::row_of(simd, found.entering, row),
                    object,
                    primitive: found.primitive.load_nearest::<T, S>(simd, row),
                    surface: found.surface.load_nearest::<T, S>(simd, row),
                };
                nearest.offer(simd, row, &met);
            }
        },
    );
}

/// The first hits of the rays of a packet with one convex primitive that is an object. Answers of which double precision are to say.
fn convex_of_packet<S: Simd, T: Asks>(
    simd: S,
    form: &WorldShape,
    (source, wanted): (PacketSource<T>, u64),
    nearest: &mut PacketHits<T>,
    [object, index]: [u32; 2],
) -> u64 {
    #[inline(always)]
    fn rows<S: Simd, T: Asks>(
        simd: S,
        (form, source, wanted, object, index): (&WorldShape, PacketSource<T>, u64, u32, u32),
        (nearest, doubtful): (&mut PacketHits<T>, &mut u64),
        spans: impl Fn(&Rays<T::SimdReal<S>>) -> Spans<T::SimdReal<S>>,
    ) {
        let primitive = T::all(simd, f64::from(index));
        for row in 0..T::ROWS {
            if !T::has_any(wanted, row) {
                continue;
            }
            let mut spans = spans(&source.rays.load(simd, row));
            if !spans.may.any() {
                continue;
            }
            let starts = source.starts(simd, row, primitive);
            if !T::DECIDES {
                *doubtful |= T::bits_of(simd, doubts(&mut spans, form, &starts), row);
            }
            let FirstCrossings { end, entering, any } = firsts_of_spans(spans, form, &starts);
            let Ends { t, error, surface } = end;
            let met = HitCandidate { any, t, error, entering, object, primitive, surface };
            nearest.offer(simd, row, &met);
        }
    }
    let about = (form, source, wanted, object, index);
    let mut doubtful = 0;
    with_spans!(simd, form, rows, about, (nearest, &mut doubtful));
    doubtful & wanted
}
