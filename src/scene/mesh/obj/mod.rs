//! OBJ, the text format of Wavefront: corners, and faces that name them from the first or from the last.

mod materials;

use std::collections::HashMap;

use crate::math::DVec3;
use crate::scene::ReadOptions;

use super::fault::{MeshError, MeshFault};
use super::index::CornerNumbers;
use super::polygons::PolygonMesh;
use super::words::{MeshLines, MeshWord, MeshWords};
use materials::MaterialLibrary;

/// Statements that change nothing of what ray13 shows: texture and normals, smoothing, lines and points, how
/// other programs display, and curves.
const IGNORED: [&str; 34] = [
    "vt",
    "vn",
    "vp",
    "s",
    "l",
    "p",
    "lod",
    "mg",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "bevel",
    "c_interp",
    "d_interp",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "call",
    "csh",
    "ctech",
    "stech",
    "cdp",
];

/// Whether the bytes begin as a file of OBJ does: with a corner, a name, or a library of materials.
pub fn is_obj(bytes: &[u8]) -> bool {
    for mut words in MeshLines::continued(bytes) {
        let Some(first) = words.next() else { continue };
        let rest: Vec<_> = words.take(3).collect();
        match first.bytes {
            b"mtllib" | b"usemtl" => return !rest.is_empty(),
            b"v" => return rest.len() == 3 && rest.iter().all(|word| word.number("").is_ok()),
            b"vn" => return rest.len() == 3 && rest.iter().all(|word| word.number("").is_ok()),
            b"vt" => return rest.first().is_some_and(|word| word.number("").is_ok()),
            // A name, which other formats have too, or smoothing: what is next says more. NFF has spheres
            // `s`.
            b"o" | b"g" => {}
            b"s" if rest.len() == 1 => {}
            _ => return false,
        }
    }
    false
}

/// Reads a file. Its materials are looked for in the folder that the options name; nowhere without options.
pub fn read(bytes: &[u8], options: Option<&ReadOptions>) -> Result<PolygonMesh, MeshError> {
    let mut reader = Reader {
        mesh: PolygonMesh::of("OBJ"),
        groups: Groups::default(),
        library: MaterialLibrary::default(),
    };
    for mut words in MeshLines::continued(bytes) {
        if let Some(word) = words.next() {
            reader.statement(word, &mut words, options)?;
        }
    }
    reader.mesh.materials = reader.library.materials;
    reader.mesh.notes = reader.library.notes;
    Ok(reader.mesh)
}

/// The longest name that is kept, in bytes: that of an object is there once for each of its groups.
const LONGEST: usize = 100;

fn shortened(name: &[u8]) -> &[u8] {
    &name[..name.len().min(LONGEST)]
}

struct Reader {
    mesh: PolygonMesh,
    groups: Groups,
    library: MaterialLibrary,
}

/// What faces belong to.
#[derive(Default)]
struct Groups {
    object: Vec<u8>,
    group: Vec<u8>,
    /// By object and group: the index.
    known: HashMap<Vec<u8>, u32>,
    /// Whether a face that comes begins a run.
    is_new: bool,
}

impl Groups {
    /// The index of the group that is current.
    fn current(&mut self, mesh: &mut PolygonMesh) -> u32 {
        let blank: &[u8] = if self.object.is_empty() || self.group.is_empty() { b"" } else { b" " };
        let name = [&self.object[..], blank, &self.group[..]].concat();
        if name.is_empty() {
            return 0;
        }
        *self.known.entry(name).or_insert_with_key(|name| mesh.begin_group(name))
    }
}

impl Reader {
    fn statement(
        &mut self,
        word: MeshWord<'_>,
        words: &mut MeshWords<'_>,
        options: Option<&ReadOptions>,
    ) -> Result<(), MeshError> {
        match word.bytes {
            b"v" => {
                let mut number = || words.expect("a coordinate")?.number("a coordinate");
                let point = DVec3::new(number()?, number()?, number()?);
                self.mesh.add_point(point);
            }
            b"f" => self.face(word, words)?,
            b"o" => {
                self.groups.object = shortened(words.rest_of_line()).to_vec();
                self.groups.group.clear();
                self.groups.is_new = true;
            }
            b"g" => {
                self.groups.group = shortened(words.rest_of_line()).to_vec();
                self.groups.is_new = true;
            }
            b"usemtl" if options.is_some() => {
                self.library.choose(words.rest_of_line());
                self.groups.is_new = true;
            }
            b"mtllib" => options.into_iter().for_each(|it| self.library.load(words.rest_of_line(), it)),
            b"usemtl" => {}
            other => {
                if !IGNORED.iter().any(|ignored| ignored.as_bytes() == other) {
                    let wanted = "a statement of OBJ, such as `v`, `f` or `o`";
                    return Err(MeshFault::Unexpected(wanted.to_owned()).at(word.span()));
                }
            }
        }
        Ok(())
    }

    fn face(&mut self, statement: MeshWord<'_>, words: &mut MeshWords<'_>) -> Result<(), MeshError> {
        if self.groups.is_new {
            let group = self.groups.current(&mut self.mesh);
            self.mesh.begin_run(group, self.library.current);
            self.groups.is_new = false;
        }
        let known = CornerNumbers::from_one(self.mesh.points.len());
        let mut face = Vec::new();
        for word in words.filter(|word| word.bytes != b"\\") {
            // Behind slashes stand the corner's place in a texture, and its normal.
            let length = word.bytes.iter().position(|&byte| byte == b'/').unwrap_or(word.bytes.len());
            let index = MeshWord { bytes: &word.bytes[..length], ..word }.integer("the number of a corner");
            let index = index
                .map_err(|error| MeshError { place: MeshFault::Empty.at(word.span()).place, ..error })?;
            face.push(known.corner(index).map_err(|fault| fault.at(word.span()))?);
        }
        if face.len() < 3 {
            return Err(MeshFault::FewCorners(face.len()).at(statement.span()));
        }
        self.mesh.add_face(face).map_err(|fault| fault.at(statement.span()))
    }
}
