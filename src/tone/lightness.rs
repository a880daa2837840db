//! Light, lightness and the bytes of a picture file: the curves of CIE 1976 L* and of sRGB (IEC 61966-2-1).

use super::root::{NEAR, cube_roots, near_cube_root};

/// The light where L*'s straight foot meets its cube root: (6/29)³.
const FOOT_LIGHT: f64 = 216.0 / 24389.0;
/// L* per unit of light on the foot: (29/3)³.
const FOOT_SLOPE: f64 = 24389.0 / 27.0;

/// The light where the straight foot of sRGB's curve ends.
const SRGB_FOOT: f64 = 0.003_130_8;

/// CIE L*, 0 to 100, of linear `light`, 0 to 1, against white at 1.
#[inline]
pub fn lightness(light: f64) -> f64 {
    lightnesses([light])[0]
}

/// [`lightness`] of several at once, which is sooner than one by one.
pub fn lightnesses<const N: usize>(mut light: [f64; N]) -> [f64; N] {
    let mut roots = light;
    for root in &mut roots {
        *root = root.max(FOOT_LIGHT);
    }
    roots = cube_roots(roots);
    for (light, root) in light.iter_mut().zip(roots) {
        *light = if *light > FOOT_LIGHT { 116.0 * root - 16.0 } else { FOOT_SLOPE * *light };
    }
    light
}

/// [`lightness`] in single precision, of several at once: each the number nearest to its own.
#[inline]
pub fn lightness_in_single<const N: usize>(light: [f64; N]) -> [f32; N] {
    /// Twice what [`near_cube_root`] may be away, up to L* 100: the rest is for rounding.
    const AWAY: f64 = 2.0 * 116.0 * NEAR;
    let mut near = light;
    for near in &mut near {
        *near = 116.0 * near_cube_root(*near) - 16.0;
    }
    let mut found = [0.0; N];
    let mut is_doubtful = false;
    for k in 0..N {
        let (low, high) = ((near[k] - AWAY) as f32, (near[k] + AWAY) as f32);
        let is_root = light[k] > FOOT_LIGHT;
        found[k] = if is_root { low } else { (FOOT_SLOPE * light[k]) as f32 };
        is_doubtful |= is_root && low != high;
    }
    if is_doubtful { lightnesses(light).map(|lightness| lightness as f32) } else { found }
}

/// The light, 0 to 1, of a CIE `lightness` L*, 0 to 100.
#[inline]
pub fn light_of_lightness(lightness: f64) -> f64 {
    let root = (lightness + 16.0) / 116.0;
    if lightness > FOOT_SLOPE * FOOT_LIGHT { root * root * root } else { lightness / FOOT_SLOPE }
}

/// The linear light, 0 to 1, of an sRGB byte.
#[inline]
pub fn light_of_srgb(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// The sRGB byte nearest to linear `light`, which is clamped to 0 to 1; NaN gives 0.
pub fn srgb_of_light(light: f64) -> u8 {
    let light = light.clamp(0.0, 1.0);
    let nearest = |value: f64| (value * 255.0 + 0.5) as u8;
    if light <= SRGB_FOOT {
        return nearest(light * 12.92);
    }
    // The power 1/2.4 is 5/12: the cube root of light to the 5/4. Only where bytes meet does it take the
    // power itself.
    let power = near_cube_root(light * light.sqrt().sqrt());
    let byte = |power: f64| nearest(1.055 * power - 0.055);
    let (low, high) = (byte(power * (1.0 - 2.0 * NEAR)), byte(power * (1.0 + 2.0 * NEAR)));
    if low == high { low } else { byte(libm::pow(light, 1.0 / 2.4)) }
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

    /// The definition, with nothing spared.
    fn srgb_by_power(light: f64) -> u8 {
        let value =
            if light <= SRGB_FOOT { light * 12.92 } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
        (value * 255.0 + 0.5) as u8
    }

    #[test]
    fn bytes_are_those_of_the_power() {
        const STEPS: u32 = 1 << 16;
        for k in 0..=STEPS {
            let light = f64::from(k) / f64::from(STEPS);
            assert_eq!(srgb_of_light(light), srgb_by_power(light), "{light}");
        }
        // Light by light where each byte meets the next.
        for byte in 0..255 {
            let (mut low, mut high) = (light_of_srgb(byte).to_bits(), light_of_srgb(byte + 1).to_bits());
            while high - low > 1 {
                let middle = u64::midpoint(low, high);
                if srgb_by_power(f64::from_bits(middle)) > byte { high = middle } else { low = middle }
            }
            for bits in low.saturating_sub(20)..low + 20 {
                let light = f64::from_bits(bits);
                assert_eq!(srgb_of_light(light), srgb_by_power(light), "{light}");
            }
        }
    }

    #[test]
    fn single_precision_is_the_nearest() {
        const STEPS: u32 = 1 << 16;
        let lights = |k: u32| [k, k + 1, k + 2].map(|k| f64::from(k) / f64::from(STEPS));
        for lights in (0..STEPS - 1).map(lights).chain([[FOOT_LIGHT, FOOT_LIGHT.next_up(), 0.5]]) {
            assert_eq!(lightness_in_single(lights), lights.map(|light| lightness(light) as f32));
        }
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
