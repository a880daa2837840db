//! Pictures of levels that are compared: read from a file, or drawn of a scene.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::frame::{Studio, Wants};
use crate::math::{Grid, Size};
use crate::output::{LevelsError, read_levels};
use crate::scene::{FilesRead, MAX_FILE_BYTES};
use crate::tone::Level;

use super::arguments::ComparisonArguments;
use super::error::{CliError, visible};
use super::input;
use super::picture::Unsized;
use super::still::{refuse_over_budget, say_nothing};
use super::waiting::Waiting;

/// A terminal's cells, of which a picture without a size has as many dots as they show.
const CELLS: Size = Size::new(80, 25);

impl ComparisonArguments {
    /// Reads a scene and says what was left out. `bytes` are what the file holds, where they are read
    /// already: a pipe is read once. All files that are read are noted.
    pub fn studio(&self, file: &str, bytes: Option<&[u8]>, files: &FilesRead) -> Result<Studio, CliError> {
        let scene = match bytes {
            Some(bytes) => input::read_bytes(file, bytes, &self.reading, files)?,
            None => input::read_noting(file, &self.reading, files)?,
        };
        input::say(&scene.notes);
        input::studio(scene)
    }

    /// Draws one view of a scene. Without a size of its own it has the dots of `like`, else those of a
    /// terminal of 80 × 25 cells: whatever the terminal here is like, since the picture is kept and compared.
    pub fn levels(
        &self,
        studio: &Studio,
        view: Option<&str>,
        like: Option<Size>,
    ) -> Result<Grid<Level>, CliError> {
        let mut picture = self.picture.clone();
        if let Some(view) = view {
            picture.camera.view = Some(view.to_owned());
        }
        let look = picture.look(None);
        if picture.dots.is_none() && picture.cells.is_none() && picture.preset.is_none() {
            let per_cell = look.glyphs.dots_per_cell();
            match like {
                None => picture.cells = Some(CELLS),
                Some(dots) if dots.width % per_cell.width == 0 && dots.height % per_cell.height == 0 => {
                    picture.cells =
                        Some(Size::new(dots.width / per_cell.width, dots.height / per_cell.height));
                }
                dots => picture.dots = dots,
            }
        }
        let request = picture.request(studio, look, Wants::LIGHT, Unsized::Screen)?;
        let frame = studio.draw(&request);
        refuse_over_budget(&frame)?;
        say_nothing(&frame);
        Ok(frame.levels(request.tone))
    }
}

/// The dots of a picture across and down, as people write them.
pub fn dots(levels: &Grid<Level>) -> String {
    format!("{} × {}", levels.size().width, levels.size().height)
}

/// What a name stands for that is compared.
pub enum Source {
    /// A picture of levels.
    Levels(Grid<Level>),
    /// Something else, as a scene, with the bytes of the file.
    Bytes(Vec<u8>),
    /// No file that can be read: standard input, a scene inside the program, or nothing.
    Name,
}

/// What a name stands for. A file whose name ends in `.levels` has to be there and to hold a picture.
pub fn read(file: &str) -> Result<Source, CliError> {
    if file == "-" {
        return Ok(Source::Name);
    }
    let is_named = Path::new(file).extension().is_some_and(|ending| ending == "levels");
    let failed = |e: &dyn std::fmt::Display| CliError::Input(format!("{}: {e}", visible(file)));
    let _waiting = Waiting::new(file);
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|source| source.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes));
    match read {
        Err(e) if is_named => return Err(failed(&e)),
        Err(_) => return Ok(Source::Name),
        Ok(_) if bytes.len() as u64 > MAX_FILE_BYTES => {
            return Err(failed(&format!("it is larger than {MAX_FILE_BYTES} bytes")));
        }
        Ok(_) => {}
    }
    match read_levels(&bytes) {
        Ok(levels) => Ok(Source::Levels(levels)),
        Err(LevelsError::Character { .. } | LevelsError::Empty) if !is_named => Ok(Source::Bytes(bytes)),
        Err(e) => Err(failed(&e)),
    }
}
