//! OFF, the Object File Format of Geomview: counts, corners, and faces of any number of them.

use crate::math::DVec3;

use super::fault::{MeshError, MeshFault};
use super::index::CornerNumbers;
use super::polygons::PolygonMesh;
use super::words::{MeshLines, MeshWord, MeshWords};

/// Whether the bytes begin as a file of OFF does.
pub fn is_off(bytes: &[u8]) -> bool {
    let first = MeshLines::new(bytes).next().and_then(|mut words| words.next());
    first.is_some_and(|word| header(&word).is_some())
}

/// What stands before `OFF`: letters for what corners have besides a place. None where it is another word.
fn header<'a>(word: &MeshWord<'a>) -> Option<&'a [u8]> {
    let letters = word.bytes.strip_suffix(b"OFF")?;
    let rest = letters.strip_prefix(b"ST").unwrap_or(letters);
    let rest = rest.strip_prefix(b"C").unwrap_or(rest);
    let rest = rest.strip_prefix(b"N").unwrap_or(rest);
    let rest = rest.strip_prefix(b"4").unwrap_or(rest);
    let rest = rest.strip_prefix(b"n").unwrap_or(rest);
    rest.is_empty().then_some(letters)
}

/// Reads a file.
pub fn read(bytes: &[u8]) -> Result<PolygonMesh, MeshError> {
    let mut lines = MeshLines::new(bytes);
    let mut words = lines.expect("`OFF`")?;
    let first = words.expect("`OFF`")?;
    let Some(letters) = header(&first) else {
        return Err(MeshFault::Unexpected("`OFF`".to_owned()).at(first.span()));
    };
    if letters.iter().any(|letter| matches!(letter, b'4' | b'n')) {
        let what = "corners of four or more dimensions";
        return Err(MeshFault::Unsupported(what.to_owned()).at(first.span()));
    }
    let mut counts = words.next();
    if let Some(word) = counts.filter(|word| word.is("binary")) {
        return Err(MeshFault::Unsupported("this is binary OFF".to_owned()).at(word.span()));
    }
    if counts.is_none() {
        words = lines.expect("the numbers of corners and faces")?;
        counts = words.next();
    }
    let (corners, faces) = match counts {
        Some(word) => (
            word.count("the number of corners")?,
            words.expect("the number of faces")?.count("the number of faces")?,
        ),
        None => return Err(MeshFault::CutOff("the numbers of corners and faces".to_owned()).at(lines.end())),
    };
    let mut mesh = PolygonMesh::of("OFF");
    // Counts are not trusted with memory: the file ends where it ends.
    for _ in 0..corners {
        let mut words = lines.expect("a corner")?;
        mesh.add_point(point(&mut words)?);
    }
    let known = CornerNumbers::from_zero(mesh.points.len());
    let mut face = Vec::new();
    for _ in 0..faces {
        let mut words = lines.expect("a face")?;
        let word = words.expect("the number of a face's corners")?;
        let count = word.count("the number of a face's corners")?;
        face.clear();
        for _ in 0..count {
            let word = words.expect("the number of a corner")?;
            let index = word.integer("the number of a corner")?;
            face.push(known.corner(index).map_err(|fault| fault.at(word.span()))?);
        }
        if face.len() < 3 {
            return Err(MeshFault::FewCorners(face.len()).at(word.span()));
        }
        // What follows on the line is a colour.
        mesh.add_face(face.iter().copied()).map_err(|fault| fault.at(word.span()))?;
    }
    let rest = lines.count();
    if rest > 0 {
        mesh.notes.push(format!("{rest} lines behind the last face are ignored"));
    }
    Ok(mesh)
}

fn point(words: &mut MeshWords<'_>) -> Result<DVec3, MeshError> {
    let mut number = || words.expect("a coordinate")?.number("a coordinate");
    Ok(DVec3::new(number()?, number()?, number()?))
}
