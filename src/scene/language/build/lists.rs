//! Arguments that are lists: of points, and of indices of points.

use super::arguments::{BoundArguments, numbers};
use super::lost::Lost;
use crate::math::DVec3;
use crate::scene::Diagnostic;
use crate::scene::diagnostic::Sink;
use crate::scene::language::syntax::{Spanned, Value};

/// The items of a list that is an argument, or a part of one; `takes` says what else is meant by it.
pub fn items<'l, 'a>(
    arguments: &BoundArguments<'_, '_>,
    list: &'l Spanned<'a>,
    name: &str,
    takes: &str,
    sink: &mut Sink,
) -> Result<&'l [Spanned<'a>], Lost> {
    if let Value::List(items) = &list.value {
        return Ok(items);
    }
    let message = format!("`{name}` of `{}` takes {takes}", arguments.word().name);
    let error = Diagnostic::error(list.span, message).label(format!("this is {}", list.value.describe()));
    Err(arguments.refuse(error, Lost::Missing, sink))
}

/// How many items a value has; none of what is no list.
pub fn length(value: &Spanned<'_>) -> u64 {
    match &value.value {
        Value::List(items) => items.len() as u64,
        _ => 0,
    }
}

/// The points of a list.
pub fn points(
    arguments: &BoundArguments<'_, '_>,
    list: &Spanned<'_>,
    sink: &mut Sink,
) -> Result<Vec<DVec3>, Lost> {
    let items = items(arguments, list, "points", "a list of points [x, y, z]", sink)?;
    items.iter().map(|item| point(arguments, item, sink)).collect()
}

/// A point of a list; of a coordinate that is 0 the sign is left out, so that −0 and 0 are the same.
pub fn point(arguments: &BoundArguments<'_, '_>, item: &Spanned<'_>, sink: &mut Sink) -> Result<DVec3, Lost> {
    let name = arguments.word().name;
    let Some(&[x, y, z]) = numbers(&item.value).as_deref() else {
        let error = Diagnostic::error(item.span, format!("a point of `{name}` is [x, y, z]"));
        let error = error.label(format!("this is {}", item.value.describe()));
        return Err(arguments.refuse(error, Lost::Missing, sink));
    };
    let point = DVec3::new(x, y, z) + DVec3::ZERO;
    if !point.is_finite() {
        let error = Diagnostic::error(item.span, format!("a point of `{name}` is no place"));
        return Err(arguments.refuse(error, Lost::Missing, sink));
    }
    Ok(point)
}

/// A whole number that counts something, from 0.
pub fn index(value: &Value<'_>) -> Option<usize> {
    match value {
        Value::Number(number) if *number >= 0.0 && number.fract() == 0.0 => Some(*number as usize),
        _ => None,
    }
}

/// The error of an index of a point that there is not, among so many; `what` names it.
pub fn no_point(what: &str, index: &Spanned<'_>, count: usize) -> Diagnostic {
    let error = Diagnostic::error(index.span, format!("{what} names a point that there is not"));
    let error = error.label(format!("this is {}", index.value.describe()));
    match count {
        0 => error.help("`points` is empty"),
        count => error.help(format!("points are numbered from 0 to {}", count - 1)),
    }
}
