//! Where a ray is inside a solid.

/// How far a coordinate of a crossing may be off, as a share of the lengths it was computed from.
///
/// The longest chain of roundings between a ray and a crossing: the ray's start, which was itself computed as a point
/// on a ray (a product and a sum, 2 roundings, of lengths up to twice [`WORLD`]: 4), inverting a map (8), moving the
/// ray into the unit space (a difference and a dot product of three terms, 4, for the start and again for the
/// direction), and re-centring it twice (4 each): 28, rounded up to 32 half-ulps of `f64::EPSILON / 2`. What composing
/// the map took is [`scene::Primitive::displacement`](crate::scene::Primitive::displacement).
pub const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How far from the assembly's origin everything lies that is computed with, in the assembly's unit: the corners of the
/// limit are within [`LIMIT`], and a ray that comes so near starts at most `LIMIT` + 1 before its point closest to the
/// origin, or is moved there: √(4.5² + 3.5²) < 6.
pub const WORLD: f64 = 6.0;

/// The length of the corners of a box that lies within −2..=2 on every axis is at most √12.
pub const LIMIT: f64 = 3.5;

/// How far from its place our own rounding may make a point of a solid seem to a ray, where the solid's own origin lies
/// `from_origin` away from the assembly's. A ray that passes no deeper than that below a surface misses it: rounding
/// alone could have made the chord. How far the solid's map is off comes on top
/// ([`scene::Primitive::displacement`](crate::scene::Primitive::displacement)).
pub fn rounding_at(from_origin: f64) -> f64 {
    ROUNDING * (WORLD + from_origin)
}

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

impl Span {
    /// The whole line: the neutral element of [`Span::clip`].
    pub(super) const LINE: Self = Self {
        enter: End { t: f64::NEG_INFINITY, error: 0.0, surface: 0 },
        leave: End { t: f64::INFINITY, error: 0.0, surface: 0 },
    };

    /// Cuts the span to `enter..leave`. Of two faces crossed at the same `t` the one clipped first stays.
    pub(super) fn clip(&mut self, enter: End, leave: End) {
        if enter.t > self.enter.t {
            self.enter = enter;
        }
        if leave.t < self.leave.t {
            self.leave = leave;
        }
    }

    /// The span, unless nothing is left of it. Not-a-number counts as nothing, and so does a chord across an edge that
    /// rounding could have made: `seeming` is its share of the errors. Between faces of one `pair` every chord counts,
    /// however thin the plate.
    pub(super) fn if_any(self, seeming: f64, pair: impl Fn(u32) -> u32) -> Option<Self> {
        let length = self.leave.t - self.enter.t;
        let any = length > 0.0
            && (pair(self.enter.surface) == pair(self.leave.surface)
                || length > seeming * (self.enter.error + self.leave.error));
        any.then_some(self)
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
    /// How far the primitive, and with it the start, may be off its place: [`Form::off`](super::Form::off).
    pub off: f64,
}
