//! What the rays of a packet ask of an expression, and what they are answered.

use fearless_simd::Simd;

use crate::math::{Lanes, Number, RayPacket, Real};

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
    pub reach: TRange,
}

/// The surfaces that the rays of a packet start on: [`super::Departure`] of each.
#[derive(Clone, Debug)]
pub struct Departures<T = f64> {
    /// The index of the primitive.
    pub primitive: Lanes<T>,
    /// Which rays go to the inside of it, a bit for each.
    pub inward: u64,
    /// How far it may be off its place.
    pub off: Lanes<T>,
}

impl Departures {
    /// From nowhere.
    pub const NONE: Self = Self { primitive: Lanes::filled(-1.0), inward: 0, off: Lanes::filled(0.0) };

    /// Sets the surface that one ray starts on; it goes to the outside unless it did to the inside before.
    pub fn set(&mut self, lane: usize, departure: &Departure) {
        self.primitive.0[lane] = f64::from(departure.primitive);
        self.off.0[lane] = departure.off;
        self.inward = self.inward & !(1 << lane) | u64::from(departure.inward) << lane;
    }

    /// The surface that one ray starts on; of a primitive whose surfaces need no telling apart.
    pub fn get(&self, lane: usize) -> Departure {
        Departure {
            primitive: self.primitive.0[lane] as u32,
            surface: 0,
            inward: self.inward >> lane & 1 == 1,
            off: self.off.0[lane],
        }
    }
}

impl<T: Real> Departures<T> {
    /// Which rays start on a primitive, and which of these go to its inside.
    pub fn here<S: Simd>(&self, simd: S, primitive: u32) -> (u64, u64) {
        let here = simd.vectorize(
            #[inline(always)]
            || {
                let index = T::all(simd, f64::from(primitive));
                let mut here = 0;
                for row in 0..T::ROWS {
                    here |= T::bits_of(simd, self.primitive.load(simd, row).is_equal(index), row);
                }
                here
            },
        );
        (here, here & self.inward)
    }

    /// Which rays leave a primitive to the outside: where that is convex, or a surface, they do not meet it again.
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
    /// Which rays are to be asked one by one: theirs is a place where no primitive alone makes the change; or by double precision.
    pub unsure: u64,
    /// Which rays go into the solid there.
    pub entering: u64,
    /// Where, and how far that may be off.
    pub t: Lanes<T>,
    /// How far `t` may be off.
    pub error: Lanes<T>,
    /// The primitive whose surface it is, by its index.
    pub primitive: Lanes<T>,
    /// The face of that primitive.
    pub surface: Lanes<T>,
}

impl<T: Real> PacketCrossings<T> {
    /// None.
    pub const NONE: Self = Self {
        any: 0,
        unsure: 0,
        entering: 0,
        t: Lanes::filled(T::INFINITY),
        error: Lanes::filled(T::ZERO),
        primitive: Lanes::filled(T::ZERO),
        surface: Lanes::filled(T::ZERO),
    };
}

impl PacketCrossings {
    /// Sets the crossing of one ray.
    pub fn set(&mut self, lane: usize, crossing: &Crossing) {
        self.any |= 1 << lane;
        self.entering |= u64::from(crossing.entering) << lane;
        self.t.0[lane] = crossing.t;
        self.error.0[lane] = crossing.error;
        self.primitive.0[lane] = f64::from(crossing.primitive);
        self.surface.0[lane] = f64::from(crossing.surface);
    }
}
