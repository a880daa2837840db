//! PLY, the Polygon File Format of Stanford: a header that says what follows, and that, in text or binary.

mod header;
mod values;

use crate::math::DVec3;

use super::fault::{MeshError, MeshFault};
use super::index::CornerNumbers;
use super::polygons::PolygonMesh;

pub use header::is_ply;
use header::{Element, Encoding, Property};
use values::PlyValues;

/// The names that a list of a face's corners goes by.
const CORNERS: [&[u8]; 2] = [b"vertex_indices", b"vertex_index"];

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<PolygonMesh, MeshError> {
    let header = header::read(bytes)?;
    let mut values = PlyValues::new(bytes, &header);
    let vertices = header.elements.iter().find(|element| element.name == b"vertex");
    // Faces may come before their corners. Of those that then are not there, the error is that the file is
    // cut off.
    let count = vertices.map_or(0, |element| usize::try_from(element.count).unwrap_or(usize::MAX));
    let known = CornerNumbers::from_zero(count.min(u32::MAX as usize));
    let format = if header.encoding == Encoding::Ascii { "text PLY" } else { "binary PLY" };
    let mut mesh = PolygonMesh::of(format);
    for element in &header.elements {
        // What has no values takes no bytes, however many of it there are.
        if element.properties.is_empty() {
            continue;
        }
        match element.name {
            b"vertex" => read_corners(element, &mut values, &mut mesh)?,
            b"face" => read_faces(element, known, &mut values, &mut mesh)?,
            _ => {
                for item in 0..element.count {
                    values.begin(element.name, item);
                    element.properties.iter().try_for_each(|property| pass_over(property, &mut values))?;
                }
            }
        }
    }
    if let Some(rest) = values.rest() {
        mesh.notes.push(format!("{rest} behind the last element are ignored"));
    }
    let is_short = |element: &Element<'_>| element.name == b"vertex" && element.properties.is_empty();
    if header.elements.iter().any(is_short) {
        return Err(MeshFault::Unexpected("`property float x` in the header".to_owned()).of_all());
    }
    Ok(mesh)
}

fn read_corners<'a>(
    element: &Element<'a>,
    values: &mut PlyValues<'a>,
    mesh: &mut PolygonMesh,
) -> Result<(), MeshError> {
    let axis = |property: &Property<'_>| {
        [b"x", b"y", b"z"].iter().position(|name| property.name == *name && property.length.is_none())
    };
    let axes: Vec<Option<usize>> = element.properties.iter().map(axis).collect();
    if (0..3).any(|axis| !axes.contains(&Some(axis))) {
        return Err(MeshFault::Unexpected("corners with `x`, `y` and `z` in the header".to_owned()).of_all());
    }
    for item in 0..element.count {
        values.begin(element.name, item);
        let mut point = DVec3::ZERO;
        for (property, axis) in element.properties.iter().zip(&axes) {
            let Some(axis) = *axis else {
                pass_over(property, values)?;
                continue;
            };
            let value = values.take(property.value, "a coordinate")?;
            if !value.number.is_finite() {
                return Err(values.fault(value, MeshFault::NotFinite("a coordinate".to_owned())));
            }
            point[axis] = value.number;
        }
        mesh.add_point(point);
    }
    Ok(())
}

fn read_faces<'a>(
    element: &Element<'a>,
    known: CornerNumbers,
    values: &mut PlyValues<'a>,
    mesh: &mut PolygonMesh,
) -> Result<(), MeshError> {
    let is_corners = |property: &&Property<'_>| CORNERS.contains(&property.name) && property.length.is_some();
    if !element.properties.iter().any(|property| is_corners(&property)) {
        return Err(
            MeshFault::Unexpected("faces with a list `vertex_indices` in the header".to_owned()).of_all()
        );
    }
    let mut face = Vec::new();
    for item in 0..element.count {
        values.begin(element.name, item);
        for property in &element.properties {
            let Some(length) = property.length.filter(|_| is_corners(&property)) else {
                pass_over(property, values)?;
                continue;
            };
            face.clear();
            for _ in 0..values.length(length)? {
                let value = values.take(property.value, "the number of a corner")?;
                if value.number.fract() != 0.0 {
                    let fault = MeshFault::Unexpected("the whole number of a corner".to_owned());
                    return Err(values.fault(value, fault));
                }
                // What is beyond 64 bits becomes the largest that there is, which no corner has.
                let corner = known.corner(value.number as i64);
                face.push(corner.map_err(|fault| values.fault(value, fault))?);
            }
            if face.len() < 3 {
                return Err(values.fault_of_item(MeshFault::FewCorners(face.len())));
            }
            mesh.add_face(face.iter().copied()).map_err(MeshFault::of_all)?;
        }
    }
    Ok(())
}

fn pass_over(property: &Property<'_>, values: &mut PlyValues<'_>) -> Result<(), MeshError> {
    let count = match property.length {
        Some(length) => values.length(length)?,
        None => 1,
    };
    for _ in 0..count {
        values.take(property.value, "a value")?;
    }
    Ok(())
}
