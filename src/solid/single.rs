//! Stage 8, CSG, for a packet of rays and an expression of which one primitive is left: [`super::crossings`]
//! where there is nothing to toggle but that.

use fearless_simd::Simd;

use crate::math::{Mask, Number, Real, RealIds, SimdIds, SimdReal};

use super::crossing::{PlaceError, have_one_slope, start_of};
use super::csg_query::{CsgQuery, PacketCrossings};
use super::span::Ends;
use super::span_cache::CachedSpans;

/// The first crossings of the rays that are `open` with their spans in one primitive, which may be `negated`.
#[inline(always)]
pub(super) fn decide_single<S: Simd, T: Real>(
    simd: S,
    asked: &CsgQuery<T>,
    open: u64,
    known: &CachedSpans<T>,
    primitive: u32,
    negated: bool,
    found: &mut PacketCrossings<T>,
) {
    let CsgQuery { departures, reach, .. } = *asked;
    let (infinite, zero) = (T::all(simd, f64::INFINITY), T::all(simd, 0.0));
    let primitive = RealIds::<T, S>::all(simd, primitive);
    let mut inward = 0;
    for register in 0..T::REGISTERS {
        // Both ends of a span are ahead, or none.
        if !T::has_any(open, register) {
            continue;
        }
        let (from, to) = (reach.from.load(simd, register), reach.to.load(simd, register));
        let (enter, leave) = (known.enter.load(simd, register), known.leave.load(simd, register));
        let mut open = T::mask_of(simd, open, register) & !enter.t.is_above(to);
        let one_place = open & (leave.t - leave.error).is_at_most(enter.t + enter.error);
        if one_place.any() && !T::IS_DOUBLE {
            found.uncertain |= T::bits_of(simd, one_place, register);
            open = open & !one_place;
        } else if one_place.any() {
            let place_error = T::all(simd, known.place_error);
            let exact = enter.error.is_equal(zero) | leave.error.is_equal(zero);
            open = open
                & !(one_place
                    & (have_one_slope(place_error / enter.error, place_error / leave.error) | exact));
        }
        let errors = departures.map(
            #[inline(always)]
            |d| d.place_error.load(simd, register),
        );
        let own = PlaceError { bound: known.place_error, rounding_share: known.rounding_share };
        let starts = [start_of(enter.error, own, errors), start_of(leave.error, own, errors)];
        if !T::IS_DOUBLE {
            let near = enter.t.magnitude().is_at_most(starts[0]) | leave.t.magnitude().is_at_most(starts[1]);
            found.uncertain |= T::bits_of(simd, open & near, register);
            open = open & !near;
        }
        let goes_in = open & !(enter.t.is_at_most(starts[0]) | enter.t.is_below(from));
        let passed = leave.t.is_at_most(starts[1]) | leave.t.is_below(from);
        let ended = leave.t.is_above(to) | leave.t.is_equal(infinite);
        let any = goes_in | (open & !(passed | ended));
        if !any.any() {
            continue;
        }
        let Ends { t, error, surface } = Ends::choose(goes_in, enter, leave);
        found.t.store(register, t);
        found.error.store(register, error);
        let met = T::bits_of(simd, any, register);
        found.surface.put_ids::<T, S>(simd, register, met, surface.ids());
        found.primitive.put_ids::<T, S>(simd, register, met, primitive);
        found.any |= met;
        inward |= T::bits_of(simd, goes_in, register);
    }
    found.entering = if negated { found.any & !inward } else { inward };
}
