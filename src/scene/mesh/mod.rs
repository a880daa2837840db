//! Mesh files: STL, OFF, PLY and OBJ.
//!
//! Bytes → polygons ([`polygons`]), by a reader for each format → objects ([`assemble`]). Readers stop at the
//! first mistake, and take memory for what there is, not for what the file says there is. `docs/meshes.md`
//! describes the formats for people, `docs/decisions/24-mesh-files.md` why the readers are our own.

mod assemble;
mod facts;
mod fault;
mod index;
mod obj;
mod off;
mod ply;
mod polygons;
mod solids;
mod stl;
#[cfg(test)]
mod tests;
mod topology;
mod words;

use super::memory::too_little;
use super::{Diagnostics, Format, ReadOptions, Scene, UpAxis};
use fault::MeshError;
use polygons::PolygonMesh;

pub use facts::MeshFacts;
pub(super) use solids::{MeshSolids, NoSolids, solids};

/// The format of a mesh by its content, whatever its name.
pub(super) fn format_of(bytes: &[u8]) -> Option<Format> {
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
        None
    }
}

/// What is behind the byte order mark that some editors put before a text. The header of a binary STL may be
/// anything.
fn without_mark(bytes: &[u8]) -> &[u8] {
    match bytes.strip_prefix("\u{feff}".as_bytes()) {
        Some(text) if !stl::is_binary(bytes) => text,
        _ => bytes,
    }
}

/// Reads a scene of a mesh; `None` where the format is another.
pub(super) fn read(
    name: &str,
    bytes: &[u8],
    format: Format,
    options: &ReadOptions,
) -> Option<Result<Scene, Diagnostics>> {
    let bytes = without_mark(bytes);
    let polygons = match polygons(bytes, format, Some(options))? {
        Ok(polygons) => polygons,
        Err(error) => return Some(Err(error.told(name, bytes))),
    };
    let needed = bytes.len() as u64 + assemble::bytes(&polygons);
    if let Some(limit) = options.memory.filter(|&limit| needed > limit) {
        return Some(Err(Diagnostics::whole(name, too_little(limit, needed))));
    }
    let up = options.up.unwrap_or(if format == Format::Obj { UpAxis::Y } else { UpAxis::Z });
    Some(assemble::assemble(polygons, up).map_err(|error| error.told(name, bytes)))
}

/// The polygons of a file; `None` where the format is none of meshes. Without options materials are not read.
fn polygons(
    bytes: &[u8],
    format: Format,
    options: Option<&ReadOptions>,
) -> Option<Result<PolygonMesh, MeshError>> {
    match format {
        Format::Stl => Some(stl::read(bytes)),
        Format::Off => Some(off::read(bytes)),
        Format::Ply => Some(ply::read(bytes)),
        Format::Obj => Some(obj::read(bytes, options)),
        Format::Language | Format::Nff => None,
    }
}
