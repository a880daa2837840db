//! Events to the [`Scene`]: every word gets its meaning as it is read.

mod arguments;
mod chain;
mod colors;
mod context;
mod definitions;
mod drawings;
mod facets;
mod figures;
mod flush;
mod form;
mod forms;
mod frame;
mod frames;
mod import;
mod imports;
mod letters;
mod lists;
mod lost;
mod made;
mod maps;
mod materials;
mod operators;
mod origin;
mod patches;
mod pieces;
mod polyhedron;
mod printed;
mod six_digits;
mod solids;
mod surface;
mod survey;
mod views;

use std::collections::HashSet;
use std::rc::Rc;

use super::dictionary::{Known, look_up, nearest_word};
use super::nearest::quoted;
use super::syntax::{Call, SyntaxEvent};
use super::vocabulary::Word;
use crate::scene::diagnostic::Sink;
use crate::scene::lettering::FontLibrary;
use crate::scene::memory::Memory;
use crate::scene::profile::WorkLeft;
use crate::scene::triangulation::EarClipper;
use crate::scene::{Diagnostic, Digits, FacetMode, ReadOptions, Scene, Solid};
use context::Context;
use facets::Polygons;
use frame::OpenCall;
use imports::Imports;
use materials::Surfaces;
use pieces::Piece;
use printed::PrintedPrimitives;
use survey::{Survey, is_definition};

/// Whether to read on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    On,
    /// Nothing that comes would change anything.
    Done,
    /// What was read means something else by what was found just now: a survey is needed.
    Again,
}

/// Builds a scene from events. Errors go to `sink`; the scene is whole where there is none.
pub struct Builder {
    pub sink: Sink,
    pub memory: Memory,
    skip_unsupported: bool,
    facet_mode: FacetMode,
    digits: Digits,
    printed: PrintedPrimitives,
    scene: Scene,
    surfaces: Surfaces,
    view_names: HashSet<String>,
    has_world: bool,
    polygons: Polygons,
    clipper: EarClipper,
    imports: Imports,
    fonts: FontLibrary,
    work: WorkLeft,
    /// What is known of the whole file.
    survey: Survey,
    /// The calls that are open, the outermost first; below them all the scene itself.
    frames: Vec<OpenCall>,
    /// The solids that wait for their operators, in file order.
    solids: Vec<Solid>,
    /// The facets that wait for what is made of them, in file order.
    pieces: Vec<Piece>,
    /// How many of the open calls, the innermost ones, are passed over.
    passed_over: usize,
    is_out_of_memory: bool,
}

impl Builder {
    pub fn new(options: &ReadOptions, digits: Digits, sink: Sink, memory: Memory) -> Self {
        Self {
            sink,
            memory,
            skip_unsupported: options.skip_unsupported,
            facet_mode: options.facets,
            digits,
            printed: PrintedPrimitives::default(),
            scene: Scene::default(),
            surfaces: Surfaces::default(),
            view_names: HashSet::new(),
            has_world: false,
            polygons: Polygons::default(),
            clipper: EarClipper::default(),
            imports: Imports::new(options),
            fonts: FontLibrary::new(options.fonts.clone()),
            work: WorkLeft::default(),
            survey: Survey::default(),
            frames: vec![OpenCall::scene(Rc::new(Context::default()))],
            solids: Vec::new(),
            pieces: Vec::new(),
            passed_over: 0,
            is_out_of_memory: false,
        }
    }

    /// Takes an event, as if the text had neither definitions nor assignments nor a root, or with what a
    /// survey found of them.
    pub fn take(&mut self, event: &SyntaxEvent<'_>) -> Flow {
        match event {
            SyntaxEvent::Assignment(..) if self.survey.is_done() => {}
            SyntaxEvent::Assignment(..) => return Flow::Again,
            SyntaxEvent::Close => {
                self.close();
                if self.survey.ends_with(self.frames.len()) {
                    return Flow::Done;
                }
            }
            SyntaxEvent::Open(call) => return self.open(call),
        }
        Flow::On
    }

    fn open(&mut self, call: &Call<'_>) -> Flow {
        if self.passed_over > 0 {
            // A root may stand in what is left out for another reason than a `*`: a survey finds out.
            if self.survey.is_needed_for(call, false) {
                return Flow::Again;
            }
            self.pass_over(call);
            return Flow::On;
        }
        if let Some(fragments) = self.survey.seek(call) {
            match fragments {
                survey::Found::Above => return Flow::On,
                // As in OpenSCAD: what stands above the root has no effect on it, but for `$fn`.
                survey::Found::Root(fragments) => {
                    self.begin(fragments);
                }
            }
        } else if self.survey.is_needed_for(call, self.frames.len() == 1) {
            return Flow::Again;
        }
        if self.frames.len() == 1 && is_definition(call) {
            self.pass_over(call);
        } else {
            self.child(call);
        }
        let is_at_an_end = self.sink.is_full() || self.is_out_of_memory;
        let is_all = self.passed_over == 0 && self.survey.ends_with(self.frames.len());
        if is_at_an_end || is_all { Flow::Done } else { Flow::On }
    }

    /// Passes over a call and its children.
    fn pass_over(&mut self, call: &Call<'_>) {
        self.passed_over += usize::from(!call.is_ended);
    }

    /// What was built.
    pub fn finish(mut self) -> (Scene, Sink) {
        if self.scene.objects.is_empty() && self.sink.is_clean() {
            self.sink.report(empty(&self.sink));
        }
        self.scene.objects.shrink_to_fit();
        self.flush();
        (Scene { materials: self.surfaces.table(), ..self.scene }, self.sink)
    }

    /// The word of a call; what is none is reported, or noted where it may be left out.
    fn word(&mut self, call: &Call<'_>) -> Option<&'static Word> {
        // Made only where something is said: most words are known, and files have millions.
        let (name, span) = (|| quoted(call.name.text), call.name.span);
        match look_up(call.name.text) {
            Known::Word(word) => return Some(word),
            Known::Unsupported(why) if self.skip_unsupported => {
                self.sink.note(Diagnostic::note(span, format!("`{}` is left out: {why}", name())));
            }
            Known::Unsupported(why) => {
                let error = Diagnostic::error(span, format!("`{}` can not be shown: {why}", name()));
                self.sink.report(error.help("--skip-unsupported shows the rest of the scene"));
            }
            Known::Unknown => {
                let error = Diagnostic::error(span, format!("there is no word `{}`", name()));
                self.sink.report(match nearest_word(call.name.text) {
                    Some(right) => error.help(format!("did you mean `{right}`?")),
                    None => error.help("docs/scene-language.md has all words; modules are OpenSCAD's work"),
                });
            }
        }
        None
    }
}

/// The error of a scene in which nothing is left, with the first cause of that.
fn empty(sink: &Sink) -> Diagnostic {
    match sink.first_note() {
        None => Diagnostic::error(0..0, "the scene is empty: there is nothing to see in it")
            .help("add a solid, such as `sphere(1);`"),
        Some((first, count)) => {
            let error = Diagnostic::error(0..0, "the scene is empty: nothing is left to see in it");
            let more = match count {
                1 => String::new(),
                _ => format!("; this and {} more remarks say what became of its parts", count - 1),
            };
            error.help(format!("{}{more}", first.message))
        }
    }
}
