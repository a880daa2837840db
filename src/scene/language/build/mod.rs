//! The syntax tree to the [`Scene`]: every word gets its meaning.

mod arguments;
mod chain;
mod colors;
mod degrees;
mod facets;
mod maps;
mod materials;
mod operators;
mod polyhedron;
mod solids;
mod views;

use std::collections::HashSet;

use super::nearest::quoted;
use super::syntax::{Argument, Call, File, Value};
use super::vocabulary::{Known, Meaning, Word, look_up, nearest_word};
use crate::scene::diagnostic::{Reported, Sink};
use crate::scene::{Diagnostic, ReadOptions, Scene};
use arguments::{Arguments, setting};
use chain::Chain;
use facets::Polygons;
use materials::{Surface, Surfaces};
use polyhedron::EarClipper;

/// Builds the scene of a file. Errors go to `sink`; the scene is whole where there is none.
pub fn build(file: &File<'_>, options: &ReadOptions, sink: &mut Sink) -> Scene {
    let mut builder = Builder {
        sink,
        skip_unsupported: options.skip_unsupported,
        scene: Scene::default(),
        surfaces: Surfaces::default(),
        view_names: HashSet::new(),
        has_world: false,
        polygons: Polygons::default(),
        clipper: EarClipper::default(),
    };
    builder.file(file);
    Scene { materials: builder.surfaces.table(), ..builder.scene }
}

/// What the words above hand down to a word.
#[derive(Clone, Debug)]
struct Context {
    /// From the word's coordinates to the world's.
    maps: Chain,
    surface: Surface,
    /// `$fn`: how many sides stand for a circle, where they are few.
    fragments: f64,
}

struct Builder<'s> {
    sink: &'s mut Sink,
    skip_unsupported: bool,
    scene: Scene,
    surfaces: Surfaces,
    view_names: HashSet<String>,
    has_world: bool,
    polygons: Polygons,
    clipper: EarClipper,
}

impl Builder<'_> {
    fn file(&mut self, file: &File<'_>) {
        let context =
            Context { maps: Chain::default(), surface: Surface::default(), fragments: self.settings(file) };
        // Definitions first: a material may be applied above the line that defines it.
        for call in &file.calls {
            if is_definition(call) && self.is_present(call) {
                // What is wrong has gone to the sink; the other definitions are looked at, too.
                let _ = self.define(call);
            }
        }
        let root = file.calls.iter().find_map(|call| root(call, &context));
        match root {
            // As in OpenSCAD: what stands above the root has no effect on it.
            Some((call, context)) => self.open(std::slice::from_ref(call), &context),
            None => {
                for call in file.calls.iter().filter(|call| !is_definition(call)) {
                    self.open(std::slice::from_ref(call), &context);
                }
            }
        }
        if self.scene.objects.is_empty() && self.sink.is_clean() {
            let error = Diagnostic::error(0..0, "the scene is empty: there is nothing to see in it");
            self.sink.report(error.help("add a solid, such as `sphere(1);`"));
        }
    }

    /// `$fn` of the whole file: the last assignment counts, as in OpenSCAD.
    fn settings(&mut self, file: &File<'_>) -> f64 {
        let mut fragments = 0.0;
        for (name, value) in &file.assignments {
            if let Ok(number) = setting(name.text, name.span, value, self.sink)
                && name.text == "$fn"
            {
                fragments = number.unwrap_or(0.0);
            }
        }
        fragments
    }

    fn define(&mut self, call: &Call<'_>) -> Result<(), Reported> {
        let Some(word) = self.word(call) else { return Err(Reported) };
        if let Some(child) = call.children.first() {
            let error = Diagnostic::error(child.name.span, format!("`{}` takes no children", word.name));
            return Err(self.sink.report(error.help(format!("end `{}(…)` with a `;`", word.name))));
        }
        let arguments = Arguments::bind(call, word, self.sink)?;
        match word.meaning {
            Meaning::Camera => self.camera(&arguments),
            Meaning::Light => self.light(&arguments),
            Meaning::World => self.world(call, &arguments),
            _ => self.surfaces.define(&arguments, self.sink),
        }
    }

    /// The word of a call; what is none is reported, or noted where it may be left out.
    fn word(&mut self, call: &Call<'_>) -> Option<&'static Word> {
        let (name, span) = (quoted(call.name.text), call.name.span);
        match look_up(call.name.text) {
            Known::Word(word) => return Some(word),
            Known::Unsupported(why) if self.skip_unsupported => {
                self.sink.note(Diagnostic::note(span, format!("`{name}` is left out: {why}")));
            }
            Known::Unsupported(why) => {
                let error = Diagnostic::error(span, format!("`{name}` can not be shown: {why}"));
                self.sink.report(error.help("--skip-unsupported shows the rest of the scene"));
            }
            Known::Unknown => {
                let error = Diagnostic::error(span, format!("there is no word `{name}`"));
                self.sink.report(match nearest_word(call.name.text) {
                    Some(right) => error.help(format!("did you mean `{right}`?")),
                    None => error.help("docs/scene-language.md has all words; modules are OpenSCAD's work"),
                });
            }
        }
        None
    }
}

/// Whether a call at the top level is no solid: a view, a light, the world, or a material with a name.
fn is_definition(call: &Call<'_>) -> bool {
    match look_up(call.name.text) {
        Known::Word(word) => match word.meaning {
            Meaning::Camera | Meaning::Light | Meaning::World => true,
            Meaning::Material => call.children.is_empty(),
            _ => false,
        },
        _ => false,
    }
}

/// The first call marked `!`, with the settings that reach it.
fn root<'c, 'a>(call: &'c Call<'a>, above: &Context) -> Option<(&'c Call<'a>, Context)> {
    if call.modifiers.disable || is_definition(call) {
        return None;
    }
    if call.modifiers.root {
        return Some((call, above.clone()));
    }
    let own = |argument: &&Argument<'_>| argument.name.is_some_and(|name| name.text == "$fn");
    let fragments = match call.arguments.iter().find(own).map(|argument| &argument.value.value) {
        Some(Value::Number(number)) => *number,
        _ => above.fragments,
    };
    let inner = Context { fragments, ..above.clone() };
    call.children.iter().find_map(|child| root(child, &inner))
}
