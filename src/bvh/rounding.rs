//! Coordinates of boxes rounded outward to single precision.

/// How far the sides of boxes are moved outward, so that single precision is enough to test whether a ray
/// meets them.
///
/// A ray starts within `solid::WORLD`, 6, of the origin and a box ends within 2.01 of it on
/// each axis, what may be `slack` with it. Rounding to 24 bits moves the start by at most 2⁻²², and the
/// difference, which is below 16, by 2⁻²¹. The inverse of the direction and the product are off by a share of
/// 2⁻²⁴ each, which is as if the side stood elsewhere by 2 · 2⁻²⁴ of at most 8.01. In all that is less than 8
/// · 2⁻²².
pub const MARGIN: f64 = 1.0 / 524_288.0;

/// The largest number of single precision that is not above `x`.
#[inline(always)]
pub fn lower(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The smallest number of single precision that is not below `x`.
#[inline(always)]
pub fn upper(x: f64) -> f32 {
    -lower(-x)
}
