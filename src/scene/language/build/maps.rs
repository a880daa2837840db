//! The words that move their children, as affine maps.

use super::arguments::{BoundArguments, numbers};
use super::lost::Lost;
use crate::math::{DAffine3, DMat3, DVec3};
use crate::scene::Diagnostic;
use crate::scene::degrees;
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::{Spanned, Value};
use crate::scene::language::vocabulary::MapWord;
use crate::scene::unit_vector::unit;

/// The map of a call alone.
pub fn map_of(word: MapWord, arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<DAffine3, Lost> {
    match word {
        MapWord::Multmatrix => multmatrix(arguments, sink),
        MapWord::Translate => {
            let way = arguments.triple("v", 0.0, sink)?.ok_or_else(|| arguments.missing("v", sink))?;
            Ok(DAffine3::from_translation(way))
        }
        MapWord::Rotate => rotate(arguments, sink),
        MapWord::Scale => {
            let factors = arguments.triple("v", 1.0, sink)?.ok_or_else(|| arguments.missing("v", sink))?;
            Ok(DAffine3::from_scale(factors))
        }
        MapWord::Mirror => {
            let normal = arguments.triple("v", 0.0, sink)?.ok_or_else(|| arguments.missing("v", sink))?;
            Ok(DAffine3::from_mat3(mirror(normal)))
        }
    }
}

/// What a map does within the plane z = 0.
pub fn flattened(map: &DAffine3) -> DAffine3 {
    let [x, y] = [map.matrix3.x_axis, map.matrix3.y_axis].map(|axis| axis.with_z(0.0));
    DAffine3 { matrix3: DMat3::from_cols(x, y, DVec3::Z), translation: map.translation.with_z(0.0) }
}

fn multmatrix(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<DAffine3, Lost> {
    let Some(value) = arguments.value("m") else { return Err(arguments.missing("m", sink)) };
    let Some(rows) = rows(value) else {
        let error = Diagnostic::error(value.span, "`m` of `multmatrix` takes 4 or 3 rows of 4 numbers");
        let label = format!("this is {}", value.value.describe());
        let error = error.label(label).help("[[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]");
        return Err(arguments.refuse(error, Lost::Missing, sink));
    };
    if let Some(number) = rows.iter().flatten().find(|number| !number.is_finite()) {
        let error = Diagnostic::error(value.span, "`m` of `multmatrix` holds what is no number");
        return Err(arguments.refuse(error.label(format!("this is {number}")), Lost::Empty, sink));
    }
    if rows.get(3).is_some_and(|last| *last != [0.0, 0.0, 0.0, 1.0]) {
        let error = Diagnostic::error(value.span, "the last row of `multmatrix` must be [0, 0, 0, 1]");
        let error = error.label("this is a perspective map").help("solids are moved by affine maps only");
        return Err(arguments.refuse(error, Lost::Missing, sink));
    }
    let column = |axis: usize| DVec3::new(rows[0][axis], rows[1][axis], rows[2][axis]);
    Ok(DAffine3 { matrix3: DMat3::from_cols(column(0), column(1), column(2)), translation: column(3) })
}

/// Three or four rows of four numbers.
fn rows(value: &Spanned<'_>) -> Option<Vec<[f64; 4]>> {
    let Value::List(items) = &value.value else { return None };
    if !(3..=4).contains(&items.len()) {
        return None;
    }
    items.iter().map(|item| numbers(&item.value)?.try_into().ok()).collect()
}

fn rotate(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<DAffine3, Lost> {
    let Some(value) = arguments.value("a") else { return Err(arguments.missing("a", sink)) };
    let Value::Number(_) = value.value else {
        // `a` is there, so that the triple is, too, unless it is an error. OpenSCAD ignores `v` here.
        let angles = arguments.triple("a", 0.0, sink)?.unwrap_or_default();
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| about(axis, angles.dot(axis)));
        return Ok(DAffine3::from_mat3(z * y * x));
    };
    let angle = arguments.number("a", sink)?.unwrap_or_default();
    let axis = arguments.triple("v", 0.0, sink)?.unwrap_or(DVec3::Z);
    Ok(DAffine3::from_mat3(about(axis, angle)))
}

/// The rotation by degrees about an axis of any length (Rodrigues); about no axis it is none, as in OpenSCAD.
fn about(axis: DVec3, angle: f64) -> DMat3 {
    let (sine, cosine) = (degrees::sin(angle), degrees::cos(angle));
    let Some(DVec3 { x, y, z }) = unit(axis) else { return DMat3::IDENTITY };
    let rest = 1.0 - cosine;
    DMat3::from_cols(
        DVec3::new(x * x * rest + cosine, x * y * rest + z * sine, x * z * rest - y * sine),
        DVec3::new(x * y * rest - z * sine, y * y * rest + cosine, y * z * rest + x * sine),
        DVec3::new(x * z * rest + y * sine, y * z * rest - x * sine, z * z * rest + cosine),
    )
}

/// I − 2nnᵀ; without a normal nothing is mirrored, as in OpenSCAD.
fn mirror(normal: DVec3) -> DMat3 {
    let Some(n) = unit(normal) else { return DMat3::IDENTITY };
    let column = |axis: DVec3| axis - n * (2.0 * n.dot(axis));
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(about(DVec3::Z, 90.0) * DVec3::X, DVec3::Y);
        assert_eq!(about(DVec3::X * 1e200, -90.0) * DVec3::Z, DVec3::Y);
        assert_eq!(about(DVec3::ZERO, 90.0), DMat3::IDENTITY);
        assert_eq!(mirror(DVec3::X * 1e-200) * DVec3::ONE, DVec3::new(-1.0, 1.0, 1.0));
    }
}
