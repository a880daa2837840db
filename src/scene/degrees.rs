//! Sine and cosine of degrees: exact where the value is, at the multiples of 30 and 90, as OpenSCAD's are.

/// The sine of an angle in degrees; finite for every finite angle.
pub fn sin(angle: f64) -> f64 {
    // The remainder of a float division is exact.
    let turned = angle % 360.0;
    let (sign, positive) = if turned < 0.0 { (-1.0, -turned) } else { (1.0, turned) };
    let (sign, half) = if positive >= 180.0 { (-sign, positive - 180.0) } else { (sign, positive) };
    let quarter = if half > 90.0 { 180.0 - half } else { half };
    sign * first_quarter(quarter)
}

/// The cosine of an angle in degrees; finite for every finite angle.
pub fn cos(angle: f64) -> f64 {
    let turned = (angle % 360.0).abs();
    let half = if turned > 180.0 { 360.0 - turned } else { turned };
    if half > 90.0 { -first_quarter(half - 90.0) } else { first_quarter(90.0 - half) }
}

/// The sine inside `0..=90`.
fn first_quarter(angle: f64) -> f64 {
    if angle == 0.0 {
        0.0
    } else if angle == 30.0 {
        0.5
    } else if angle == 45.0 {
        std::f64::consts::FRAC_1_SQRT_2
    } else if angle == 60.0 {
        // √3/2, which libm's sine of the rounded radians misses by an ulp.
        0.866_025_403_784_438_6
    } else if angle == 90.0 {
        1.0
    } else if angle > 45.0 {
        libm::cos((90.0 - angle).to_radians())
    } else {
        libm::sin(angle.to_radians())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_where_the_value_is() {
        let half_root = std::f64::consts::FRAC_1_SQRT_2;
        let table = [
            (0.0, 0.0, 1.0),
            (30.0, 0.5, 3f64.sqrt() / 2.0),
            (45.0, half_root, half_root),
            (60.0, 3f64.sqrt() / 2.0, 0.5),
            (90.0, 1.0, 0.0),
            (120.0, 3f64.sqrt() / 2.0, -0.5),
            (180.0, 0.0, -1.0),
            (210.0, -0.5, -3f64.sqrt() / 2.0),
            (270.0, -1.0, 0.0),
            (300.0, -3f64.sqrt() / 2.0, 0.5),
            (360.0, 0.0, 1.0),
            (360.0 * 1e6 + 90.0, 1.0, 0.0),
        ];
        for (angle, sine, cosine) in table {
            assert_eq!((sin(angle), cos(angle)), (sine, cosine), "{angle}");
            assert_eq!((sin(-angle), cos(-angle)), (-sine, cosine), "-{angle}");
        }
    }

    #[test]
    fn agrees_with_radians_elsewhere() {
        for step in -720..720 {
            let angle = f64::from(step) * 0.77;
            assert!((sin(angle) - libm::sin(angle.to_radians())).abs() < 1e-14, "{angle}");
            assert!((cos(angle) - libm::cos(angle.to_radians())).abs() < 1e-14, "{angle}");
        }
    }
}
