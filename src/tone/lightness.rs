//! Light, lightness and the bytes of a picture file: the curves of CIE 1976 L* and of sRGB (IEC 61966-2-1).

/// The light where L*'s straight foot meets its cube root: (6/29)³.
const FOOT_LIGHT: f64 = 216.0 / 24389.0;
/// L* per unit of light on the foot: (29/3)³.
const FOOT_SLOPE: f64 = 24389.0 / 27.0;

/// CIE L*, 0 to 100, of linear `light`, 0 to 1, against white at 1.
pub fn lightness(light: f64) -> f64 {
    if light > FOOT_LIGHT { 116.0 * libm::cbrt(light) - 16.0 } else { FOOT_SLOPE * light }
}

/// The light, 0 to 1, of a CIE `lightness` L*, 0 to 100.
pub fn light_of_lightness(lightness: f64) -> f64 {
    let root = (lightness + 16.0) / 116.0;
    if lightness > FOOT_SLOPE * FOOT_LIGHT { root * root * root } else { lightness / FOOT_SLOPE }
}

/// The linear light, 0 to 1, of an sRGB byte.
pub fn light_of_srgb(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// The sRGB byte nearest to linear `light`, which is clamped to 0 to 1; NaN gives 0.
pub fn srgb_of_light(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let value =
        if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
    (value * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_has_its_published_points() {
        assert_eq!(lightness(0.0), 0.0);
        assert!((lightness(1.0) - 100.0).abs() < 1e-12);
        assert!((lightness(FOOT_LIGHT) - 8.0).abs() < 1e-12);
        // Middle gray: 18.42 % of light is half of lightness.
        assert!((lightness(0.184_186_518_9) - 50.0).abs() < 1e-6);
    }

    #[test]
    fn the_curves_invert() {
        for byte in 0..=255 {
            let light = light_of_srgb(byte);
            assert_eq!(srgb_of_light(light), byte);
            assert!((light_of_lightness(lightness(light)) - light).abs() < 1e-15);
        }
    }
}
