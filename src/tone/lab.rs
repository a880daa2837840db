//! CIE 1976 L*a*b*: colours at distances that the eye sees, with the lightness of the 13 levels as its first
//! axis.

use super::lightness::{light_of_lightness, lightnesses};
use crate::math::{DMat3, DVec3};

/// Linear sRGB (IEC 61966-2-1) to CIE XYZ, each row divided by its sum, which is white's: so white is exactly
/// 1, 1, 1.
const XYZ: DMat3 = DMat3::from_cols_array(&[
    0.433_876_906_891_108_9,
    0.2126,
    0.017_722_681_359_045,
    0.376_223_040_504_997_4,
    0.7152,
    0.109_458_218_549_127_64,
    0.189_900_052_603_892_7,
    0.0722,
    0.872_819_100_091_827_4,
]);

/// Its inverse.
const RGB: DMat3 = DMat3::from_cols_array(&[
    3.080_214_516_192_710_6,
    -0.920_968_644_350_218,
    0.052_952_469_483_457_84,
    -1.537_207_972_210_318_7,
    1.875_756_060_885_241,
    -0.204_021_050_598_486_7,
    -0.543_006_543_982_391_9,
    0.045_212_583_464_976_84,
    1.151_068_581_115_028_7,
]);

/// L*, a* and b* of three linear primaries, 0 to 1.
#[inline]
pub fn lab_of_color(color: DVec3) -> [f64; 3] {
    labs_of_colors([color]).map(|axis| axis[0])
}

/// [`lab_of_color`] of several at once, axis by axis: all L*, all a*, all b*.
pub fn labs_of_colors<const N: usize>(colors: [DVec3; N]) -> [[f64; N]; 3] {
    let mut shares = [[0.0; N]; 3];
    for (k, color) in colors.into_iter().enumerate() {
        let share = XYZ * color;
        for axis in 0..3 {
            shares[axis][k] = share[axis];
        }
    }
    // The cube roots of the definition, each written as the lightness of its share.
    let [x, y, z] = shares.map(lightnesses);
    let weighed = |weight: f64, a: &[f64; N], b: &[f64; N]| std::array::from_fn(|k| weight * (a[k] - b[k]));
    [y, weighed(500.0 / 116.0, &x, &y), weighed(200.0 / 116.0, &y, &z)]
}

/// The three linear primaries of L*, a* and b*, clamped to 0 to 1.
#[inline]
pub fn color_of_lab([l, a, b]: [f64; 3]) -> DVec3 {
    let [x, z] = [l + 116.0 / 500.0 * a, l - 116.0 / 200.0 * b].map(light_of_lightness);
    (RGB * DVec3::new(x, light_of_lightness(l), z)).clamp(DVec3::ZERO, DVec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::super::lightness::lightness;
    use super::*;
    use proptest::prelude::*;

    /// The primaries of sRGB under D65, as tables print them; they differ in the second place with the digits
    /// of the white that they assume.
    #[test]
    fn the_primaries_have_their_published_places() {
        for (color, printed) in [
            (DVec3::ONE, [100.0, 0.0, 0.0]),
            (DVec3::X, [53.24, 80.09, 67.20]),
            (DVec3::Y, [87.73, -86.18, 83.18]),
            (DVec3::Z, [32.30, 79.19, -107.86]),
        ] {
            for (found, printed) in lab_of_color(color).into_iter().zip(printed) {
                assert!((found - printed).abs() < 0.03, "{color}: {found} {printed}");
            }
        }
    }

    proptest! {
        #[test]
        fn it_inverts(color in prop::array::uniform3(0.0..=1.0)) {
            let color = DVec3::from(color);
            prop_assert!((color_of_lab(lab_of_color(color)) - color).abs().max_element() < 1e-12);
        }

        #[test]
        fn a_gray_has_its_lightness_and_no_hue(light in 0.0..=1.0) {
            let [l, a, b] = lab_of_color(DVec3::splat(light));
            prop_assert!((l - lightness(light)).abs() < 1e-12 && a.abs() < 1e-12 && b.abs() < 1e-12);
        }
    }
}
