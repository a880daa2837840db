//! A camera as a line of the scene language, and numbers as people type them.

use std::fmt::Write as _;

use crate::math::DVec3;
use crate::scene::Camera;

/// The camera as a statement of the scene language, which its reader gives back bit by bit.
pub fn line(name: &str, camera: &Camera) -> String {
    let mut line = format!(
        "camera({}eye = {}, target = {}",
        quoted(name),
        bracketed(&camera.eye.to_array()),
        bracketed(&camera.target.to_array())
    );
    // A string takes every character.
    if camera.up != DVec3::Z {
        let _ = write!(line, ", up = {}", bracketed(&camera.up.to_array()));
    }
    let _ = write!(line, ", field = {}", bracketed(&camera.field));
    if camera.zoom != 1.0 {
        let _ = write!(line, ", zoom = {}", number(camera.zoom));
    }
    line + ");"
}

/// The name in a line that [`line`] has made, in its quotes; absent where it has none.
pub fn name_in(line: &str) -> Option<&str> {
    let name = line.strip_prefix("camera(")?.split_once(", eye")?.0;
    name.starts_with('"').then_some(name)
}

/// The name as the first argument; nothing where there is none.
fn quoted(name: &str) -> String {
    if name.is_empty() {
        return String::new();
    }
    let escaped = name.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{escaped}\", ")
}

fn bracketed(numbers: &[f64]) -> String {
    format!("[{}]", listed(numbers))
}

/// Numbers, parted by commas.
pub fn listed(numbers: &[f64]) -> String {
    numbers.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", ")
}

/// The shortest number that is read as the same.
pub fn number(x: f64) -> String {
    let text = format!("{x:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A coordinate to a ten-millionth of a distance: from there, a step of it is seen under less than a
/// hundredth of a dot of the finest picture (32 768 dots across a field of 40°, each a 45 000th of the
/// distance wide).
pub fn rounded(x: f64, distance: f64) -> f64 {
    let decimals = 7.0 - libm::floor(libm::log10(distance));
    // Larger scenes have no decimals to lose, and smaller ones would need more than are told.
    if !(0.0..=17.0).contains(&decimals) {
        return x;
    }
    let text = format!("{x:.0$}", decimals as usize);
    // Without the sign of a zero.
    text.parse().map_or(x, |rounded: f64| rounded + 0.0)
}

/// As many numbers as there are names, parted by commas, blanks or an `x`; else what is expected.
pub fn parsed<const N: usize>(text: &str, what: &str, example: &str) -> Result<[f64; N], String> {
    let is_gap = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | 'x' | '×' | '[' | ']');
    let numbers: Result<Vec<f64>, _> =
        text.split(is_gap).filter(|part| !part.is_empty()).map(str::parse).collect();
    let numbers: Option<[f64; N]> = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    let numbers = numbers.filter(|numbers| numbers.iter().all(|x| x.is_finite()));
    numbers.ok_or_else(|| {
        format!("{what}: expected {N} number{}, as in {example}", if N == 1 { "" } else { "s" })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ReadOptions, read};

    #[test]
    fn a_line_is_read_as_the_same_camera() {
        let scene =
            read("a.scene", b"camera(\"a\", eye=[1,2,3]); cube(1);", &ReadOptions::default()).unwrap();
        let first = &scene.views[0];
        for camera in [
            first.clone(),
            Camera { eye: DVec3::new(0.1, -1e-9, 1.0 / 3.0), zoom: 2.5, ..first.clone() },
            Camera {
                up: DVec3::Y,
                field: [33.3, 12.0],
                target: DVec3::new(1e6, 0.0, -0.25),
                ..first.clone()
            },
        ] {
            let name = "\"b\" \\ c";
            let text = line(name, &camera) + " cube(1);";
            let read = read("b.scene", text.as_bytes(), &ReadOptions::default()).expect(&text);
            assert_eq!(read.views, [Camera { name: Some(name.to_owned()), ..camera }], "{text}");
        }
    }

    #[test]
    fn a_rounded_coordinate_has_the_digits_that_are_seen() {
        assert_eq!(rounded(-4.53e-17, 9.0).to_string(), "0");
        assert_eq!(rounded(2.413_823_664_751_956_4, 9.0), 2.413_823_7);
        assert_eq!([rounded(1e-9, 1e-8), rounded(1.25e9, 1e9), rounded(0.1, 1e-30)], [1e-9, 1.25e9, 0.1]);
    }

    #[test]
    fn numbers_are_read_as_people_type_them() {
        for text in ["1,2.5,-3", " [1, 2.5, -3] ", "1 2.5 -3"] {
            assert_eq!(parsed("1,2.5,-3", "eye", "1, 2, 3"), Ok([1.0, 2.5, -3.0]), "{text}");
        }
        assert_eq!(parsed("40x25", "field", "40 x 25"), Ok([40.0, 25.0]));
        for text in ["", "1,2", "1,2,3,4", "1,2,c", "1,2,inf", "nan 1 2"] {
            assert!(parsed::<3>(text, "eye", "0, -9, 3").unwrap_err().starts_with("eye: expected 3 numbers"));
        }
    }
}
