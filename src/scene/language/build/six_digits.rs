//! What is known of a number that was printed with six significant digits, as OpenSCAD prints all that it
//! writes.

use crate::math::{DAffine3, DMat3, DVec3};

/// How far a number may be from the one that was printed: half a unit of its sixth digit. Nothing where it
/// has more digits, which nobody printed with six, and of 0, which is printed of 0 alone.
pub fn half_unit(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return 0.0;
    }
    let six = format!("{x:.5e}");
    let exponent = six.rsplit_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        // In digits, so that no power is computed.
        Some(exponent) if six.parse() == Ok(x) => format!("5e{}", exponent - 6).parse().unwrap_or(0.0),
        _ => 0.0,
    }
}

/// How far each number of a map may be from the one that was printed.
pub fn half_units(map: &DAffine3) -> DAffine3 {
    let m = map.matrix3.to_cols_array_2d();
    let of = |column: usize, row: usize| {
        // What leaves an axis alone, or turns it over, is meant to: a turn whose cosine is 1 in six digits
        // has a sine in them. A scale by less than that is lost.
        let is_alone = (0..3).all(|k| (k == column || m[k][row] == 0.0) && (k == row || m[column][k] == 0.0));
        if is_alone && m[column][row].abs() == 1.0 { 0.0 } else { half_unit(m[column][row]) }
    };
    let column = |k: usize| DVec3::new(of(k, 0), of(k, 1), of(k, 2));
    let translation = DVec3::from_array(map.translation.to_array().map(half_unit));
    DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_unit_of_the_sixth_digit() {
        for (x, half) in [
            (1.33333, 5e-6),
            (0.666_667, 5e-7),
            (-20.0, 5e-5),
            (100.001, 5e-4),
            (1e-7, 5e-13),
            (1.5e6, 5.0),
            (0.0, 0.0),
            // Seven digits.
            (1.333_333, 0.0),
            (1.0 / 3.0, 0.0),
        ] {
            assert_eq!(half_unit(x), half, "{x}");
        }
    }

    #[test]
    fn what_a_map_leaves_alone_is_exact() {
        let turned = DMat3::from_cols(
            DVec3::new(0.866_025, 0.5, 0.0),
            DVec3::new(-0.5, 0.866_025, 0.0),
            DVec3::new(0.0, 0.0, 1.0),
        );
        let map = DAffine3 { matrix3: turned, translation: DVec3::new(0.0, 0.0, 1.33333) };
        let known = half_units(&map);
        assert_eq!(known.matrix3.z_axis, DVec3::ZERO);
        assert_eq!(known.matrix3.x_axis, DVec3::new(5e-7, 5e-7, 0.0));
        assert_eq!(known.translation, DVec3::new(0.0, 0.0, 5e-6));
    }
}
