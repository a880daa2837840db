//! `import` of drawings: plane figures.

use std::rc::Rc;

use super::Builder;
use super::arguments::BoundArguments;
use super::lost::Lost;
use super::pieces::Piece;
use crate::math::DVec3;
use crate::scene::drawing::{DrawingContent, DrawingFormat, DrawingRequest};
use crate::scene::language::nearest::quoted;
use crate::scene::named_files::NamedFile;
use crate::scene::profile::{Figure, FigureOperator, Fragments, combined, filled};
use crate::scene::{Diagnostic, FacetMode};

/// So many bytes of a drawing are read in the time of a step of the work that a scene may take.
const BYTES_OF_STEP: u64 = 64;

/// Fewer dots to the inch OpenSCAD does not take for what is meant.
const LEAST_DPI: f64 = 0.001;

/// The dots to the inch that it takes in place of those, and where none are given.
const USUAL_DPI: f64 = 72.0;

/// Steps that an outline's corner takes, until it is sorted out what is inside.
const STEPS_OF_CORNER: usize = 2;

impl Builder {
    /// The figure of a drawing, in its own coordinates.
    pub(super) fn drawing_file(
        &mut self,
        format: DrawingFormat,
        name: &str,
        arguments: &BoundArguments<'_, '_>,
        fragments: Fragments,
    ) -> Result<Piece, Lost> {
        let request = self.wanted_of_drawing(arguments, fragments)?;
        let file = self.file_to_import(name, arguments)?;
        let key = (file.path.clone(), format!("{request:?}"));
        let known = self.imports.figures.get(&key).cloned();
        let figure = if let Some(known) = known {
            known
        } else {
            let figure = self.read_drawing(format, name, &file, &request, arguments)?.map(Rc::new);
            self.imports.figures.insert(key, figure.clone());
            figure
        };
        figure.map(|figure| Piece::Figure(Figure::clone(&figure))).map_err(|why| {
            let message = format!("`{}` can not be imported: {why}", quoted(name));
            self.not_imported(Diagnostic::error(arguments.place_of("file"), message), arguments)
        })
    }

    fn wanted_of_drawing(
        &mut self,
        arguments: &BoundArguments<'_, '_>,
        fragments: Fragments,
    ) -> Result<DrawingRequest, Lost> {
        let sink = &mut self.sink;
        let layer = arguments.any_text("layer", sink)?.unwrap_or("").to_owned();
        let id = arguments.any_text("id", sink)?.unwrap_or("").to_owned();
        let origin = arguments.triple("origin", 0.0, sink)?.unwrap_or(DVec3::ZERO).truncate();
        let is_centred = arguments.flag("center", sink)?;
        let scale = self.number_or("scale", 1.0, |scale| scale > 0.0, arguments)?;
        let dpi = self.number_or("dpi", USUAL_DPI, |dpi| dpi >= LEAST_DPI, arguments)?;
        let is_on_grid = self.facet_mode == FacetMode::OpenScad;
        Ok(DrawingRequest { layer, id, origin, scale, fragments, is_on_grid, dpi, is_centred })
    }

    /// A number, or the usual one where it is not given, or is not fit.
    fn number_or(
        &mut self,
        name: &str,
        usual: f64,
        is_fit: impl Fn(f64) -> bool,
        arguments: &BoundArguments<'_, '_>,
    ) -> Result<f64, Lost> {
        let number = arguments.number(name, &mut self.sink)?.unwrap_or(usual);
        if is_fit(number) {
            return Ok(number);
        }
        let message = format!("a `{name}` of `import` that is too small is taken as {usual}, as in OpenSCAD");
        self.sink.note(Diagnostic::note(arguments.place_of(name), message));
        Ok(usual)
    }

    /// What is inside of the outlines of a drawing; or what is wrong with it.
    fn read_drawing(
        &mut self,
        format: DrawingFormat,
        name: &str,
        file: &NamedFile,
        request: &DrawingRequest,
        arguments: &BoundArguments<'_, '_>,
    ) -> Result<Result<Figure, String>, Lost> {
        let (bytes, _) = match self.bytes_to_import(name, file)? {
            Ok(bytes) => bytes,
            Err(why) => return Ok(Err(why)),
        };
        let too_much = || Ok(Err("what the scene imports would take too long to read".to_owned()));
        if self.work.spend((bytes.len() as u64 / BYTES_OF_STEP) as usize).is_err() {
            return too_much();
        }
        let drawing = match DrawingContent::read(&bytes, format, request) {
            Ok(drawing) => drawing,
            Err(fault) => return Ok(Err(fault.to_string())),
        };
        for note in &drawing.notes {
            let message = format!("`{}`: {note}", quoted(name));
            self.sink.note(Diagnostic::note(arguments.place_of("file"), message));
        }
        let count = drawing.shapes.iter().flatten().map(Vec::len).sum::<usize>();
        if self.work.spend(count.saturating_mul(STEPS_OF_CORNER)).is_err() {
            return too_much();
        }
        let figures =
            drawing.shapes.iter().map(|outlines| filled(outlines, 0.0)).collect::<Result<Vec<_>, _>>();
        let figure = figures.and_then(|figures| combined(FigureOperator::Union, &figures));
        let tangled = "its outlines are too dense, or cross too often, to be sorted out";
        Ok(figure.map_err(|_| tangled.to_owned()))
    }
}
