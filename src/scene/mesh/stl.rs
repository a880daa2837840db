//! STL: triangles that share nothing, in binary or as text.

use crate::math::DVec3;

use super::fault::{MeshError, MeshFault};
use super::polygons::PolygonMesh;
use super::weld::Welder;
use super::words::{MeshWord, MeshWords};

/// Bytes before the triangles: 80 of anything, and their number.
const HEADER: usize = 84;

/// Bytes of a triangle: a normal and three corners, each of three `f32`, and two bytes of anything.
const TRIANGLE: usize = 50;

/// Bytes of the normal, which the corners say better.
const NORMAL: usize = 12;

/// The number of triangles that a binary file says it has; none where it has no header.
pub fn announced(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEADER - 4..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes)
}

/// Whether the bytes are exactly as long as a binary file of their count: no text is, since no count that is
/// text is that small.
pub fn is_binary(bytes: &[u8]) -> bool {
    announced(bytes)
        .is_some_and(|count| bytes.len() as u64 == HEADER as u64 + TRIANGLE as u64 * u64::from(count))
}

/// Whether the bytes begin as the text of STL does.
pub fn is_text(bytes: &[u8]) -> bool {
    MeshWords::new(bytes, 0..bytes.len()).next().is_some_and(|word| word.is("solid"))
}

/// Reads a file of either kind. Names do not tell which: that of a binary one may begin with `solid`.
pub fn read(bytes: &[u8]) -> Result<PolygonMesh, MeshError> {
    // A header of text has no 0 in it; one that is filled up with blanks is followed by the count, which has.
    let has_zero = bytes[..bytes.len().min(HEADER)].contains(&0);
    if is_binary(bytes) || has_zero || !is_text(bytes) { read_binary(bytes) } else { read_text(bytes) }
}

fn read_binary(bytes: &[u8]) -> Result<PolygonMesh, MeshError> {
    let Some(count) = announced(bytes) else {
        let message = "the header of 80 bytes and the number of triangles";
        return Err(MeshFault::CutOff(message.to_owned()).at_byte(bytes.len(), "the header"));
    };
    let triangles = &bytes[HEADER..];
    let room = triangles.len() / TRIANGLE;
    if room < count as usize {
        return Err(MeshFault::TooShort { announced: count, room }.at_byte(HEADER - 4, "the header"));
    }
    let mut mesh = PolygonMesh::of("binary STL");
    let mut welder = Welder::new();
    // So many are there: the count is within the file's length.
    mesh.corners.reserve_exact(3 * count as usize);
    mesh.ends.reserve_exact(count as usize);
    for (index, triangle) in triangles.chunks_exact(TRIANGLE).take(count as usize).enumerate() {
        let mut corners = [0; 3];
        for (corner, number) in corners.iter_mut().enumerate() {
            let at = NORMAL + 12 * corner;
            let coordinate = |axis: usize| {
                let bytes = &triangle[at + 4 * axis..at + 4 * axis + 4];
                f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
            };
            let point = DVec3::new(coordinate(0), coordinate(1), coordinate(2));
            if !point.is_finite() {
                let fault = MeshFault::NotFinite("a coordinate of a corner".to_owned());
                let offset = HEADER + TRIANGLE * index + at;
                return Err(fault.at_byte(offset, format!("triangle {}", index + 1)));
            }
            *number = welder.number(point);
        }
        mesh.add_face(corners).map_err(MeshFault::of_all)?;
    }
    mesh.take_points(welder);
    let rest = triangles.len() - TRIANGLE * count as usize;
    if rest > 0 {
        mesh.notes.push(format!("{rest} bytes behind the last triangle are ignored"));
    }
    Ok(mesh)
}

fn read_text(bytes: &[u8]) -> Result<PolygonMesh, MeshError> {
    let mut words = MeshWords::new(bytes, 0..bytes.len());
    let mut mesh = PolygonMesh { groups: Vec::new(), ..PolygonMesh::of("text STL") };
    let mut welder = Welder::new();
    while let Some(word) = words.next() {
        keyword(word, "solid")?;
        let name = words.rest_of_line();
        let group = mesh.begin_group(name);
        mesh.begin_run(group, 0);
        if name.is_empty() {
            mesh.groups[group as usize] = None;
        }
        read_solid(&mut words, &mut mesh, &mut welder)?;
    }
    mesh.take_points(welder);
    Ok(mesh)
}

/// Reads the facets of a solid, and its end.
fn read_solid(
    words: &mut MeshWords<'_>,
    mesh: &mut PolygonMesh,
    welder: &mut Welder,
) -> Result<(), MeshError> {
    loop {
        let word = words.expect("`facet` or `endsolid`")?;
        if word.is("endsolid") || word.is("end") {
            words.rest_of_line();
            return Ok(());
        }
        if !word.is("facet") {
            return Err(MeshFault::Unexpected("`facet` or `endsolid`".to_owned()).at(word.span()));
        }
        keyword(words.expect("`normal`")?, "normal")?;
        // The corners say better where it is turned to; some programs write `nan`.
        for _ in 0..3 {
            words.expect("the normal of a facet")?;
        }
        keyword(words.expect("`outer`")?, "outer")?;
        keyword(words.expect("`loop`")?, "loop")?;
        let mut corners = [0; 3];
        for corner in &mut corners {
            keyword(words.expect("`vertex`")?, "vertex")?;
            let mut number = || words.expect("a coordinate")?.number("a coordinate");
            let point = DVec3::new(number()?, number()?, number()?);
            *corner = welder.number(point);
        }
        keyword(words.expect("`endloop`")?, "endloop")?;
        keyword(words.expect("`endfacet`")?, "endfacet")?;
        mesh.add_face(corners).map_err(MeshFault::of_all)?;
    }
}

fn keyword(word: MeshWord<'_>, wanted: &str) -> Result<(), MeshError> {
    if word.is(wanted) { Ok(()) } else { Err(MeshFault::Unexpected(format!("`{wanted}`")).at(word.span())) }
}
