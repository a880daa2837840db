//! Colours as screens have them (sRGB), given as the light that shows them.

use crate::math::DVec3;

/// The colour of `rgb`, `rgba`, `rrggbb` or `rrggbbaa` in hexadecimal digits; and its alpha.
pub fn by_digits(digits: &str) -> Option<(DVec3, Option<f64>)> {
    if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let width = match digits.len() {
        3 | 4 => 1,
        6 | 8 => 2,
        _ => return None,
    };
    // One digit stands for two equal ones: 0xf → 0xff.
    let channel = |index: usize| {
        let value = u8::from_str_radix(digits.get(index * width..(index + 1) * width)?, 16).ok()?;
        Some(if width == 1 { value * 0x11 } else { value })
    };
    let color = DVec3::new(linear(channel(0)?), linear(channel(1)?), linear(channel(2)?));
    Some((color, channel(3).map(|alpha| f64::from(alpha) / 255.0)))
}

/// The light of an sRGB channel: IEC 61966-2-1.
fn linear(channel: u8) -> f64 {
    let encoded = f64::from(channel) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}
