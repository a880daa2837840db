//! The scene language: the grammar of OpenSCAD's `.csg` files, and a few words for what OpenSCAD lacks.
//!
//! Text → tokens ([`lexer`]) → syntax tree with places ([`parser`], [`syntax`]) → scene ([`build`]), which
//! knows its words from one table ([`vocabulary`]). `docs/scene-language.md` describes it for people.

mod build;
mod css_colors;
mod lexer;
mod nearest;
mod parser;
mod reference;
mod syntax;
mod vocabulary;
mod words;

#[cfg(test)]
mod tests;

pub use reference::reference;

use super::diagnostic::Sink;
use super::{Diagnostics, ReadOptions, Scene};

/// Reads a scene. `text` must be no longer than [`super::MAX_FILE_BYTES`]: places are kept in 32 bits.
pub(super) fn read(name: &str, text: &str, options: &ReadOptions) -> Result<Scene, Diagnostics> {
    let mut sink = Sink::default();
    let mut scene = Scene::default();
    if let Ok(file) = parser::parse(text, &mut sink)
        && sink.is_clean()
    {
        scene = build::build(&file, options, &mut sink);
    }
    scene.notes = sink.finish(name, text)?;
    Ok(scene)
}
