//! The line of figures: where the eye is, and what the last picture took.

use super::model::Model;
use super::motion;
use super::shown::Shown;
use crate::math::DVec3;
use crate::widget::figures;

/// The line of figures, for so many columns.
pub fn line(model: &Model, shown: Option<&Shown>, columns: u16) -> String {
    let camera = &model.camera;
    let DVec3 { x, y, z } = camera.eye;
    let digits = decimals(motion::distance(camera));
    let [x, y, z] = [x, y, z].map(|coordinate| length(coordinate, digits));
    let [azimuth, elevation] = motion::direction(camera).map(tenths);
    let [across, down] = model.field().map(tenths);
    let mut parts = vec![
        format!("EYE {x} {y} {z}"),
        format!("DIR {azimuth} {elevation}"),
        format!("FIELD {across}×{down}"),
    ];
    if let Some(shown) = shown {
        let ms = shown.total_ms();
        parts.extend([milliseconds(ms), rate(ms), figures::bytes(shown.bytes) + "/f"]);
    }
    let wide = format!(" {}", parts.join("  "));
    let fits = |line: &String| line.chars().count() <= columns.into();
    let way = shown.and_then(|shown| shown.round_trip).map(|way| {
        let ms = milliseconds(way.as_secs_f64() * 1e3);
        format!("{wide}  LINK {ms}")
    });
    let wide = way.filter(fits).unwrap_or(wide);
    let rays = shown.and_then(|shown| shown.rays).map(|rays| format!("{wide}  RAYS {rays}"));
    // The panel of the flow chart says that too.
    if let Some(all) = rays.filter(fits) {
        return all;
    }
    // Long coordinates take the room from between the figures first.
    if wide.chars().count() <= columns.into() { wide } else { format!(" {}", parts.join(" ")) }
}

/// How many decimals show a step of the keys, a fiftieth of the distance or so, at any scale of the scene.
fn decimals(distance: f64) -> usize {
    // Nine decimals and a sign are what three coordinates have room for.
    (1.0 - libm::floor(libm::log10(distance / 5.0))).clamp(1.0, 9.0) as usize
}

/// A coordinate; in powers of ten where its digits would fill the line.
fn length(x: f64, decimals: usize) -> String {
    if x.abs() >= 1e6 { format!("{x:.3e}") } else { without_sign_of_zero(format!("{x:.decimals$}")) }
}

fn tenths(x: f64) -> String {
    without_sign_of_zero(format!("{x:.1}"))
}

/// −0.0 reads as a place left of 0.0, but is none.
fn without_sign_of_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

fn milliseconds(ms: f64) -> String {
    if ms < 9.95 { format!("{ms:.1} ms") } else { format!("{ms:.0} ms") }
}

/// Pictures per second if they followed each other without a pause.
fn rate(ms: f64) -> String {
    match 1e3 / ms {
        rate if rate < 9.95 => format!("{rate:.1} fps"),
        // Beyond a thousand the clock says more about itself than about the picture.
        rate if rate < 999.5 => format!("{rate:.0} fps"),
        _ => ">999 fps".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_show_a_step_at_any_scale() {
        assert_eq!([9.5, 0.05, 1e-12, 5e4].map(decimals), [1, 3, 9, 1]);
        assert_eq!(length(-0.01, 1), "0.0");
        assert_eq!(length(-9.04, 1), "-9.0");
        assert_eq!(length(-1.5e30, 1), "-1.500e30");
    }
}
