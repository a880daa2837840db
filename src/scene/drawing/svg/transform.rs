//! The `transform` attribute.

use super::scan::TextScan;
use crate::math::{DAffine2, DMat2, DVec2};
use crate::scene::degrees;

/// The map of a list of transforms, the last of which is done first; or what is wrong with it. One with
/// another number of arguments than it takes is none, as in OpenSCAD.
pub fn transform(text: &str) -> Result<DAffine2, String> {
    let mut map = DAffine2::IDENTITY;
    let mut scan = TextScan::of(text);
    while !scan.is_empty() {
        let wrong = |scan: &TextScan<'_>| format!("`transform` can not be read from `{}` on", scan.shown());
        let name = scan.word();
        let (mut numbers, at) = (Vec::new(), scan);
        if scan.letter(|letter| letter == '(').is_none() {
            return Err(wrong(&at));
        }
        while let Some(number) = scan.number() {
            if !number.is_finite() {
                return Err("a number in `transform` is not finite".to_owned());
            }
            numbers.push(number);
        }
        if scan.letter(|letter| letter == ')').is_none() {
            return Err(wrong(&scan));
        }
        map *= one(name, &numbers).ok_or_else(|| wrong(&at))?;
    }
    Ok(map)
}

/// The map of a transform; none where there is none of that name.
fn one(name: &str, numbers: &[f64]) -> Option<DAffine2> {
    let tangent = |angle: f64| degrees::sin(angle) / degrees::cos(angle);
    let turn = |angle: f64| {
        let (sine, cosine) = (degrees::sin(angle), degrees::cos(angle));
        DAffine2::from_mat2(DMat2::from_cols(DVec2::new(cosine, sine), DVec2::new(-sine, cosine)))
    };
    Some(match (name, numbers) {
        ("matrix", &[a, b, c, d, e, f]) => DAffine2::from_cols_array(&[a, b, c, d, e, f]),
        ("translate", &[x]) => DAffine2::from_translation(DVec2::new(x, 0.0)),
        ("translate", &[x, y]) => DAffine2::from_translation(DVec2::new(x, y)),
        ("scale", &[both]) => DAffine2::from_scale(DVec2::splat(both)),
        ("scale", &[x, y]) => DAffine2::from_scale(DVec2::new(x, y)),
        ("rotate", &[angle]) => turn(angle),
        ("rotate", &[angle, x, y]) => {
            let at = DVec2::new(x, y);
            DAffine2::from_translation(at) * turn(angle) * DAffine2::from_translation(-at)
        }
        ("skewX", &[angle]) => DAffine2::from_cols_array(&[1.0, 0.0, tangent(angle), 1.0, 0.0, 0.0]),
        ("skewY", &[angle]) => DAffine2::from_cols_array(&[1.0, tangent(angle), 0.0, 1.0, 0.0, 0.0]),
        ("matrix" | "translate" | "scale" | "rotate" | "skewX" | "skewY", _) => DAffine2::IDENTITY,
        _ => return None,
    })
}
