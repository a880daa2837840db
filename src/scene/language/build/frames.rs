//! Calls that are open, and the stack of solids on which what they hold waits for them.
//!
//! An operator takes its operands off the stack only where it becomes an operand of another kind of operator:
//! so no list is copied from level to level, and reading stays linear in the length of the text however the
//! text is nested.

use super::Builder;
use super::frame::{BuiltCall, OpenCall, Run};
use super::lost::Lost;
use crate::scene::language::syntax::TextSpan;
use crate::scene::language::vocabulary::OperatorWord;
use crate::scene::memory::ASSEMBLED_OPERATOR;
use crate::scene::{Diagnostic, Object, Solid};

impl Builder {
    /// Before another child of the innermost call: makes one solid of the child before it, where its operands
    /// would not be those of the call.
    pub(super) fn make_room(&mut self) {
        let Some(frame) = self.frames.last_mut() else { return };
        if let (Some(operator), Run::Operands(own)) = (frame.operator(), frame.run)
            && own != operator
            && self.solids.len() > frame.start
        {
            combine(&mut self.solids, frame.start, own);
            frame.run = Run::One;
        }
    }

    /// Whether what is read is cut, or cuts: a part of a difference or an intersection.
    pub(super) fn is_operand(&self) -> bool {
        let cuts = |frame: &OpenCall| {
            matches!(frame.operator(), Some(OperatorWord::Difference | OperatorWord::Intersection))
        };
        self.frames.iter().any(cuts)
    }

    /// The one solid that a run on the stack is.
    pub(super) fn solid(&mut self, start: usize, run: Run) -> Option<Solid> {
        if let Run::Operands(operator) = run {
            combine(&mut self.solids, start, operator);
        }
        self.solids.pop()
    }

    /// What an operator makes of its children.
    pub(super) fn ended(&mut self, frame: &OpenCall) -> BuiltCall {
        let any_left_out = frame.any_missing || frame.any_incomplete;
        let none = if any_left_out { Lost::Missing } else { Lost::Empty };
        let lost = match frame.operator() {
            Some(OperatorWord::Intersection) if frame.any_empty => Some(Lost::Empty),
            Some(OperatorWord::Intersection) if frame.any_missing => Some(Lost::Missing),
            Some(OperatorWord::Difference) if frame.first_lost.is_some() => frame.first_lost,
            _ => (self.solids.len() == frame.start).then_some(none),
        };
        let Some(lost) = lost else {
            if frame.run != Run::One && frame.operator() != Some(OperatorWord::Union) {
                self.memory.take(ASSEMBLED_OPERATOR);
            }
            return BuiltCall::Solids(frame.run, any_left_out);
        };
        self.solids.truncate(frame.start);
        if lost == Lost::Missing && frame.present > 1 {
            self.note_left_out(frame);
        }
        BuiltCall::Nothing(lost)
    }

    /// Says that an operator went with a child that it needs.
    pub(super) fn note_left_out(&mut self, frame: &OpenCall) {
        let message = match frame.operator() {
            Some(OperatorWord::Intersection) => "`intersection` is left out whole: a part of it is missing",
            Some(OperatorWord::Difference) => "`difference` is left out whole: what it cuts from is missing",
            _ => return,
        };
        // Beside an error it would only repeat that.
        if self.sink.is_clean() {
            self.sink.note(Diagnostic::note(frame.place, message));
        }
    }

    /// Gives what became of a call, whose solids begin at `start` on the stack, to the call that holds it.
    pub(super) fn give(&mut self, built: BuiltCall, start: usize, place: TextSpan) {
        let Some(frame) = self.frames.last_mut() else { return };
        let Some(operator) = frame.operator() else {
            if let BuiltCall::Solids(run, _) = built {
                self.open_up(start, run);
            }
            return;
        };
        let is_first = frame.present == 0;
        frame.present += 1;
        let is_cutter = operator == OperatorWord::Difference && !is_first;
        match built {
            BuiltCall::Nothing(lost) => {
                if is_first {
                    frame.first_lost = Some(lost);
                }
                frame.any_empty |= lost == Lost::Empty;
                frame.any_missing |= lost == Lost::Missing;
                if is_cutter && lost == Lost::Missing && frame.first_lost.is_none() && self.sink.is_clean() {
                    let message = "a hole of `difference` stays filled: what cuts it is left out";
                    self.sink.note(Diagnostic::note(place, message));
                }
            }
            BuiltCall::Piece(_) if operator == OperatorWord::Difference && frame.first_lost.is_some() => {
                self.pieces.pop();
            }
            // The others are read even where there is nothing to take them from: their errors are errors.
            BuiltCall::Solids(..) if operator == OperatorWord::Difference && frame.first_lost.is_some() => {
                self.solids.truncate(start);
            }
            BuiltCall::Solids(_, is_incomplete) | BuiltCall::Piece(is_incomplete) => {
                frame.any_incomplete |= is_incomplete;
                if is_cutter && is_incomplete && self.sink.is_clean() {
                    let message =
                        "a hole of `difference` is not as it was meant: a part of what cuts it is left out";
                    self.sink.note(Diagnostic::note(place, message));
                }
                let BuiltCall::Solids(run, _) = built else { return };
                // What is cut away may as well be cut away part by part.
                let joined = if is_cutter { OperatorWord::Union } else { operator };
                match run {
                    _ if frame.start == start => frame.run = run,
                    Run::Operands(own) if own != joined => {
                        combine(&mut self.solids, start, own);
                        frame.run = Run::Operands(operator);
                    }
                    _ => frame.run = Run::Operands(operator),
                }
            }
        }
    }

    /// Makes objects of what is on the stack: one of each operand of a union.
    fn open_up(&mut self, start: usize, run: Run) {
        if let Run::Operands(operator @ (OperatorWord::Intersection | OperatorWord::Difference)) = run {
            combine(&mut self.solids, start, operator);
        }
        let objects = self.solids.drain(start..).map(|solid| Object { name: None, solid });
        self.scene.objects.extend(objects);
    }
}

/// Makes one solid of what is on the stack.
fn combine(solids: &mut Vec<Solid>, start: usize, operator: OperatorWord) {
    let operands = solids.split_off(start);
    solids.push(match operator {
        OperatorWord::Union => Solid::Union(operands),
        OperatorWord::Intersection => Solid::Intersection(operands),
        OperatorWord::Difference => Solid::Difference(operands),
    });
}
