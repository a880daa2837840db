//! A packet of rays against one object, whether the first hit is looked for or any.

use fearless_simd::Simd;

use crate::math::{Bounds, Mask, Number, RayPacket, Rays, RealIds, SimdIds};
use crate::solid::{
    Ball, Body, Ends, ExprView, FirstCrossings, RayStarts, Spans, SurfaceQuery, WorldShape, firsts_of_spans,
    firsts_of_surface, with_spans,
};

use super::Fast;
use super::cells::CellsTest;
use super::composite::CompositeTest;
use super::memory::TileMemory;
use super::mesh_walk::{BezierObject, MeshObject};
use super::packet_culler::{PacketCuller, Slabs};
use super::packet_hits::{Faces, HitCandidate};
use super::precision::Precision;
use super::sink::{HitSink, offer_crossings, offer_hits};
use super::source::PacketSource;

/// Rays that may meet an object.
#[derive(Clone, Copy)]
pub(super) struct PacketTest<'a, T = f64> {
    /// Their packet.
    pub source: PacketSource<'a, T>,
    /// Its number in the tile.
    pub k: usize,
    /// The rays that may pass the object's box, a bit for each; at least one.
    pub passing: u64,
    /// What lies farther away does not matter.
    pub farthest: f64,
}

/// Rays that may meet a convex primitive that is an object.
#[derive(Clone, Copy)]
struct ConvexTest<'a, T> {
    source: PacketSource<'a, T>,
    wanted: u64,
    form: &'a WorldShape,
    object: u32,
    primitive: u32,
}

impl Fast<'_> {
    /// What a packet's rays meet first of one object. Answers whether any ray may have met it.
    pub(super) fn object_of_packet<S: Simd, T: Precision, H: HitSink<T>>(
        &self,
        simd: S,
        object: u32,
        test: &PacketTest<T>,
        sink: &mut H,
        memory: &mut TileMemory,
    ) -> bool {
        let PacketTest { source, k, passing, .. } = *test;
        let primitives = &self.assembly.primitives;
        if let Some((primitive, mesh)) = self.assembly.mesh(object) {
            return self.mesh_of_packet(simd, &MeshObject { object, primitive, mesh }, test, sink, memory);
        }
        if let Some((primitive, patches)) = self.assembly.patches(object) {
            let of = BezierObject { object, primitive, patches };
            return self.patches_of_packet(simd, &of, test, sink, memory);
        }
        let own = &self.assembly.objects[object as usize];
        match &own.body {
            Body::Single(index) => {
                memory.counts.primitive_tests += 1;
                // What is convex is not met again by a ray that leaves it.
                let wanted = passing & !source.leaving(simd, *index);
                if wanted == 0 {
                    return false;
                }
                let form = &primitives[*index as usize].form;
                let convex = ConvexTest { source, wanted, form, object, primitive: *index };
                let uncertain = self.convex(simd, &convex, sink);
                if !T::IS_DOUBLE && uncertain != 0 {
                    memory.counts.primitive_tests += 1;
                    let met = &mut *memory.met;
                    met.clear();
                    let (source, wanted) = (source.full(), uncertain);
                    let convex = ConvexTest { source, wanted, form, object, primitive: *index };
                    self.convex(simd, &convex, met);
                    offer_hits(simd, met, uncertain, object, sink);
                }
                true
            }
            Body::Surface(index) => {
                let primitive = &primitives[*index as usize];
                if let WorldShape::Bezier(patches) = &primitive.form {
                    let of = BezierObject { object, primitive: *index, patches };
                    return self.patches_of_packet(simd, &of, test, sink, memory);
                }
                memory.counts.primitive_tests += 1;
                let TileMemory { cullers, sheared, doubles, .. } = memory;
                let (packet, departures) = (source.full_rays, source.full_departures);
                let (culler, slack) = (&mut cullers[k], self.slack_of::<T>());
                let wanted = near_surface(simd, culler, packet, &primitive.form, slack, passing)
                    & !source.leaving(simd, *index);
                if wanted == 0 {
                    return false;
                }
                let asked = SurfaceQuery { packet, wanted, departures };
                firsts_of_surface(simd, &asked, primitive, *index, &mut sheared[k], &mut doubles.found);
                offer_crossings(simd, &doubles.found, object, sink);
                doubles.found.any != 0
            }
            Body::Composite { whole, .. } => {
                let cells = self.subs.cells(object);
                let (mut open, mut start) = (passing, 0.0);
                if cells.is_none() || !memory.in_cells.contains(&object) {
                    let slack = self.slack_of::<T>();
                    let (from, to) = box_range(simd, &memory.cullers[k], &own.bounds, slack, passing);
                    memory.doubles.csg.start();
                    memory.singles.csg.start();
                    let expression = ExprView::from(&**whole);
                    let loose = cells.map(|cells| (cells.loose(), expression));
                    let mut composite = CompositeTest {
                        fast: self,
                        simd,
                        source,
                        object,
                        k,
                        asked: passing,
                        whole: loose,
                        open,
                        work: 0,
                        given_up: None,
                        sink,
                    };
                    start = composite.trace(expression, from, to.min(test.farthest), memory);
                    open = composite.open;
                }
                if let Some(cells) = cells.filter(|_| start < f64::INFINITY) {
                    if !memory.in_cells.contains(&object) {
                        memory.in_cells.push(object);
                    }
                    let farthest = test.farthest;
                    let mut test = CellsTest {
                        fast: self,
                        simd,
                        source,
                        object,
                        cells,
                        k,
                        asked: passing,
                        start,
                        farthest,
                        open,
                        uncertain: 0,
                    };
                    test.trace(sink, memory);
                }
                true
            }
        }
    }

    /// What rays meet first of a convex primitive. Answers for which double precision is to say whether they
    /// meet it.
    fn convex<S: Simd, T: Precision, H: HitSink<T>>(
        &self,
        simd: S,
        test: &ConvexTest<T>,
        sink: &mut H,
    ) -> u64 {
        let mut uncertain = 0;
        if let WorldShape::Ball(ball) = test.form {
            simd.vectorize(
                #[inline(always)]
                || {
                    let start = match test.source.departures {
                        None => 2.0 * ball.most_error::<T>(),
                        Some(_) => {
                            ball.most_error::<T>() * (1.0 + self.assembly.place_error / ball.place_error())
                        }
                    };
                    ball_of_packet(simd, test, ball, start, &mut uncertain, sink);
                },
            );
        } else {
            with_spans!(simd, test.form, convex_of_packet, test, &mut uncertain, sink);
        }
        uncertain & test.wanted
    }
}

/// What rays meet first of a ball. A crossing beyond `start` lies at the start of no ray, and one before
/// −`start` behind it.
#[inline(always)]
fn ball_of_packet<S: Simd, T: Precision, H: HitSink<T>>(
    simd: S,
    test: &ConvexTest<T>,
    ball: &Ball,
    start: f64,
    uncertain: &mut u64,
    sink: &mut H,
) {
    let ConvexTest { source, wanted, form, object, primitive } = *test;
    let yes = T::mask_of(simd, u64::MAX, 0);
    let (surface, ids) = (Faces::Ids(RealIds::<T, S>::all(simd, 0)), RealIds::<T, S>::all(simd, primitive));
    let start = T::all(simd, start);
    for register in 0..T::REGISTERS {
        if !T::has_any(wanted, register) {
            continue;
        }
        let wanted = T::mask_of(simd, wanted, register);
        let mut spans = ball.spans(&source.rays.load(simd, register));
        if !(spans.may & wanted).any() {
            continue;
        }
        spans.any = spans.any & wanted;
        let starts = source.starts(simd, register, primitive);
        if !T::IS_DOUBLE {
            *uncertain |= T::bits_of(simd, take_uncertain(&mut spans, form, &starts), register);
        }
        // Mostly the ball is certainly ahead of the start, or behind it.
        let ahead = spans.enter.t.is_above(start) & !starts.here;
        let mut is_close = (spans.any & !ahead).any();
        if is_close {
            let behind = spans.leave.t.is_below(-start) & !starts.here;
            is_close = (spans.any & !ahead & !behind).any();
        }
        let met = if is_close {
            let FirstCrossings { end, entering, any } = firsts_of_spans(spans, form, &starts);
            HitCandidate { any, t: end.t, error: end.error, entering, object, primitive: ids, surface }
        } else {
            let Ends { t, error, .. } = spans.enter;
            HitCandidate { any: spans.any & ahead, t, error, entering: yes, object, primitive: ids, surface }
        };
        sink.offer(simd, register, &met);
    }
}

/// What rays meet first of a convex primitive, by the spans of its form.
#[inline(always)]
fn convex_of_packet<S: Simd, T: Precision, H: HitSink<T>>(
    simd: S,
    test: &ConvexTest<T>,
    uncertain: &mut u64,
    sink: &mut H,
    spans: impl Fn(&Rays<T::SimdReal<S>>) -> Spans<T::SimdReal<S>>,
) {
    let ConvexTest { source, wanted, form, object, primitive } = *test;
    let ids = RealIds::<T, S>::all(simd, primitive);
    for register in 0..T::REGISTERS {
        if !T::has_any(wanted, register) {
            continue;
        }
        let wanted = T::mask_of(simd, wanted, register);
        let mut spans = spans(&source.rays.load(simd, register));
        if !(spans.may & wanted).any() {
            continue;
        }
        spans.any = spans.any & wanted;
        let starts = source.starts(simd, register, primitive);
        if !T::IS_DOUBLE {
            *uncertain |= T::bits_of(simd, take_uncertain(&mut spans, form, &starts), register);
        }
        let FirstCrossings { end, entering, any } = firsts_of_spans(spans, form, &starts);
        let Ends { t, error, surface } = end;
        let surface = Faces::Numbers(surface);
        sink.offer(
            simd,
            register,
            &HitCandidate { any, t, error, entering, object, primitive: ids, surface },
        );
    }
}

/// Takes out the rays that may have a span, or start on a surface, and may not; answers which these are.
#[inline(always)]
fn take_uncertain<N: Number>(spans: &mut Spans<N>, form: &WorldShape, starts: &RayStarts<N>) -> N::Mask {
    let at_start = starts.near(&spans.enter, form) | starts.near(&spans.leave, form);
    let uncertain = spans.may & (!spans.any | at_start);
    spans.any = spans.any & !uncertain;
    uncertain
}

/// Those of some rays of a packet that may meet a surface, as far as its own form says.
fn near_surface<S: Simd>(
    simd: S,
    culler: &mut PacketCuller,
    packet: &RayPacket,
    form: &WorldShape,
    slack: f64,
    wanted: u64,
) -> u64 {
    let WorldShape::Tube(tube) = form else { return wanted };
    simd.vectorize(
        #[inline(always)]
        || culler.beside(simd, packet, &tube.bar(), slack, wanted),
    )
}

/// Between which distances some rays of a packet pass a box, all of them.
fn box_range<S: Simd>(simd: S, culler: &PacketCuller, b: &Bounds, slack: f64, passing: u64) -> (f64, f64) {
    simd.vectorize(
        #[inline(always)]
        || culler.range(simd, &Slabs::around(simd, b.lo, b.hi, slack), passing),
    )
}
