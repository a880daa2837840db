//! What becomes of what the rays of a packet meet: a nearest hit keeps it if nothing is nearer, a shadow ray
//! only needs to know whether it lies before the light.

use fearless_simd::Simd;

use crate::math::{Lanes, Number, Real};
use crate::solid::PacketCrossings;

use super::packet_hits::{Faces, HitCandidate, PacketHits};

/// The most leaves of an expression that are evaluated at once, rather than the rays being cut into shorter
/// slices: more cost more than slices do.
pub(super) const SOME_LEAVES: usize = 6;

/// Takes what the rays of a packet meet of an object.
pub(super) trait HitSink<T: Real> {
    /// The most leaves that are evaluated at once before a packet's rays have been cut often: fewer than
    /// [`SOME_LEAVES`] where what is nearest mostly hides the others.
    const FEW_LEAVES: usize;

    /// Whether it matters if a ray goes into a solid where it crosses it, or comes out of it.
    const NEEDS_SIDES: bool = true;

    /// Takes crossings of the rays of a register with an object.
    fn offer<S: Simd>(&mut self, simd: S, register: usize, met: &HitCandidate<T, S>);

    /// Leaves these rays to the exact engine.
    fn mark_uncertain(&mut self, rays: u64);
}

impl<T: Real> HitSink<T> for PacketHits<T> {
    /// Measured on solids of OpenSCAD, as [`SOME_LEAVES`] is.
    const FEW_LEAVES: usize = 3;

    #[inline(always)]
    fn offer<S: Simd>(&mut self, simd: S, register: usize, met: &HitCandidate<T, S>) {
        Self::offer(self, simd, register, met);
    }

    fn mark_uncertain(&mut self, rays: u64) {
        self.uncertain |= rays;
    }
}

/// Crossings of some rays with an object, in the precision in which they were found.
struct Found<'a, U> {
    rays: u64,
    t: &'a Lanes<U>,
    error: &'a Lanes<U>,
    entering: u64,
    primitive: &'a Lanes<u32>,
    surface: &'a Lanes<u32>,
}

impl<U: Real> Found<'_, U> {
    /// Offers them in the precision of the sink.
    fn offer_to<S: Simd, T: Real>(&self, simd: S, object: u32, sink: &mut impl HitSink<T>) {
        simd.vectorize(
            #[inline(always)]
            || {
                for register in 0..T::REGISTERS {
                    if !T::has_any(self.rays, register) {
                        continue;
                    }
                    let t = self.t.load_nearest::<T, S>(simd, register);
                    let met = HitCandidate {
                        any: T::mask_of(simd, self.rays, register) & t.is_below(T::all(simd, f64::INFINITY)),
                        t,
                        error: loosened::<T, S>(self.error.load_nearest::<T, S>(simd, register), t),
                        entering: T::mask_of(simd, self.entering, register),
                        object,
                        primitive: self.primitive.ids::<T, S>(simd, register),
                        surface: Faces::Ids(self.surface.ids::<T, S>(simd, register)),
                    };
                    sink.offer(simd, register, &met);
                }
            },
        );
    }
}

/// Offers what some rays met first of one object.
pub(super) fn offer_hits<S: Simd, T: Real, U: Real>(
    simd: S,
    hits: &PacketHits<U>,
    rays: u64,
    object: u32,
    sink: &mut impl HitSink<T>,
) {
    let PacketHits { t, error, entering, primitive, surface, .. } = hits;
    Found { rays, t, error, entering: *entering, primitive, surface }.offer_to(simd, object, sink);
}

/// Offers what a packet's rays cross first of one object.
pub(super) fn offer_crossings<S: Simd, T: Real, U: Real>(
    simd: S,
    found: &PacketCrossings<U>,
    object: u32,
    sink: &mut impl HitSink<T>,
) {
    if found.any != 0 {
        let PacketCrossings { any, t, error, entering, primitive, surface, .. } = found;
        Found { rays: *any, t, error, entering: *entering, primitive, surface }.offer_to(simd, object, sink);
    }
}

/// How far a distance may be off that was rounded to single precision: by half an ulp more.
#[inline(always)]
fn loosened<T: Real, S: Simd>(error: T::SimdReal<S>, t: T::SimdReal<S>) -> T::SimdReal<S> {
    if T::IS_DOUBLE { error } else { error + t.magnitude() * (0.5 * f64::EPSILON * T::EPSILON_RATIO) }
}
