//! Directions of vectors of any length.

use crate::math::DVec3;

/// The direction of a vector of any finite length; none for 0. Scaled by a power of two first, so that no
/// square overflows.
pub fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if largest == 0.0 {
        return None;
    }
    let exponent = libm::ilogb(largest);
    let scaled = DVec3::from_array(v.to_array().map(|entry| libm::scalbn(entry, -exponent)));
    Some(scaled / scaled.dot(scaled).sqrt())
}
