//! `patch` and `patches`: control points to Bézier patches.

use std::sync::Arc;

use super::arguments::BoundArguments;
use super::lists::{index, items, length, no_point, point, points};
use super::lost::Lost;
use crate::math::DVec3;
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::{Spanned, Value, short};
use crate::scene::outline::has_area;
use crate::scene::{BezierPatches, Diagnostic, Shape};

/// Bytes that reading a `patches` call takes at most beside its values.
pub fn bytes(arguments: &BoundArguments<'_, '_>) -> u64 {
    // A point, and its entry in the map of points; a patch, and its sides in the set of those that are open.
    const OF_POINT: u64 = 24 + 24 + 48;
    const OF_PATCH: u64 = 64 + 64 + 4 * 40;
    let count = |name: &str| arguments.value(name).map_or(0, length);
    OF_POINT * count("points") + OF_PATCH * count("patches")
}

/// The surface of a `patch` call: one patch.
pub fn patch(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<Shape, Lost> {
    let Some(net) = arguments.value("points") else { return Err(arguments.missing("points", sink)) };
    let mut control = Vec::with_capacity(16);
    for row in four(arguments, net, sink)? {
        for item in four(arguments, row, sink)? {
            control.push(point(arguments, item, sink)?);
        }
    }
    shape(arguments, net, &control, &[std::array::from_fn(|i| i as u32)], sink)
}

/// The four rows of a net, or the four points of a row.
fn four<'l, 'a>(
    arguments: &BoundArguments<'_, '_>,
    list: &'l Spanned<'a>,
    sink: &mut Sink,
) -> Result<&'l [Spanned<'a>], Lost> {
    if let Value::List(items) = &list.value
        && items.len() == 4
    {
        return Ok(items);
    }
    let error = Diagnostic::error(list.span, "`points` of `patch` takes four rows of four points [x, y, z]");
    let error = match &list.value {
        Value::List(items) => error.label(format!("this has {} items", items.len())),
        other => error.label(format!("this is {}", other.describe())),
    };
    Err(arguments.refuse(error, Lost::Missing, sink))
}

/// The surface of a `patches` call: a solid, where it closes.
pub fn patches(arguments: &BoundArguments<'_, '_>, sink: &mut Sink) -> Result<Shape, Lost> {
    let Some(listed) = arguments.value("points") else { return Err(arguments.missing("points", sink)) };
    let Some(list) = arguments.value("patches") else { return Err(arguments.missing("patches", sink)) };
    let control = points(arguments, listed, sink)?;
    let mut all = Vec::new();
    for patch in items(arguments, list, "patches", "a list of patches, each a list of 16 indices", sink)? {
        let indices =
            items(arguments, patch, "patches", "a list of patches, each a list of 16 indices", sink)?;
        let mut own = [0; 16];
        if indices.len() != own.len() {
            let error =
                Diagnostic::error(patch.span, format!("a patch has {} control points", indices.len()));
            let error = error.help("it has 16, in four rows of four");
            return Err(arguments.refuse(error, Lost::Missing, sink));
        }
        for (place, item) in own.iter_mut().zip(indices) {
            let Some(index) = index(&item.value).filter(|&index| index < control.len()) else {
                return Err(arguments.refuse(no_point("a patch", item, control.len()), Lost::Missing, sink));
            };
            *place = index as u32;
        }
        all.push(own);
    }
    shape(arguments, list, &control, &all, sink)
}

/// The shape of patches; `place` is where they are written.
fn shape(
    arguments: &BoundArguments<'_, '_>,
    place: &Spanned<'_>,
    points: &[DVec3],
    patches: &[[u32; 16]],
    sink: &mut Sink,
) -> Result<Shape, Lost> {
    // A patch has an area where some triangle of its control points has one.
    let has_some = |patch: &[u32; 16]| {
        let at = |i: usize| points[patch[i] as usize];
        let corners = |i: usize| [[i, i + 1, i + 4], [i + 1, i + 5, i + 4]];
        let cells = [0, 1, 2, 4, 5, 6, 8, 9, 10].into_iter().flat_map(corners);
        cells.map(|cell| cell.map(at)).any(|cell| has_area(cell.into_iter()))
    };
    if !patches.iter().any(has_some) {
        let message = format!("`{}` has no area", arguments.word().name);
        return Err(arguments.refuse(Diagnostic::error(place.span, message), Lost::Empty, sink));
    }
    Ok(Shape::Bezier(Arc::new(BezierPatches::new(points, patches))))
}

/// The error of patches that are open where only a solid can stand.
pub fn not_closed(arguments: &BoundArguments<'_, '_>, open: [DVec3; 2]) -> Diagnostic {
    let [from, to] = open.map(|point| {
        let [x, y, z] = point.to_array().map(short);
        format!("[{x}, {y}, {z}]")
    });
    let message =
        format!("`{}` is not closed: a surface has no inside, and is no operand", arguments.word().name);
    let error = Diagnostic::error(arguments.place_of("patches"), message);
    let error = error.label(format!("no other patch has the side from {from} to {to}"));
    error.help(
        "let each side belong to two patches, or show the surface outside of `difference` and `intersection`",
    )
}
