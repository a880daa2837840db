//! DXF, the drawing format of `AutoCAD`, as far as OpenSCAD reads it: lines, arcs, circles, ellipses,
//! polylines without bulges, and blocks of them, in a plane.

mod entity;
mod groups;
mod joined;
mod sides;

use self::entity::DxfEntity;
use self::groups::DxfGroups;
use self::sides::{Section, Sides};
use super::{DrawingContent, DrawingFault, DrawingRequest};

/// Reads a file: entities make sides, and sides that meet make outlines.
pub fn read(bytes: &[u8], request: &DrawingRequest) -> Result<DrawingContent, DrawingFault> {
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return Err(DrawingFault::whole("it is a binary DXF file: save it as text (ASCII)"));
    }
    let mut sides = Sides::new(request);
    // An entity is whole when the next one begins.
    let mut open = DxfEntity::default();
    for group in DxfGroups::of(bytes) {
        let group = group?;
        if group.code == 0 {
            sides.take(&open)?;
            open = DxfEntity::new(group.value, group.line);
        } else {
            open.take(&group, (sides.section != Section::Blocks).then_some(request))?;
        }
    }
    // OpenSCAD leaves out what a file is cut off in; half a drawing misleads.
    if open.name.is_empty() {
        return Err(DrawingFault::whole("it is empty"));
    }
    if !["ENDSEC", "EOF"].contains(&open.name.as_str()) {
        return Err(DrawingFault::at(open.line, "the file is cut off: it does not end in EOF"));
    }
    let mut notes = sides.notes();
    let outlines = joined::outlines(&sides.drawn, request.is_on_grid);
    if outlines.is_empty() {
        let layer = &request.layer;
        let place = if layer.is_empty() { String::new() } else { format!(" in its layer `{layer}`") };
        notes.push(format!("there is no line{place} that has been read"));
    }
    Ok(DrawingContent { shapes: vec![outlines], notes })
}
