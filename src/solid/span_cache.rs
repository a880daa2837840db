//! The spans of a packet in the primitives that it was asked about: each is computed once, however many
//! slices of the way, and expressions in them, name the primitive.

use fearless_simd::Simd;

use crate::math::{Lanes, Mask, Number, RayPacket, Rays, Real};

use super::csg_query::{CsgQuery, PacketRange};
use super::primitive::WorldShape;
use super::span::{End, Ends, Spans};

/// Calls `$kernel($simd, $args…, spans)` with the spans of a convex form, compiled for each form by itself
/// and for the SIMD width. Other forms have none.
macro_rules! with_spans {
    ($simd:expr, $form:expr, $kernel:ident, $($arg:expr),* $(,)?) => {
        with_spans!(@each $simd, $form, $kernel, ($($arg),*), Ball, AxisBox, SkewBox, Quadric, Facets)
    };
    (@each $simd:expr, $form:expr, $kernel:ident, $args:tt, $($kind:ident),*) => {
        match $form {
            $($crate::solid::WorldShape::$kind(solid) => with_spans!(@one $simd, $kernel, $args, solid),)*
            _ => {}
        }
    };
    (@one $simd:expr, $kernel:ident, ($($arg:expr),*), $solid:ident) => {
        $simd.vectorize(
            #[inline(always)]
            || $kernel($simd, $($arg,)* #[inline(always)] |rays| $solid.spans(rays)),
        )
    };
}
pub(crate) use with_spans;

/// So many spans are kept at most.
const MANY: usize = 64;

/// One end of the spans in one primitive.
#[derive(Clone, Debug)]
pub(super) struct SpanEnds<T> {
    pub t: Lanes<T>,
    pub error: Lanes<T>,
    pub surface: Lanes<T>,
    /// The rays that are yet to cross here.
    pub ahead: u64,
    /// The rays that cross here in the place that is looked at.
    pub crossing: u64,
}

/// The spans in one primitive.
#[derive(Clone, Debug)]
pub(super) struct CachedSpans<T> {
    /// The rays that they are known of, whole rows.
    known: u64,
    /// How far its crossings may be off: [`WorldShape::place_error`]; and the share of that which is our own
    /// rounding.
    pub place_error: f64,
    pub rounding_share: f64,
    /// Which rays have one; and which may have one, as far as double precision might say.
    any: u64,
    uncertain: u64,
    pub enter: SpanEnds<T>,
    pub leave: SpanEnds<T>,
}

impl<T: Real> SpanEnds<T> {
    const NONE: Self = Self {
        t: Lanes::filled(T::ZERO),
        error: Lanes::filled(T::ZERO),
        surface: Lanes::filled(T::ZERO),
        ahead: 0,
        crossing: 0,
    };

    /// Those of a register.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, register: usize) -> Ends<T::SimdReal<S>> {
        Ends {
            t: self.t.load(simd, register),
            error: self.error.load(simd, register),
            surface: self.surface.load(simd, register),
        }
    }
}

impl CachedSpans<f64> {
    /// Forgets all rays, for a primitive that may be off its place by as much.
    pub fn reset(&mut self, place_error: f64) {
        (self.any, self.place_error, self.rounding_share) = (0, place_error, 1.0);
    }

    /// Sets the span of one ray.
    #[inline]
    pub fn put(&mut self, lane: usize, enter: End, leave: End) {
        self.any |= 1 << lane;
        for (side, end) in [(&mut self.enter, enter), (&mut self.leave, leave)] {
            side.t.0[lane] = end.t;
            side.error.0[lane] = end.error;
            side.surface.0[lane] = f64::from(end.surface);
        }
    }
}

impl<T: Real> CachedSpans<T> {
    pub const NONE: Self = Self {
        known: 0,
        place_error: 0.0,
        rounding_share: 0.0,
        any: 0,
        uncertain: 0,
        enter: SpanEnds::NONE,
        leave: SpanEnds::NONE,
    };

    /// The two ends.
    #[inline(always)]
    pub fn sides(&self) -> [&SpanEnds<T>; 2] {
        [&self.enter, &self.leave]
    }

    /// The two ends.
    #[inline(always)]
    pub fn sides_mut(&mut self) -> [&mut SpanEnds<T>; 2] {
        [&mut self.enter, &mut self.leave]
    }

    /// Looks ahead at the spans of some rays that can matter within `reach`. Far outside it only the state
    /// inside it matters: none for a span that ends before it or starts behind it.
    #[inline(always)]
    pub fn look<S: Simd>(&mut self, simd: S, wanted: u64, reach: &PacketRange<T>) -> u64 {
        let mut ahead = 0;
        let rays = wanted & self.any;
        for register in 0..T::REGISTERS {
            if !T::has_any(rays, register) {
                continue;
            }
            let (from, to) = (reach.from.load(simd, register), reach.to.load(simd, register));
            let (leave, enter) = (self.leave.t.load(simd, register), self.enter.t.load(simd, register));
            let ends_before = (leave + self.leave.error.load(simd, register)).is_below(from);
            let starts_behind = (enter - self.enter.error.load(simd, register)).is_above(to);
            ahead |= T::bits_of(simd, !(ends_before | starts_behind), register);
        }
        ahead &= rays;
        (self.enter.ahead, self.leave.ahead) = (ahead, ahead);
        (self.enter.crossing, self.leave.crossing) = (0, 0);
        ahead
    }
}

/// What is known of one packet.
#[derive(Clone, Debug, Default)]
pub(super) struct SpanCache<T> {
    /// Those that are in use come first.
    spans: Vec<CachedSpans<T>>,
    /// Of those in use: whose they are, each by its index.
    primitives: Vec<u32>,
}

impl<T: Real> SpanCache<T> {
    /// Forgets all: another packet follows.
    pub fn clear(&mut self) {
        self.primitives.clear();
    }

    /// All spans, by their places.
    pub fn spans(&mut self) -> &mut [CachedSpans<T>] {
        &mut self.spans[..self.primitives.len()]
    }

    /// Makes room for so many more, where that takes forgetting all: more than a few dozen are seldom asked
    /// about again, and each takes up to 3 KB.
    pub fn make_room(&mut self, more: usize) {
        if self.primitives.len() + more > MANY {
            self.clear();
        }
    }

    /// Looks ahead at the spans in a primitive, and gives their place, which rays have one that can matter,
    /// and of which double precision is to say whether they have one.
    pub fn look<S: Simd>(
        &mut self,
        simd: S,
        asked: &CsgQuery<T>,
        primitive: u32,
        form: &WorldShape,
    ) -> (u32, [u64; 2]) {
        let CsgQuery { packet, wanted, departures, reach, .. } = *asked;
        // The last are the likeliest.
        let known = self.primitives.iter().rposition(|&known| known == primitive);
        let place = known.unwrap_or_else(|| {
            let place = self.primitives.len();
            if place == self.spans.len() {
                self.spans.push(CachedSpans::NONE);
            }
            self.primitives.push(primitive);
            let new = &mut self.spans[place];
            (new.known, new.any, new.uncertain) = (0, 0, 0);
            (new.place_error, new.rounding_share) =
                (form.place_error() * T::EPSILON_RATIO, form.rounding_share());
            place
        });
        let spans = &mut self.spans[place];
        if wanted & !spans.known != 0 {
            let (here, inward) = departures.map_or((0, 0), |d| d.here(simd, primitive));
            let unknown = wanted & !spans.known;
            with_spans!(simd, form, learn, packet, unknown, here, inward, spans);
        }
        let ahead = simd.vectorize(
            #[inline(always)]
            || spans.look(simd, wanted, reach),
        );
        (place as u32, [ahead, spans.uncertain & wanted])
    }
}

#[inline(always)]
fn learn<S: Simd, T: Real>(
    simd: S,
    packet: &RayPacket<T>,
    wanted: u64,
    here: u64,
    inward: u64,
    known: &mut CachedSpans<T>,
    spans: impl Fn(&Rays<T::SimdReal<S>>) -> Spans<T::SimdReal<S>>,
) {
    for register in 0..T::REGISTERS {
        if !T::has_any(wanted, register) {
            continue;
        }
        known.known |= T::REGISTER_BITS << (register * T::LANES);
        let mut spans = spans(&packet.load(simd, register));
        let any = spans.any & !T::mask_of(simd, here & !inward, register);
        if !T::IS_DOUBLE {
            known.uncertain |= T::bits_of(simd, spans.may & !spans.any, register);
        }
        if !any.any() {
            continue;
        }
        if here != 0 {
            // A start on a surface is 0 by construction.
            let zero = T::all(simd, 0.0);
            let start = Ends { t: zero, error: zero, surface: zero };
            spans.enter = Ends::choose(T::mask_of(simd, inward, register), start, spans.enter);
        }
        let any = any & spans.enter.t.is_below(spans.leave.t);
        known.any |= T::bits_of(simd, any, register);
        for (side, end) in [(&mut known.enter, spans.enter), (&mut known.leave, spans.leave)] {
            side.t.store(register, end.t);
            side.error.store(register, end.error);
            side.surface.store(register, end.surface);
        }
    }
}
