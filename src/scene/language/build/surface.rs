//! `surface`: the solid under the heights of a file.

use std::sync::Arc;

use super::Builder;
use super::arguments::BoundArguments;
use super::lost::Lost;
use crate::scene::heightmap::{HeightFile, Heightmap, NoHeights, OF_HEIGHT};
use crate::scene::language::nearest::quoted;
use crate::scene::memory::ASSEMBLED_TRIANGLE;
use crate::scene::profile::MOST_CORNERS;
use crate::scene::{Diagnostic, Shape};

impl Builder {
    pub(super) fn surface(&mut self, arguments: &BoundArguments<'_, '_>) -> Result<Shape, Lost> {
        let Some(name) = arguments.text("file", &mut self.sink)? else {
            return Err(arguments.missing("file", &mut self.sink));
        };
        let is_centred = arguments.flag("center", &mut self.sink)?;
        let is_inverted = arguments.flag("invert", &mut self.sink)?;
        let error = |why: &str| {
            let message = format!("`{}` gives no surface: {why}", quoted(name));
            Diagnostic::error(arguments.place_of("file"), message)
        };
        let refuse =
            |this: &mut Self, why: &str, lost: Lost| arguments.refuse(error(why), lost, &mut this.sink);
        let read = self.imports.files.find(name).and_then(|file| file.read());
        let bytes = read.map_err(|why| {
            let error = why.help().into_iter().fold(error(&why.to_string()), Diagnostic::help);
            arguments.refuse(error, Lost::Missing, &mut self.sink)
        })?;
        // A height has a corner above it, another in the middle of its cell, and four triangles around that.
        let room = self.memory.left().saturating_sub(bytes.len() as u64);
        let most = (room / (OF_HEIGHT + 4 * ASSEMBLED_TRIANGLE)).min((0.5 * MOST_CORNERS) as u64);
        let read = Heightmap::read(&bytes, is_inverted, most as usize);
        let HeightFile { map, ended_at } = read.map_err(|why| match why {
            NoHeights::TooLarge => refuse(self, "it has more heights than there is room for", Lost::Missing),
            NoHeights::Unreadable(why) => refuse(self, &why, Lost::Missing),
        })?;
        if let Some(line) = ended_at {
            let message =
                format!("`{}` is read up to its line {line}, where something is no number", quoted(name));
            self.sink.note(Diagnostic::note(arguments.place_of("file"), message));
        }
        let Some(mesh) = map.mesh(is_centred) else {
            return Err(refuse(self, "it has fewer than two rows of two numbers", Lost::Empty));
        };
        Ok(Shape::Mesh(Arc::new(mesh)))
    }
}
