//! A first reading of a text for what may stand below its uses: definitions, `$fn` of the whole file, and a root (`!`).
//!
//! Most long files have none of them, because a program wrote them: they are read once, and again only where the first
//! of them turns up.

use super::arguments::{Arguments, setting};
use super::{Builder, Flow, is_definition};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::Reported;
use crate::scene::language::syntax::{Call, Event, Value};
use crate::scene::language::vocabulary::{Known, Meaning, Word, look_up};

/// What is known of a whole file.
#[derive(Debug, Default)]
pub struct Survey {
    is_done: bool,
    /// `$fn` of the whole file: the last assignment counts, as in OpenSCAD.
    fragments: f64,
    /// Where the first call marked `!` has its name.
    root: Option<u32>,
    /// While the root is looked for: `$fn` at each of the open calls.
    above: Vec<f64>,
    is_root_found: bool,
    /// While surveying: how many calls are open.
    depth: usize,
    /// While surveying: the definition that is open, which takes no children.
    definition: Option<&'static str>,
}

/// What a call is on the way to the root.
pub enum Found {
    /// Not the root.
    Above,
    /// The root, which has this `$fn`.
    Root(f64),
}

impl Survey {
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Whether a survey must be made before this call can be built.
    pub fn is_needed_for(&self, call: &Call<'_>, is_at_top: bool) -> bool {
        !self.is_done
            && !call.modifiers.disable
            && (call.modifiers.root || (is_at_top && is_definition(call)))
    }

    /// Whether all that counts is read once so many frames are left: the root, where there is one.
    pub fn ends_with(&self, frames: usize) -> bool {
        self.is_root_found && frames == 1
    }

    /// Looks for the root; none where there is none to be looked for, or no longer.
    pub fn seek(&mut self, call: &Call<'_>) -> Option<Found> {
        let root = self.root.filter(|_| !self.is_root_found)?;
        let fragments = self.above.last().copied().unwrap_or(self.fragments);
        if call.name.span.start == root {
            self.is_root_found = true;
            return Some(Found::Root(fragments));
        }
        if !call.is_ended {
            let own = call.arguments.iter().find(|a| a.name.is_some_and(|name| name.text == "$fn"));
            self.above.push(match own.map(|argument| &argument.value.value) {
                Some(Value::Number(number)) => *number,
                _ => fragments,
            });
        }
        Some(Found::Above)
    }

    /// A call on the way to the root ends; false where there is no such way.
    pub fn leave(&mut self) -> bool {
        let is_seeking = self.root.is_some() && !self.is_root_found;
        if is_seeking {
            self.above.pop();
        }
        is_seeking
    }
}

impl Builder {
    /// Takes an event of the survey.
    pub fn survey(&mut self, event: &Event<'_>) -> Flow {
        match event {
            Event::Assignment(name, value) => {
                if let Ok(number) = setting(name.text, name.span, value, &mut self.sink)
                    && name.text == "$fn"
                {
                    self.survey.fragments = number.unwrap_or(0.0);
                }
            }
            Event::Close => {
                self.survey.depth -= usize::from(self.survey.depth > 0);
                self.passed_over = self.passed_over.saturating_sub(1);
                if self.survey.depth == 0 {
                    self.survey.definition = None;
                }
            }
            Event::Open(call) => {
                self.survey_call(call);
                self.survey.depth += usize::from(!call.is_ended);
            }
        }
        if self.sink.is_full() || self.is_out_of_memory { Flow::Done } else { Flow::On }
    }

    fn survey_call(&mut self, call: &Call<'_>) {
        if let Some(name) = self.survey.definition.take() {
            self.no_children(name, call);
        }
        if self.passed_over > 0 || call.modifiers.disable {
            self.pass_over(call);
        } else if is_definition(call) {
            if self.survey.depth == 0
                && self.is_present(call)
                && let Known::Word(word) = look_up(call.name.text)
            {
                // What is wrong has gone to the sink; the other definitions are looked at, too.
                let _ = self.define(call, word);
                if !self.memory.has_room_for(0) {
                    let _ = self.no_room(0, call);
                }
                self.survey.definition = (!call.is_ended).then_some(word.name);
            }
            self.pass_over(call);
        } else if call.modifiers.root && self.survey.root.is_none() {
            self.survey.root = Some(call.name.span.start);
        }
    }

    fn define(&mut self, call: &Call<'_>, word: &'static Word) -> Result<(), Reported> {
        let arguments = Arguments::bind(call, word, &mut self.sink)?;
        match word.meaning {
            Meaning::Camera => self.camera(&arguments),
            Meaning::Light => self.light(&arguments),
            Meaning::World => self.world(call, &arguments),
            _ => self.surfaces.define(&arguments, &mut self.sink),
        }
    }

    /// The error of a child where there may be none.
    pub(super) fn no_children(&mut self, name: &str, child: &Call<'_>) {
        let error = Diagnostic::error(child.name.span, format!("`{name}` takes no children"));
        self.sink.report(error.help(format!("end `{name}(…)` with a `;`")));
    }

    /// Makes what the survey found known to what is built.
    pub fn surveyed(&mut self) {
        self.survey.is_done = true;
        self.passed_over = 0;
        let fragments = self.survey.fragments;
        self.begin(fragments);
    }
}
