//! What the rays of a packet ask of an expression, and what they are answered.

use fearless_simd::Simd;

use crate::math::{Lanes, RayPacket, Real};

use super::crossing::{Crossing, TRange};
use super::span::Departure;

/// What is asked of an expression.
#[derive(Clone, Copy, Debug)]
pub struct CsgQuery<'a, T> {
    /// The rays.
    pub packet: &'a RayPacket<T>,
    /// Which of them ask, a bit for each.
    pub wanted: u64,
    /// The surfaces that they leave; none for rays from the eye.
    pub departures: Option<&'a Departures<T>>,
    /// The part of each.
    pub reach: &'a PacketRange<T>,
    /// By leaf of the expression: which of them may be in it within their parts, as far as that is known;
    /// all where there is nothing.
    pub near: &'a [u64],
}

/// The part of each ray of a packet that is asked for, as [`TRange`].
#[derive(Clone, Debug)]
pub struct PacketRange<T> {
    /// Crossings before this are passed over.
    pub from: Lanes<T>,
    /// Crossings behind this are not looked for.
    pub to: Lanes<T>,
}

impl<T: Real> PacketRange<T> {
    /// Nothing of any ray.
    pub const NONE: Self = Self { from: Lanes::filled(T::INFINITY), to: Lanes::filled(T::ZERO) };

    /// The same part of all rays.
    #[inline(always)]
    pub fn fill(&mut self, TRange { from, to }: TRange) {
        (self.from, self.to) = (Lanes::filled(T::nearest(from)), Lanes::filled(T::nearest(to)));
    }
}

/// The surfaces that the rays of a packet start on: [`super::Departure`] of each.
#[derive(Clone, Debug)]
pub struct Departures<T = f64> {
    /// The index of the primitive; [`Departures::NOWHERE`] where the ray leaves none.
    pub primitive: Lanes<u32>,
    /// The face of the primitive.
    pub surface: Lanes<u32>,
    /// Which rays go to the inside of it, a bit for each.
    pub inward: u64,
    /// How far it may be off its place.
    pub place_error: Lanes<T>,
}

impl Departures {
    /// No index of a primitive: there are fewer.
    pub const NOWHERE: u32 = u32::MAX;

    /// No ray leaves a surface.
    pub const NONE: Self = Self {
        primitive: Lanes::filled(Self::NOWHERE),
        surface: Lanes::filled(0),
        inward: 0,
        place_error: Lanes::filled(0.0),
    };

    /// Sets the surface that one ray starts on, and whether it goes inward.
    pub fn set(&mut self, lane: usize, departure: &Departure) {
        self.primitive.0[lane] = departure.primitive;
        self.surface.0[lane] = departure.surface;
        self.place_error.0[lane] = departure.place_error;
        self.inward = self.inward & !(1 << lane) | u64::from(departure.inward) << lane;
    }

    /// The surface that one ray starts on.
    pub fn get(&self, lane: usize) -> Departure {
        Departure {
            primitive: self.primitive.0[lane],
            surface: self.surface.0[lane],
            inward: self.inward >> lane & 1 == 1,
            place_error: self.place_error.0[lane],
        }
    }
}

impl<T: Real> Departures<T> {
    /// Which rays start on a primitive, and which of these go to its inside.
    pub fn here<S: Simd>(&self, simd: S, primitive: u32) -> (u64, u64) {
        let here = simd.vectorize(
            #[inline(always)]
            || self.primitive.rays_of(simd, primitive),
        );
        (here, here & self.inward)
    }

    /// Which rays leave a primitive to the outside: where that is convex, or a surface, they do not meet it
    /// again.
    #[inline]
    pub fn leaving<S: Simd>(&self, simd: S, primitive: u32) -> u64 {
        let (here, inward) = self.here(simd, primitive);
        here & !inward
    }
}

/// The first crossings of a packet.
#[derive(Clone, Debug)]
pub struct PacketCrossings<T = f64> {
    /// Which rays have one, a bit for each: of the others the numbers mean nothing.
    pub any: u64,
    /// Which rays are to be asked one by one: theirs is a place where no primitive alone makes the change; or
    /// by double precision.
    pub uncertain: u64,
    /// Which rays go into the solid there.
    pub entering: u64,
    /// Where, and how far that may be off.
    pub t: Lanes<T>,
    /// How far `t` may be off.
    pub error: Lanes<T>,
    /// The primitive whose surface it is, by its index.
    pub primitive: Lanes<u32>,
    /// The face of that primitive.
    pub surface: Lanes<u32>,
}

impl<T: Real> PacketCrossings<T> {
    /// None.
    pub const NONE: Self = Self {
        any: 0,
        uncertain: 0,
        entering: 0,
        t: Lanes::filled(T::INFINITY),
        error: Lanes::filled(T::ZERO),
        primitive: Lanes::filled(0),
        surface: Lanes::filled(0),
    };
}

impl PacketCrossings {
    /// Sets the crossing of one ray.
    pub fn set(&mut self, lane: usize, crossing: &Crossing) {
        self.any |= 1 << lane;
        self.entering |= u64::from(crossing.entering) << lane;
        self.t.0[lane] = crossing.t;
        self.error.0[lane] = crossing.error;
        self.primitive.0[lane] = crossing.primitive;
        self.surface.0[lane] = crossing.surface;
    }
}
