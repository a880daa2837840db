//! Colours by name and by hexadecimal digits, as linear light.

use crate::math::DVec3;
use crate::scene::language::css_colors::CSS_COLORS;
use crate::scene::language::nearest::nearest;
use crate::scene::screen_colors::by_digits;

/// A CSS name in any case, or `#rgb`, `#rgba`, `#rrggbb`, `#rrggbbaa`: a colour of the screen (sRGB), given
/// as the light that shows it; and its alpha.
pub fn by_name(name: &str) -> Option<(DVec3, Option<f64>)> {
    if let Some(digits) = name.strip_prefix('#') {
        return by_digits(digits);
    }
    let (_, digits) = CSS_COLORS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name))?;
    by_digits(digits)
}

/// The nearest name of a colour.
pub fn nearest_name(name: &str) -> Option<&'static str> {
    nearest(name, CSS_COLORS.iter().map(|&(known, _)| known))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_digits_agree() {
        assert_eq!(by_name("Red"), Some((DVec3::X, None)));
        assert_eq!(by_name("#f00"), Some((DVec3::X, None)));
        assert_eq!(by_name("#ff000080"), Some((DVec3::X, Some(128.0 / 255.0))));
        assert_eq!(by_name("#ff00"), Some((DVec3::new(1.0, 1.0, 0.0), Some(0.0))));
        for bad in ["", "#", "#ff", "#ggg", "#é1", "ultraviolet"] {
            assert_eq!(by_name(bad), None, "{bad}");
        }
        assert_eq!(nearest_name("sliver"), Some("silver"));
    }

    #[test]
    fn names_are_sorted_and_all_there() {
        assert!(CSS_COLORS.is_sorted_by_key(|&(name, _)| name));
        // 147 names of CSS Color Module Level 3, and rebeccapurple.
        assert_eq!(CSS_COLORS.len(), 148);
    }

    #[test]
    fn the_middle_gray_of_the_screen_is_a_fifth_of_its_light() {
        let (gray, _) = by_name("gray").expect("a CSS name");
        assert!((gray.x - 0.215_860_5).abs() < 1e-6, "{gray}");
    }
}
