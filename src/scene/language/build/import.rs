//! `import`: what another file has in it.

use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use super::Builder;
use super::arguments::BoundArguments;
use super::context::{Context, FormSpace};
use super::lost::Lost;
use super::origin::Origin;
use super::pieces::{Made, Piece, united};
use crate::math::DAffine3;
use crate::scene::drawing::DrawingFormat;
use crate::scene::language::nearest::quoted;
use crate::scene::language::syntax::Call;
use crate::scene::language::vocabulary::Word;
use crate::scene::memory::ASSEMBLED_OPERATOR;
use crate::scene::mesh::{self, MeshSolids, NoSolids};
use crate::scene::named_files::NamedFile;
use crate::scene::profile::Fragments;
use crate::scene::{Diagnostic, Format, MaterialId, Mesh, MeshFacts, Primitive, Shape, Solid, content, gzip};

/// What a file is to `import`.
enum Kind {
    /// Something solid, which its content says.
    Mesh,
    /// A plane figure.
    Drawing(DrawingFormat),
}

impl Kind {
    /// That of a file by its name, as OpenSCAD decides.
    fn of(name: &str) -> Self {
        let ending = Path::new(name).extension().unwrap_or_default();
        let formats = [("dxf", DrawingFormat::Dxf), ("svg", DrawingFormat::Svg)];
        let drawing = formats.into_iter().find(|(name, _)| ending.eq_ignore_ascii_case(name));
        drawing.map_or(Self::Mesh, |(_, format)| Self::Drawing(format))
    }
}

/// Bytes that solids hold while the scene is read, whatever is made of them.
fn held(solids: &MeshSolids) -> u64 {
    let of = |mesh: &Arc<Mesh>| {
        size_of_val(mesh.points.as_slice()) + size_of_val(mesh.triangles.as_slice()) + size_of::<Mesh>()
    };
    solids.parts.iter().map(of).sum::<usize>() as u64
}

impl Builder {
    /// What an `import` is to the call that holds it.
    pub(super) fn import(
        &mut self,
        word: &'static Word,
        call: &Call<'_>,
        context: &Context,
    ) -> Result<Made, Lost> {
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
        let origin = Origin::of(word, call);
        let fragments = arguments.fragments(context.fragments);
        let piece = self.imported(&arguments, fragments)?;
        if context.space == FormSpace::Faceted {
            return self.placed_piece(piece, context, origin).map(Made::Piece);
        }
        self.shown(piece, context, origin).map(Made::Solid)
    }

    /// What a file has in it, in the file's own coordinates.
    fn imported(&mut self, arguments: &BoundArguments<'_, '_>, fragments: Fragments) -> Result<Piece, Lost> {
        let Some(name) = arguments.text("file", &mut self.sink)? else {
            return Err(arguments.missing("file", &mut self.sink));
        };
        match Kind::of(name) {
            Kind::Drawing(format) => self.drawing_file(format, name, arguments, fragments),
            Kind::Mesh => self.mesh_file(name, arguments),
        }
    }

    fn mesh_file(&mut self, name: &str, arguments: &BoundArguments<'_, '_>) -> Result<Piece, Lost> {
        self.note_what_is_of_drawings(arguments)?;
        let place = arguments.place_of("file");
        let shown = quoted(name);
        let file = self.file_to_import(name, arguments)?;
        let known = self.imports.known.get(&file.path).cloned();
        let solids = if let Some(known) = known {
            known
        } else {
            let solids = self.read_mesh(name, &file)?.map(Rc::new);
            self.imports.known.insert(file.path, solids.clone());
            if let Ok(solids) = &solids {
                self.memory.take(held(solids));
                self.tell_of(name, solids, arguments);
            }
            solids
        };
        let solids = solids.map_err(|why| {
            let error = Diagnostic::error(place, format!("`{shown}` can not be imported: {why}"));
            self.not_imported(error, arguments)
        })?;
        if solids.parts.len() > 1 {
            self.memory.take(ASSEMBLED_OPERATOR);
        }
        let part = |mesh: &Arc<Mesh>| {
            Solid::Primitive(Primitive::new(Shape::Mesh(Arc::clone(mesh)), DAffine3::IDENTITY, MaterialId(0)))
        };
        Ok(Piece::Solid(united(solids.parts.iter().map(part).collect())))
    }

    /// The solids of a file, or what is wrong with it.
    fn read_mesh(&mut self, name: &str, file: &NamedFile) -> Result<Result<MeshSolids, String>, Lost> {
        let (bytes, name) = match self.bytes_to_import(name, file)? {
            Ok(bytes) => bytes,
            Err(why) => return Ok(Err(why)),
        };
        let known = mesh::format_of(&bytes);
        if let (None, Some(what)) = (known, content::binary(&bytes)) {
            return Ok(Err(format!("it is {what}, not a mesh")));
        }
        let format = known.unwrap_or_else(|| Format::of(name));
        match mesh::solids(&bytes, format, self.memory.left()) {
            Ok(solids) => Ok(Ok(solids)),
            Err(NoSolids::Wrong(why)) => Ok(Err(why)),
            Err(NoSolids::NoMesh) => {
                Ok(Err("it is no mesh: STL, OFF, PLY, OBJ, 3MF and AMF are read, and drawings by their names: DXF and SVG".to_owned()))
            }
            Err(NoSolids::NoRoom(needed)) => Err(self.no_room_to_read(needed)),
        }
    }

    fn no_room_to_read(&mut self, bytes: u64) -> Lost {
        self.is_out_of_memory = true;
        self.memory.refuse_last(bytes, &mut self.sink).into()
    }

    /// Tells what a file that was read is.
    fn tell_of(&mut self, name: &str, solids: &MeshSolids, arguments: &BoundArguments<'_, '_>) {
        for note in &solids.notes {
            let message = format!("`{}`: {note}", quoted(name));
            self.sink.note(Diagnostic::note(arguments.place_of("file"), message));
        }
        self.scene.meshes.extend(solids.facts.iter().map(|facts| {
            let part = facts.name.as_ref().map(|part| format!(" {part}")).unwrap_or_default();
            MeshFacts { name: Some(format!("{name}{part}")), ..facts.clone() }
        }));
    }

    /// OpenSCAD scales and moves drawings by these, and no meshes, which is not what it looks like.
    fn note_what_is_of_drawings(&mut self, arguments: &BoundArguments<'_, '_>) -> Result<(), Lost> {
        let is_scaled = arguments.number("scale", &mut self.sink)?.is_some_and(|scale| scale != 1.0);
        let is_centred = arguments.flag("center", &mut self.sink)?;
        for (name, is_set) in [("scale", is_scaled), ("center", is_centred)] {
            if is_set {
                let message = format!("`{name}` of `import` has no effect on a mesh, as in OpenSCAD");
                self.sink.note(Diagnostic::note(arguments.place_of(name), message));
            }
        }
        Ok(())
    }

    /// Finds a file that may be read.
    pub(super) fn file_to_import(
        &mut self,
        name: &str,
        arguments: &BoundArguments<'_, '_>,
    ) -> Result<NamedFile, Lost> {
        self.imports.files.find(name).map_err(|why| {
            let error = Diagnostic::error(
                arguments.place_of("file"),
                format!("`{}` can not be imported: {why}", quoted(name)),
            );
            let error = why.help().into_iter().fold(error, Diagnostic::help);
            self.not_imported(error, arguments)
        })
    }

    /// The bytes of a file, unpacked, and its name as such; or what is wrong with it.
    pub(super) fn bytes_to_import<'n>(
        &mut self,
        name: &'n str,
        file: &NamedFile,
    ) -> Result<Result<(Vec<u8>, &'n str), String>, Lost> {
        if !self.memory.has_room_for(file.length) {
            return Err(self.no_room_to_read(file.length));
        }
        let bytes = match file.read() {
            Ok(bytes) => bytes,
            Err(why) => return Ok(Err(why.to_string())),
        };
        if !gzip::is_gzip(&bytes) {
            return Ok(Ok((bytes, name)));
        }
        let inner = gzip::unpacked(&bytes, Some(self.memory.left()));
        Ok(inner.map(|inner| (inner, gzip::inner_name(name))).map_err(|error| error.message))
    }

    /// The error of a file that is not there, or is not what it should be.
    pub(super) fn not_imported(&mut self, error: Diagnostic, arguments: &BoundArguments<'_, '_>) -> Lost {
        arguments.refuse(error, Lost::Missing, &mut self.sink)
    }
}
