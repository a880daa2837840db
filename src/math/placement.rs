//! The inverse of an affine map, at any scale.

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
    /// it: both are exact, so no scale overflows and a singular map is one whose columns really are dependent
    /// within rounding, however small it is.
    pub fn new(map: &DAffine3) -> Option<Self> {
        let linear = map.matrix3;
        let columns = power_of_two_near(column_sizes(&linear))?;
        let scaled = linear * DMat3::from_diagonal(columns.recip());
        let rows = power_of_two_near(column_sizes(&scaled.transpose()))?;
        let even = DMat3::from_diagonal(rows.recip()) * scaled;
        // The determinant of a matrix whose entries are at most 2 is a sum of six products: rounding leaves up
        // to 6 · 8 · 3 ulps of 1 where the exact value is 0.
        let determinant = even.determinant();
        if determinant.is_nan() || determinant.abs() <= 144.0 * f64::EPSILON {
            return None;
        }
        let inverse =
            DMat3::from_diagonal(columns.recip()) * even.inverse() * DMat3::from_diagonal(rows.recip());
        (inverse.is_finite() && map.translation.is_finite()).then_some(Self {
            linear,
            inverse,
            center: map.translation,
        })
    }
}

fn column_sizes(m: &DMat3) -> DVec3 {
    DVec3::new(m.x_axis.abs().max_element(), m.y_axis.abs().max_element(), m.z_axis.abs().max_element())
}

/// For each size the power of two `s` with `1 ≤ size / s < 2`; `None` where a size is 0 or not finite.
fn power_of_two_near(sizes: DVec3) -> Option<DVec3> {
    let exponent = |size: f64| libm::ldexp(1.0, libm::ilogb(size));
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
            let twice = DMat3::from_cols(DVec3::splat(0.1 * s), DVec3::splat(0.3 * s), DVec3::Z * s);
            assert!(Placement::new(&DAffine3::from_mat3(twice)).is_none());
        }
    }
}
