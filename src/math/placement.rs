//! The inverse of an affine map, at any scale.

use robust::{Coord3D, orient3d};

use super::exact::rest_of_dot;
use super::{DAffine3, DMat3, DVec3};

/// Where a unit shape stands: `world = linear · unit + center`, and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// From unit directions to world directions.
    pub linear: DMat3,
    /// From world directions to unit directions: the inverse of `linear`.
    pub inverse: DMat3,
    /// The world place of the unit origin.
    pub center: DVec3,
}

impl Placement {
    /// The placement of a map; `None` where the map is singular or not finite.
    ///
    /// Rows and columns are brought to magnitudes near 1 by powers of two before the inversion and back after
    /// it: both are exact, so no scale overflows.
    pub fn new(map: &DAffine3) -> Option<Self> {
        let linear = map.matrix3;
        if !map.is_finite() {
            return None;
        }
        let columns = power_of_two_near(column_sizes(&linear))?;
        let scaled = linear * DMat3::from_diagonal(columns.recip());
        let rows = power_of_two_near(column_sizes(&scaled.transpose()))?;
        let even = DMat3::from_diagonal(rows.recip()) * scaled;
        let is_sturdy = even.determinant().abs() >= STURDY;
        // Rounding can not make so large a determinant out of 0.
        if !is_sturdy && is_singular(&linear) {
            return None;
        }
        let even_inverse = if is_sturdy { even.inverse() } else { refined_inverse(&even) };
        let inverse =
            DMat3::from_diagonal(columns.recip()) * even_inverse * DMat3::from_diagonal(rows.recip());
        inverse.is_finite().then_some(Self { linear, inverse, center: map.translation })
    }
}

/// The determinant of a matrix whose rows and columns have magnitudes near 1 above which its inverse by
/// cofactors is good enough.
const STURDY: f64 = 0.5;

/// The inverse of a matrix whose rows and columns have magnitudes near 1, off by at most 8 roundings of its
/// entries.
///
/// By cofactors it is off by about 3 roundings over the determinant, which is small where a map shears
/// strongly. Then it is refined by what is left of the unit matrix, X ← X + X·(1 − A·X), the rest computed as
/// if in twice the precision (Wilkinson: Rounding Errors in Algebraic Processes, 1963; the sums after Ogita,
/// Rump, Oishi: Accurate sum and dot product, SIAM J. Sci. Comput. 26, 2005).
fn refined_inverse(even: &DMat3) -> DMat3 {
    /// Each step squares what is left: from just below 1 it is rounding after so many.
    const STEPS: usize = 10;
    let mut inverse = even.inverse();
    let mut left = 1.0;
    for _ in 0..STEPS {
        let rest = DMat3::from_cols_array(&std::array::from_fn(|i| {
            let (row, column) = (i % 3, i / 3);
            rest_of_dot(even.row(row), inverse.col(column), if row == column { 1.0 } else { 0.0 })
        }));
        let now = rest.to_cols_array().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // What no longer shrinks is rounding; a matrix too near to a singular one stays as it is.
        if now.is_nan() || now >= left {
            break;
        }
        left = now;
        inverse += inverse * rest;
    }
    inverse
}

/// Whether the determinant is 0, decided exactly.
///
/// Columns and then rows are scaled by powers of two until their largest entries are in `1..2`: that neither
/// rounds nor changes the sign, and keeps every product far from overflow. Shewchuk's adaptive predicate then
/// gives the sign of the determinant without rounding.
pub fn is_singular(matrix: &DMat3) -> bool {
    let mut matrix = *matrix;
    for _ in 0..2 {
        for axis in 0..3 {
            let largest = matrix.col(axis).abs().max_element();
            if largest == 0.0 {
                return true;
            }
            let exponent = libm::ilogb(largest);
            let scaled = matrix.col(axis).to_array().map(|entry| libm::scalbn(entry, -exponent));
            *matrix.col_mut(axis) = DVec3::from_array(scaled);
        }
        matrix = matrix.transpose();
    }
    let [a, b, c] = [0, 1, 2].map(|axis| {
        let DVec3 { x, y, z } = matrix.col(axis);
        Coord3D { x, y, z }
    });
    orient3d(a, b, c, Coord3D { x: 0.0, y: 0.0, z: 0.0 }) == 0.0
}

fn column_sizes(m: &DMat3) -> DVec3 {
    DVec3::new(m.x_axis.abs().max_element(), m.y_axis.abs().max_element(), m.z_axis.abs().max_element())
}

/// For each size the power of two `s` with `1 ≤ size / s < 2`; `None` where a size is 0 or not finite.
#[inline]
fn power_of_two_near(sizes: DVec3) -> Option<DVec3> {
    /// Of a normal number these bits alone are the power of two.
    const EXPONENT: u64 = f64::INFINITY.to_bits();
    let exponent = |size: f64| {
        if size.is_normal() {
            f64::from_bits(size.to_bits() & EXPONENT)
        } else {
            libm::ldexp(1.0, libm::ilogb(size))
        }
    };
    let usable = sizes.is_finite() && sizes.cmpgt(DVec3::ZERO).all();
    usable
        .then(|| DVec3::new(exponent(sizes.x), exponent(sizes.y), exponent(sizes.z)))
        .filter(|s| s.recip().is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverts_at_every_scale() {
        for exponent in [-300, -150, 0, 150, 300] {
            let s = libm::pow(10.0, f64::from(exponent));
            let map = DAffine3::from_scale(DVec3::new(s, 2.0 * s, 3.0 * s));
            let placement = Placement::new(&map).unwrap();
            let unit = placement.inverse * (placement.linear * DVec3::new(1.0, -2.0, 0.5));
            assert!((unit - DVec3::new(1.0, -2.0, 0.5)).length() < 1e-15, "{exponent}: {unit}");
        }
    }

    #[test]
    fn inverts_strong_shears_to_the_last_bits() {
        // Two turns with a scale of 1e5 between them: by cofactors alone a product with the inverse was off
        // by 7e-4, a thousand times what its own rounding allows.
        let turn = |angle: f64| DMat3::from_axis_angle(DVec3::new(2.0, -3.0, 6.0) / 7.0, angle);
        let map = turn(1.0) * DMat3::from_diagonal(DVec3::new(1e-5, 1.0, 1e5)) * turn(2.0);
        let inverse = Placement::new(&DAffine3::from_mat3(map)).unwrap().inverse;
        for row in 0..3 {
            for column in 0..3 {
                let whole = if row == column { 1.0 } else { 0.0 };
                let rest = rest_of_dot(inverse.row(row), map.col(column), whole);
                let size = inverse.row(row).abs().dot(map.col(column).abs());
                assert!(rest.abs() <= 4.0 * f64::EPSILON * size, "{row} {column}: {rest:e} of {size:e}");
            }
        }
    }

    #[test]
    fn inverts_needles() {
        let map = DAffine3::from_scale(DVec3::new(1e-150, 1.0, 1e150));
        let placement = Placement::new(&map).unwrap();
        assert!((placement.inverse * DVec3::new(1e-150, 1.0, 1e150) - DVec3::ONE).length() < 1e-15);
    }

    #[test]
    fn refuses_dependent_columns_at_every_scale() {
        for s in [1e-150, 1.0, 1e150] {
            let flat =
                DMat3::from_cols(DVec3::X * s, DVec3::new(0.3, 0.7, 0.0) * s, DVec3::new(0.1, 0.9, 0.0) * s);
            assert!(Placement::new(&DAffine3::from_mat3(flat)).is_none());
        }
    }

    #[test]
    fn singular_means_exactly_so() {
        let flat = DMat3::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert!(is_singular(&flat));
        assert!(is_singular(&(flat * libm::scalbn(1.0, -500))));
        let nearly = DMat3::from_cols_array(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0 + 2e-15]);
        assert!(!is_singular(&nearly));
        for scale in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
            assert!(!is_singular(&DMat3::from_diagonal(DVec3::new(scale, 1.0, scale))), "{scale}");
        }
        assert!(is_singular(&DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0))));
    }
}
