//! The two directions in which a surface sends a ray on.
//!
//! `d` is the direction of the ray that arrives and `n` the normal turned to the side it comes from, both of
//! length 1 within rounding. Both answers have length 1 within rounding.

use crate::math::DVec3;
use crate::view::settled;

/// How far a ray goes at most within the world, whose size is about 1.
pub const WITHIN: f64 = 1.0;

/// The mirror direction.
#[inline]
pub fn mirrored(d: DVec3, n: DVec3) -> DVec3 {
    let across = d.dot(n).min(0.0);
    settled((d - 2.0 * across * n).normalize_or(n), WITHIN)
}

/// Snell's direction from a medium of index `before` into one of index `behind`, both above 0; `None` on
/// total internal reflection. A ray at the critical angle itself is reflected.
///
/// The part of `d` along the surface is multiplied by `before / behind`, and the part along the normal makes
/// the length 1 again. The part along the surface is computed as a vector, not as `√(1 − cos²)`, which would
/// lose half of the digits near the normal.
#[inline]
pub fn refracted(d: DVec3, n: DVec3, before: f64, behind: f64) -> Option<DVec3> {
    if before == behind {
        return Some(d);
    }
    let along = (d - d.dot(n) * n) * (before / behind);
    let sine_squared = along.length_squared();
    // Straight in, a quotient that overflows gives not-a-number.
    if sine_squared >= 1.0 || sine_squared.is_nan() {
        return None;
    }
    let onward = along - (1.0 - sine_squared).sqrt() * n;
    Some(settled(onward.normalize_or(-n), WITHIN))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn direction() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0_f64)
            .prop_map(|(x, y, z)| DVec3::new(x, y, z))
            .prop_filter("a direction", |v| v.length() > 0.01)
            .prop_map(DVec3::normalize)
    }

    proptest! {
        #[test]
        fn the_mirror_direction_has_the_same_angle_on_the_other_side(d in direction(), n in direction()) {
            let n = if d.dot(n) > 0.0 { -n } else { n };
            let mirror = mirrored(d, n);
            prop_assert!((mirror.length() - 1.0).abs() < 1e-15);
            prop_assert!((mirror.dot(n) + d.dot(n)).abs() < 1e-15);
            prop_assert!((mirror.cross(n) - d.cross(n)).length() < 1e-15);
        }

        #[test]
        fn snells_law_holds_and_the_way_back_is_the_way(
            d in direction(), n in direction(), before in 0.5..3.0, behind in 0.5..3.0,
        ) {
            let n = if d.dot(n) > 0.0 { -n } else { n };
            let sine = d.cross(n).length();
            match refracted(d, n, before, behind) {
                None => prop_assert!(before * sine >= behind * (1.0 - 1e-15)),
                Some(t) => {
                    prop_assert!((t.length() - 1.0).abs() < 1e-15);
                    prop_assert!((before * d.cross(n) - behind * t.cross(n)).length() < 1e-14);
                    prop_assert!(t.dot(n) <= 0.0);
                    // A cosine is the root of what a sine leaves of 1: it is off by an ulp over itself, on
                    // both sides of the surface. A dozen roundings stand on the way there and back.
                    let off = 12.0 * f64::EPSILON * (1.0 + 1.0 / d.dot(n).abs() + 1.0 / t.dot(n).abs());
                    if let Some(back) = refracted(-t, -n, behind, before) {
                        prop_assert!((back + d).length() < off, "{} {off}", (back + d).length());
                    }
                }
            }
        }
    }

    #[test]
    fn straight_in_is_straight_on_and_nothing_is_not_a_number() {
        let n = DVec3::Z;
        for (before, behind) in [(1.0, 1.5), (1.5, 1.0), (1e-300, 1e300), (1.0, f64::MAX)] {
            assert_eq!(refracted(-n, n, before, behind), Some(-n));
        }
        assert_eq!(refracted(-n, n, 1e300, 1e-300), None);
        // Along the surface, and as far past it as rounding goes.
        for slip in [0.0, f64::EPSILON, -f64::EPSILON] {
            let d = DVec3::new(1.0, 0.0, slip);
            assert!(mirrored(d, n).is_finite() && mirrored(d, n).dot(n) >= 0.0);
            assert!(refracted(d, n, 1.0, 1.5).is_some_and(|t| t.is_finite() && t.z < 0.0));
            assert_eq!(refracted(d, n, 1.5, 1.0), None);
        }
    }
}
