//! Where a ray is inside a solid.

use crate::math::{Mask, Number};

/// How far a coordinate of a crossing may be off, as a share of the lengths it was computed from.
///
/// The longest chain of roundings between a ray and a crossing: the ray's start, which was itself computed as
/// a point on a ray (a product and a sum, 2 roundings, of lengths up to twice [`WORLD`]: 4), inverting a map
/// (8), moving the ray into the unit space (a difference and a dot product of three terms, 4, for the start
/// and again for the direction), and re-centring it twice (5 each): 30, rounded up to 32 half-ulps of
/// `f64::EPSILON / 2`. What composing the map took is
/// [`scene::Primitive::map_error`](crate::scene::Primitive::map_error).
pub const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How far from the assembly's origin everything lies that is computed with, in the assembly's unit: the
/// corners of the limit are within [`LIMIT`], and a ray that comes so near starts at most `LIMIT` + 1 before
/// its point closest to the origin, or is moved there: √(4.5² + 3.5²) < 6.
pub const WORLD: f64 = 6.0;

/// The length of the corners of a box that lies within −2..=2 on every axis is at most √12.
pub const LIMIT: f64 = 3.5;

/// How far from its place our own rounding may make a point of a solid seem to a ray, where the solid's own
/// origin lies `from_origin` away from the assembly's. A ray that passes no deeper than that below a surface
/// misses it: rounding alone could have made the chord. How far the solid's map is off comes on top
/// ([`scene::Primitive::map_error`](crate::scene::Primitive::map_error)).
#[inline]
pub fn rounding_at(from_origin: f64) -> f64 {
    ROUNDING * (WORLD + from_origin)
}

/// Below so many of the least numbers in double precision the reciprocal of a direction overflows, or nearly
/// so. On its whole way through the world such a ray comes no closer to a face that it runs along.
pub(super) const STILL: f64 = 4.0;

/// One end of a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Distance along the ray, negative behind its start.
    pub t: f64,
    /// The exact distance lies within `t ± error`.
    pub error: f64,
    /// Which face of the primitive is crossed, counted from 0 by the primitive.
    pub surface: u32,
}

/// The one interval in which a ray is inside a convex primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Where the ray comes in.
    pub enter: End,
    /// Where it goes out; its `t` is the larger.
    pub leave: End,
}

/// One end of a span of one ray, or of as many as a [`Number`] has.
#[derive(Clone, Copy, Debug)]
pub struct Ends<N> {
    /// As [`End::t`].
    pub t: N,
    /// As [`End::error`].
    pub error: N,
    /// As [`End::surface`].
    pub surface: N,
}

/// The spans of one ray, or of as many as a [`Number`] has, in one convex primitive.
#[derive(Clone, Copy, Debug)]
pub struct Spans<N: Number> {
    /// Where each comes in.
    pub enter: Ends<N>,
    /// Where each goes out.
    pub leave: Ends<N>,
    /// Which have a span at all: of the others the numbers mean nothing.
    pub any: N::Mask,
    /// Which may have one: these, and in single precision also those of which
    /// double precision might say otherwise.
    pub may: N::Mask,
}

impl<N: Number> Ends<N> {
    /// Of each, the one where the answer is yes, the other where it is no.
    #[inline(always)]
    pub(super) fn choose(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self {
            t: mask.choose(yes.t, no.t),
            error: mask.choose(yes.error, no.error),
            surface: mask.choose(yes.surface, no.surface),
        }
    }

    #[inline(always)]
    fn infinite(like: N, t: f64) -> Self {
        Self { t: like.same(t), error: like.same(0.0), surface: like.same(0.0) }
    }
}

impl<N: Number> Ends<N> {
    /// Which may be one place with another: nothing is, that is infinitely far.
    #[inline(always)]
    fn may_be(&self, other: &Self) -> N::Mask {
        (self.t - other.t).magnitude().is_below(self.error + other.error)
    }
}

impl<N: Number> Spans<N> {
    /// The whole line, as often as there are numbers in `like`: the neutral element of [`Spans::clip`].
    #[inline(always)]
    pub(super) fn line(like: N) -> Self {
        Self {
            enter: Ends::infinite(like, f64::NEG_INFINITY),
            leave: Ends::infinite(like, f64::INFINITY),
            any: like.is_equal(like),
            may: like.is_equal(like),
        }
    }

    /// None at all.
    #[inline(always)]
    pub(super) fn none(like: N) -> Self {
        let line = Self::line(like);
        Self { any: !line.any, may: !line.any, ..line }
    }

    /// Cuts each span to `enter..leave`. Of two faces crossed at the same `t` the one clipped first stays;
    /// in single precision it is uncertain which of them it is.
    #[inline(always)]
    pub(super) fn clip(&mut self, enter: Ends<N>, leave: Ends<N>) {
        if !N::IS_DOUBLE {
            self.any = self.any & !(self.enter.may_be(&enter) | self.leave.may_be(&leave));
        }
        self.enter = Ends::choose(enter.t.is_above(self.enter.t), enter, self.enter);
        self.leave = Ends::choose(leave.t.is_below(self.leave.t), leave, self.leave);
    }

    /// The spans, without those of which nothing is left. Not-a-number counts as nothing, and so does a chord
    /// across an edge that rounding could have made: `rounding_share` is its share of the errors. Between
    /// faces of one `pair` every chord counts, however thin the plate.
    #[inline(always)]
    pub(super) fn if_any(mut self, rounding_share: f64, pair: impl Fn(N) -> N) -> Self {
        let length = self.leave.t - self.enter.t;
        let same_pair = pair(self.enter.surface).is_equal(pair(self.leave.surface));
        let error = self.enter.error + self.leave.error;
        let long = length.is_above(if N::IS_DOUBLE { error * rounding_share } else { error });
        self.any = self.any & length.is_above(length.same(0.0)) & (same_pair | long);
        self.may = if N::IS_DOUBLE { self.any } else { self.may & length.is_above(-error) };
        self
    }

    /// Removes the spans of rays that are not `inside`. In single precision, rays that are `near` the limit
    /// keep only `may`: double precision decides.
    #[inline(always)]
    pub(super) fn keep(&mut self, inside: N::Mask, near: impl FnOnce() -> N::Mask) {
        if N::IS_DOUBLE {
            self.any = self.any & inside;
            self.may = self.any;
        } else {
            let near = near();
            self.any = self.any & inside & !near;
            self.may = self.may & (inside | near);
        }
    }
}

impl Ends<f64> {
    /// The end of one span.
    #[inline(always)]
    pub(super) fn one(self) -> End {
        End { t: self.t, error: self.error, surface: self.surface as u32 }
    }
}

impl Spans<f64> {
    /// The span of one ray.
    #[inline(always)]
    pub(super) fn one(self) -> Option<Span> {
        self.any.then(|| Span { enter: self.enter.one(), leave: self.leave.one() })
    }
}

/// The surface that a ray starts on. The crossing there is at 0 by construction: it is never computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// The primitive that the surface belongs to.
    pub primitive: u32,
    /// The face of the primitive.
    pub surface: u32,
    /// Whether the ray goes to the inside of the primitive.
    pub inward: bool,
    /// How far the primitive, and with it the start, may be off its place:
    /// [`WorldShape::place_error`](super::WorldShape::place_error).
    pub place_error: f64,
}
