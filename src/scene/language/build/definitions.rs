//! The first reading of a text: takes its definitions, and finds its root.

use super::arguments::{BoundArguments, setting};
use super::origin::Origin;
use super::survey::{is_definition, set};
use super::{Builder, Flow};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::Reported;
use crate::scene::language::dictionary::{Known, look_up};
use crate::scene::language::syntax::{Call, SyntaxEvent};
use crate::scene::language::vocabulary::{Meaning, Word};

impl Builder {
    /// Takes an event of the survey.
    pub fn survey(&mut self, event: &SyntaxEvent<'_>) -> Flow {
        match event {
            SyntaxEvent::Assignment(name, value) => {
                if let Ok(number) = setting(name.text, name.span, value, &mut self.sink)
                    && let Some(number) = number
                {
                    set(&mut self.survey.fragments, name.text, number);
                }
            }
            SyntaxEvent::Close => {
                self.survey.depth -= usize::from(self.survey.depth > 0);
                self.passed_over = self.passed_over.saturating_sub(1);
                if self.survey.depth == 0 {
                    self.survey.definition = None;
                }
            }
            SyntaxEvent::Open(call) => {
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
                    let _ = self.no_room(0, Origin::of(word, call));
                }
                self.survey.definition = (!call.is_ended).then_some(word.name);
            }
            self.pass_over(call);
        } else if call.modifiers.root && self.survey.root.is_none() {
            self.survey.root = Some(call.name.span.start);
        }
    }

    fn define(&mut self, call: &Call<'_>, word: &'static Word) -> Result<(), Reported> {
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
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
