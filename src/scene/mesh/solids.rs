//! The closed parts of a mesh file as solids, for scenes that import it.

use std::sync::Arc;

use super::assemble::{bytes, parts, prepare, triangle_mesh};
use super::facts::{MeshFacts, place};
use super::fault::{MeshError, MeshFault};
use super::formats::{polygons, without_mark};
use crate::scene::{Format, Mesh, UpAxis};

/// What a mesh file has in it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSolids {
    /// Its parts, in the file's own coordinates; at least one. They may overlap.
    pub parts: Vec<Arc<Mesh>>,
    /// What each of them is.
    pub facts: Vec<MeshFacts>,
    /// What was read otherwise than it is written.
    pub notes: Vec<String>,
}

/// Why a file gives no solids.
#[derive(Clone, Debug, PartialEq)]
pub enum NoSolids {
    /// The format is none of meshes.
    NoMesh,
    /// What is wrong with it, and where.
    Wrong(String),
    /// Reading it takes this many bytes, which there are not.
    NoRoom(u64),
}

/// Reads a file as solids, whose faces all have the material of who asks. `room` bytes may be taken for the
/// time of reading.
pub fn solids(file: &[u8], format: Format, room: u64) -> Result<MeshSolids, NoSolids> {
    let file = without_mark(file);
    let told = |error: MeshError| NoSolids::Wrong(error.sentence(file));
    let left = room.saturating_sub(file.len() as u64);
    let mesh = polygons(file, format, None, left).ok_or(NoSolids::NoMesh)?;
    let mut mesh = mesh.map_err(|error| match error.fault {
        MeshFault::NoRoom(needed) => NoSolids::NoRoom(needed.saturating_add(file.len() as u64)),
        _ => told(error),
    })?;
    let needed = bytes(&mesh) + file.len() as u64;
    if needed > room {
        return Err(NoSolids::NoRoom(needed));
    }
    mesh.runs.iter_mut().for_each(|run| run.material = 0);
    prepare(&mut mesh).map_err(told)?;
    let mut solids = MeshSolids { parts: Vec::new(), facts: Vec::new(), notes: mesh.notes.clone() };
    let mut all_doubled = true;
    for mut part in parts(&mesh) {
        if let Some(edge) = part.topology.open_edge {
            let [from, to] = edge.map(|corner| place(mesh.points[corner as usize]));
            return Err(told(MeshFault::Open { from, to }.of_all()));
        }
        all_doubled &= part.is_doubled;
        if part.is_doubled {
            continue;
        }
        let facts = MeshFacts::of(&part.triangles, &mesh.points, &part.topology);
        if let Some(found) = triangle_mesh(&mesh, &mut part, UpAxis::Z) {
            let (format, unit, name) = (mesh.format, mesh.unit, part.name.clone());
            solids.facts.push(MeshFacts { format, unit, name, mesh: Some(Arc::clone(&found)), ..facts });
            solids.parts.push(found);
        }
    }
    match solids.parts.is_empty() {
        false => Ok(solids),
        true if all_doubled => Err(told(MeshFault::Hollow.of_all())),
        true => Err(told(MeshFault::Flat.of_all())),
    }
}
