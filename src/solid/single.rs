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
    for row in 0..T::ROWS {
        // Both ends of a span are ahead, or none.
        if !T::has_any(open, row) {
            continue;
        }
        let (from, to) = (reach.from.load(simd, row), reach.to.load(simd, row));
        let (enter, leave) = (known.enter.row(simd, row), known.leave.row(simd, row));
        let mut open = T::row_of(simd, open, row) & !enter.t.is_above(to);
        let one_place = open & (leave.t - leave.error).is_at_most(enter.t + enter.error);
        if one_place.any() && !T::DECIDES {
            found.unsure |= T::bits_of(simd, one_place, row);
            open = open & !one_place;
        } else if one_place.any() {
            let off = T::all(simd, known.off);
            let exact = enter.error.is_equal(zero) | leave.error.is_equal(zero);
            open = open & !(one_place & (have_one_slope(off / enter.error, off / leave.error) | exact));
        }
        let offs = departures.map(
            #[inline(always)]
            |d| d.off.load(simd, row),
        );
        let own = PlaceError { off: known.off, rounding_share: known.rounding_share };
        let starts = [start_of(enter.error, own, offs), start_of(leave.error, own, offs)];
        if !T::DECIDES {
            let near = enter.t.magnitude().is_at_most(starts[0]) | leave.t.magnitude().is_at_most(starts[1]);
            found.unsure |= T::bits_of(simd, open & near, row);
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
        found.t.store(row, t);
        found.error.store(row, error);
        let met = T::bits_of(simd, any, row);
        found.surface.put_ids::<T, S>(simd, row, met, surface.ids());
        found.primitive.put_ids::<T, S>(simd, row, met, primitive);
        found.any |= met;
        inward |= T::bits_of(simd, goes_in, row);
    }
    found.entering = if negated { found.any & !inward } else { inward };
}
