//! Which format a mesh file has, and its reader.

use super::fault::MeshError;
use super::objects::{self, amf, three_mf};
use super::polygons::PolygonMesh;
use super::{obj, off, ply, stl};
use crate::scene::{Format, ReadOptions};

/// The format of a mesh by its content, whatever its name.
pub fn format_of(bytes: &[u8]) -> Option<Format> {
    let bytes = without_mark(bytes);
    if ply::is_ply(bytes) {
        Some(Format::Ply)
    } else if stl::is_binary(bytes) || stl::is_text(bytes) {
        Some(Format::Stl)
    } else if off::is_off(bytes) {
        Some(Format::Off)
    } else if obj::is_obj(bytes) {
        Some(Format::Obj)
    } else {
        objects::format_of(bytes)
    }
}

/// What is behind the byte order mark that some editors put before a text. The header of a binary STL may be
/// anything.
pub fn without_mark(bytes: &[u8]) -> &[u8] {
    match bytes.strip_prefix("\u{feff}".as_bytes()) {
        Some(text) if !stl::is_binary(bytes) => text,
        _ => bytes,
    }
}

/// The polygons of a file; `None` where the format is none of meshes. Without options files of materials are
/// not read. What is compressed, or names what it is made of, is read as far as `room` bytes allow for.
pub fn polygons(
    bytes: &[u8],
    format: Format,
    options: Option<&ReadOptions>,
    room: u64,
) -> Option<Result<PolygonMesh, MeshError>> {
    match format {
        Format::Stl => Some(stl::read(bytes)),
        Format::Off => Some(off::read(bytes)),
        Format::Ply => Some(ply::read(bytes)),
        Format::Obj => Some(obj::read(bytes, options)),
        Format::ThreeMf => Some(three_mf::read(bytes, room)),
        Format::Amf => Some(amf::read(bytes, room)),
        Format::Language | Format::Nff => None,
    }
}
