//! Mesh files: STL, OFF, PLY, OBJ, 3MF and AMF.
//!
//! Bytes → polygons ([`polygons`]), by a reader for each format → objects ([`assemble`]). Readers stop at the
//! first mistake, and take memory for what there is, not for what the file says there is. `docs/meshes.md`
//! describes the formats for people, `docs/decisions/24-mesh-files.md` why the readers are our own.

mod assemble;
mod facts;
mod fault;
mod formats;
mod index;
mod obj;
mod objects;
mod off;
mod ply;
mod polygons;
mod solids;
mod stl;
#[cfg(test)]
mod tests;
mod topology;
mod weld;
mod words;

use super::memory::too_little;
use super::{Diagnostics, Format, ReadOptions, Scene, UpAxis};
use fault::{MeshError, MeshFault};
use formats::{polygons, without_mark};

pub use facts::MeshFacts;
pub(super) use formats::format_of;
pub(super) use solids::{MeshSolids, NoSolids, solids};

/// Reads a scene of a mesh; `None` where the format is another.
pub(super) fn read(
    name: &str,
    bytes: &[u8],
    format: Format,
    options: &ReadOptions,
) -> Option<Result<Scene, Diagnostics>> {
    let bytes = without_mark(bytes);
    let room = options.memory.map_or(u64::MAX, |limit| limit.saturating_sub(bytes.len() as u64));
    let polygons = match polygons(bytes, format, Some(options), room)? {
        Ok(polygons) => polygons,
        Err(MeshError { fault: MeshFault::NoRoom(needed), .. }) => {
            return Some(Err(Diagnostics::whole(name, too_little(options.memory.unwrap_or(room), needed))));
        }
        Err(error) => return Some(Err(error.told(name, bytes))),
    };
    let needed = bytes.len() as u64 + assemble::bytes(&polygons);
    if let Some(limit) = options.memory.filter(|&limit| needed > limit) {
        return Some(Err(Diagnostics::whole(name, too_little(limit, needed))));
    }
    let up = options.up.unwrap_or(if format == Format::Obj { UpAxis::Y } else { UpAxis::Z });
    Some(assemble::assemble(polygons, up).map_err(|error| error.told(name, bytes)))
}
