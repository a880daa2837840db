//! Outlines of polygons: what repeats in them, and whether they have an area.

use crate::math::DVec3;

/// Leaves out each point that is the one before it, the last being before the first.
pub fn drop_repeated<T>(corners: &mut Vec<T>, place: impl Fn(&T) -> DVec3) {
    corners.dedup_by(|next, kept| place(next) == place(kept));
    while corners.len() > 1 && corners.first().map(&place) == corners.last().map(&place) {
        corners.pop();
    }
}

/// Whether an outline has an area that is more than the rounding of its corners.
pub fn has_area(corners: impl Iterator<Item = DVec3> + Clone) -> bool {
    let size = corners.clone().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    // Scaled by a power of two: exact, and no product overflows.
    let scale = libm::ldexp(1.0, -libm::ilogb(size).clamp(-1000, 1000));
    let mut points = corners.map(|p| p * scale);
    let Some(first) = points.next() else { return false };
    let (mut sum, mut off) = (DVec3::ZERO, 0.0);
    let mut a = DVec3::ZERO;
    for p in points {
        let b = p - first;
        sum += a.cross(b);
        // Each corner, of coordinates up to 2, was rounded when it was read; three of them make a triangle.
        off += 4.0 * f64::EPSILON * (a.length() + b.length());
        a = b;
    }
    sum.length() > off
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 3]]) -> Vec<DVec3> {
        list.iter().map(|&p| DVec3::from_array(p)).collect()
    }

    #[test]
    fn repeated_corners_go_round_the_end() {
        let mut corners = points(&[[0.0; 3], [0.0; 3], [1.0; 3], [2.0; 3], [2.0; 3], [0.0; 3], [0.0; 3]]);
        drop_repeated(&mut corners, |&p| p);
        assert_eq!(corners, points(&[[0.0; 3], [1.0; 3], [2.0; 3]]));
    }

    #[test]
    fn points_of_a_line_have_no_area_at_any_size() {
        let line = points(&[[0.1, 0.1, 0.1], [0.3, 0.3, 0.3], [0.7, 0.7, 0.7]]);
        let thin = points(&[[0.1, 0.1, 0.1], [0.3, 0.3, 0.3], [0.7, 0.7, 0.700_000_1]]);
        for size in [1e-300, 1e-9, 1.0, 1e9, 1e307] {
            assert!(!has_area(line.iter().map(|&p| p * size)), "{size}");
            assert!(has_area(thin.iter().map(|&p| p * size)), "{size}");
        }
        assert!(!has_area(points(&[[0.0; 3], [0.0; 3], [0.0; 3]]).into_iter()));
    }
}
