//! The scene language: the grammar of OpenSCAD's `.csg` files, and a few words for what OpenSCAD lacks.
//!
//! Text → tokens ([`lexer`]) → events with places ([`parser`], [`syntax`]) → scene ([`build`]), which knows
//! its words from one table ([`vocabulary`]). Each event is used as it comes, so that no tree of the text is
//! ever in memory. `docs/scene-language.md` describes the language for people.

mod build;
mod css_colors;
mod dictionary;
mod lexer;
mod nearest;
mod parser;
mod reference;
mod syntax;
mod vocabulary;
mod words;

#[cfg(test)]
mod tests;

use std::path::Path;

pub use nearest::nearest;
pub use reference::reference;

use super::diagnostic::{Reported, Sink};
use super::memory::Memory;
use super::options::ReadOptions;
use super::{Diagnostics, Digits, Scene};
use crate::stage::{Progress, Task};
use build::{Builder, Flow};
use parser::{Parser, Reading};
use syntax::SyntaxEvent;

/// Reads a scene. `text` must be no longer than [`super::MAX_FILE_BYTES`]: places are kept in 32 bits.
pub(super) fn read(name: &str, text: &str, options: &ReadOptions) -> Result<Scene, Diagnostics> {
    let leaves_out = options.skip_unsupported || is_from_a_program(name, text);
    let digits =
        options.digits.unwrap_or(if is_from_a_program(name, text) { Digits::Six } else { Digits::Exact });
    let builder =
        || Builder::new(options, digits, Sink::new(leaves_out), Memory::new(options.memory, text.len()));
    let mut built = builder();
    let mut grammar = Sink::new(leaves_out);
    let progress = options.progress.as_ref();
    if let Ok(Flow::Again) = each(text, progress, &mut built, &mut grammar, Builder::take) {
        built = builder();
        grammar = Sink::new(leaves_out);
        if each(text, progress, &mut built, &mut grammar, Builder::survey).is_ok() && grammar.is_clean() {
            built.surveyed();
            let _ = each(text, progress, &mut built, &mut Sink::new(leaves_out), Builder::take);
        }
    }
    if !grammar.is_clean() {
        // What was built up to a mistake of the grammar is of no account.
        grammar.finish(name, text)?;
    }
    let (mut scene, sink) = built.finish();
    let mut notes = sink.finish(name, text)?;
    notes.append(&mut scene.notes);
    scene.notes = notes;
    Ok(scene)
}

/// Gives each event of a text to `f`, until that has enough; mistakes of the grammar go to `grammar`.
fn each(
    text: &str,
    progress: Option<&Progress>,
    builder: &mut Builder,
    grammar: &mut Sink,
    f: impl Fn(&mut Builder, &SyntaxEvent<'_>) -> Flow,
) -> Result<Flow, Reported> {
    if let Some(progress) = progress {
        progress.begin(Task::Reading, text.len() as u64);
    }
    let mut parser = Parser::new(text);
    loop {
        let mut reading = Reading { sink: &mut *grammar, memory: &mut builder.memory };
        let Some(event) = parser.next(&mut reading)? else { return Ok(Flow::On) };
        match f(builder, &event) {
            Flow::On => {}
            flow => return Ok(flow),
        }
        if let SyntaxEvent::Open(call) = event {
            if let Some(progress) = progress {
                progress.reach(u64::from(call.name.span.start));
            }
            parser.recycle(call);
        }
    }
}

/// Whether a program wrote the text, so that wrong parts are left out: what ends in `.csg` does, and what has
/// no ending, as standard input has none, where it names the settings that OpenSCAD gives to every round
/// solid.
fn is_from_a_program(name: &str, text: &str) -> bool {
    match Path::new(name).extension() {
        Some(extension) => extension.eq_ignore_ascii_case("csg"),
        None => [", $fa = ", ", $fs = "].iter().all(|given| text.contains(given)),
    }
}
