//! Whether two pictures are one, and if not, what differs.

use ray13::frame::Frame;

/// How a picture differs from a reference of the same dots, in any bit of any dot or in any cell: how many
/// dots, how far, and what the first of them hold.
pub fn difference(picture: &Frame, reference: &Frame) -> Option<String> {
    let comparison = picture.compare(reference).unwrap_or_else(|error| panic!("{error}"));
    let [own, other] = [picture, reference].map(held);
    if own != other {
        return Some(format!("one holds {own:?}, the other {other:?}"));
    }
    if comparison.is_same() {
        return None;
    }
    let first = comparison.first.map(|[column, row]| {
        let place = (column, row);
        format!("\n  {}\n  {}", dot(picture, place), dot(reference, place))
    });
    Some(format!("{comparison}{}", first.unwrap_or_default()))
}

/// Checks that a picture is the reference, to the bit.
#[track_caller]
pub fn assert_same_picture(what: &str, picture: &Frame, reference: &Frame) {
    if let Some(fault) = difference(picture, reference) {
        panic!("{what}: {fault}");
    }
}

/// What a picture holds beside light.
fn held(frame: &Frame) -> Vec<&'static str> {
    let all = [
        ("colors", frame.color.is_some()),
        ("depths", frame.depth.is_some()),
        ("normals", frame.normal.is_some()),
        ("objects", frame.object.is_some()),
        ("cells", frame.cells.is_some()),
    ];
    all.into_iter().filter_map(|(name, is_held)| is_held.then_some(name)).collect()
}

fn dot(frame: &Frame, place: (u32, u32)) -> String {
    let mut held = format!("light {:e}", frame.light[place]);
    if let Some(color) = &frame.color {
        held += &format!(", color {}", color[place]);
    }
    if let Some(depth) = &frame.depth {
        held += &format!(", depth {:e}", depth[place]);
    }
    if let Some(normal) = &frame.normal {
        held += &format!(", normal {}", normal[place]);
    }
    if let Some(object) = &frame.object {
        held += &format!(", object {}", object[place]);
    }
    held
}
