//! Stage 8, CSG, for a bundle of rays and an expression of which one primitive is left: [`super::crossings`] where
//! there is nothing to toggle but that.

use fearless_simd::{Simd, SimdBase, SimdMask, f64x8};

use crate::math::{LANES, Mask, Number, ROWS, row_of};

use super::crossing::start_of;
use super::crossings::{Asked, Found, have_one_slope};
use super::known::KnownSpans;
use super::span::Ends;

/// The first crossings with the spans in one primitive, which may be `negated`, among those that are ahead.
#[inline(always)]
pub(super) fn decide_alone<S: Simd>(
    simd: S,
    asked: &Asked,
    known: &KnownSpans,
    (primitive, negated): (u32, bool),
    found: &mut Found,
) {
    let Asked { departures, reach, .. } = *asked;
    let (infinite, zero) = (f64x8::splat(simd, f64::INFINITY), f64x8::splat(simd, 0.0));
    let (from, to) = (f64x8::splat(simd, reach.from), f64x8::splat(simd, reach.to));
    let primitive = f64x8::splat(simd, f64::from(primitive));
    let mut inward = 0;
    for row in 0..ROWS {
        // Both ends of a span are ahead, or none.
        if (known.enter.ahead >> (row * LANES)) as u8 == 0 {
            continue;
        }
        let (enter, leave) = (known.enter.row(simd, row), known.leave.row(simd, row));
        let mut open = row_of(simd, known.enter.ahead, row) & !enter.t.is_above(to);
        let one_place = open & (leave.t - leave.error).is_at_most(enter.t + enter.error);
        if one_place.any_true() {
            let off = f64x8::splat(simd, known.off);
            let exact = enter.error.is_equal(zero) | leave.error.is_equal(zero);
            open &= !(one_place & (have_one_slope(off / enter.error, off / leave.error) | exact));
        }
        let offs = departures.map(
            #[inline(always)]
            |d| d.off.load(simd, row),
        );
        let own = (known.off, known.seeming);
        let goes_in = open & !(enter.t.is_at_most(start_of(enter.error, own, offs)) | enter.t.is_below(from));
        let passed = leave.t.is_at_most(start_of(leave.error, own, offs)) | leave.t.is_below(from);
        let ended = leave.t.is_above(to) | leave.t.is_equal(infinite);
        let any = goes_in | (open & !(passed | ended));
        if !any.any_true() {
            continue;
        }
        let Ends { t, error, surface } = Ends::choose(goes_in, enter, leave);
        found.t.store(row, t);
        found.error.store(row, error);
        found.surface.store(row, surface);
        found.primitive.store(row, primitive);
        found.any |= u64::from(any.bits()) << (row * LANES);
        inward |= u64::from(goes_in.bits()) << (row * LANES);
    }
    found.entering = if negated { found.any & !inward } else { inward };
}
