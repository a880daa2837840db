//! The words that hold others: unions opened into objects, CSG operators flattened, maps handed down.
//!
//! What a call holds waits on one stack of solids until the call ends. An operator takes its operands off it only where
//! it becomes an operand of another kind of operator: so no list is copied from level to level, and reading stays
//! linear in the length of the text however the text is nested.

use std::rc::Rc;

use super::arguments::Arguments;
use super::chain::Numbers;
use super::lost::Lost;
use super::materials::tinted;
use super::{Builder, Context, maps};
use crate::scene::diagnostic::Reported;
use crate::scene::language::syntax::{Call, Span};
use crate::scene::language::vocabulary::{MapWord, Meaning, OperatorWord, Word};
use crate::scene::{Diagnostic, Object, Solid};

/// A call that is open.
#[derive(Debug)]
pub struct Frame {
    role: Role,
    /// The place of its word.
    place: Span,
    context: Rc<Context>,
    /// Where its solids begin on the stack.
    start: usize,
    /// What its solids are to each other, where there are any.
    run: Run,
    /// How many children OpenSCAD would see, so far.
    present: usize,
    /// What the first child is, where it is no solid.
    first_lost: Option<Lost>,
    any_empty: bool,
    any_missing: bool,
    /// Whether a child is there, but without some part of it.
    any_incomplete: bool,
}

/// What the children of a call are for.
#[derive(Debug)]
enum Role {
    /// Each is an object of the lattice.
    Objects,
    /// All are one object of this name; none where the name is an error.
    Object(Option<Box<str>>),
    /// They are operands.
    Operator(OperatorWord),
    /// There may be none, because the call is a primitive.
    Primitive(&'static str, Built),
}

/// Solids one after the other on the stack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Run {
    /// One solid.
    One,
    /// The operands of an operator that is still to be made of them.
    Operands(OperatorWord),
}

/// What became of a call.
#[derive(Clone, Copy, Debug)]
enum Built {
    /// What is last on the stack; and whether a part of it was left out.
    Solids(Run, bool),
    Nothing(Lost),
}

impl Frame {
    /// The scene itself.
    pub fn scene(context: Rc<Context>) -> Self {
        Self::new(Role::Objects, Span { start: 0, end: 0 }, context, 0)
    }

    fn new(role: Role, place: Span, context: Rc<Context>, start: usize) -> Self {
        Self {
            role,
            place,
            context,
            start,
            run: Run::One,
            present: 0,
            first_lost: None,
            any_empty: false,
            any_missing: false,
            any_incomplete: false,
        }
    }

    /// The operator over its children, where they are operands.
    fn operator(&self) -> Option<OperatorWord> {
        match self.role {
            Role::Operator(operator) => Some(operator),
            Role::Object(_) => Some(OperatorWord::Union),
            Role::Objects | Role::Primitive(..) => None,
        }
    }
}

impl Builder {
    /// Begins the scene, with `$fn` of the whole file.
    pub(super) fn begin(&mut self, fragments: f64) {
        self.frames = vec![Frame::scene(Rc::new(Context { fragments, ..Context::default() }))];
    }

    /// Whether a call takes part; says so where it is left out.
    pub(super) fn is_present(&mut self, call: &Call<'_>) -> bool {
        if call.modifiers.disable {
            return false;
        }
        if call.modifiers.background {
            let message = format!("`%` leaves `{}` out", call.name.text);
            self.sink.note(Diagnostic::note(call.name.span, message));
        }
        !call.modifiers.background
    }

    /// A call inside the innermost open one.
    pub(super) fn child(&mut self, call: &Call<'_>) {
        let Some(frame) = self.frames.last() else { return };
        if let Role::Primitive(name, _) = frame.role {
            self.no_children(name, call);
            return self.pass_over(call);
        }
        let context = Rc::clone(&frame.context);
        let is_object = matches!(frame.role, Role::Objects);
        if !self.is_present(call) {
            return self.pass_over(call);
        }
        let Some(word) = self.word(call) else { return self.lose(Lost::Missing, call) };
        self.make_room();
        let start = self.solids.len();
        match word.meaning {
            Meaning::Solid(kind) => {
                let built = match self.primitive(kind, word, call, &context) {
                    Ok(solid) => {
                        self.solids.push(solid);
                        Built::Solids(Run::One, false)
                    }
                    Err(lost) => Built::Nothing(lost),
                };
                if call.is_ended {
                    return self.give(built, start, call.name.span);
                }
                self.frames.push(Frame::new(
                    Role::Primitive(word.name, built),
                    call.name.span,
                    context,
                    start,
                ));
            }
            Meaning::Material if call.is_ended => self.misplaced(call),
            Meaning::Camera | Meaning::Light | Meaning::World => self.misplaced(call),
            _ => {
                let role = self.role(call, word, is_object);
                let inner = match self.enter(call, word, &context) {
                    Ok(inner) => inner,
                    // What is below a wrong map is left out. Where it is an error, errors below it are looked for, too.
                    Err(lost) if self.sink.leaves_out() && self.sink.is_clean() => {
                        return self.lose(lost, call);
                    }
                    Err(_) => context,
                };
                self.frames.push(Frame::new(role, call.name.span, inner, start));
                if call.is_ended {
                    self.close_frame();
                }
            }
        }
    }

    /// Passes over a call that is an operand without a solid.
    fn lose(&mut self, lost: Lost, call: &Call<'_>) {
        self.give(Built::Nothing(lost), self.solids.len(), call.name.span);
        self.pass_over(call);
    }

    fn misplaced(&mut self, call: &Call<'_>) {
        let name = call.name.text;
        let error = Diagnostic::error(call.name.span, format!("`{name}` stands inside braces"));
        let help = match name {
            "material" => {
                "define materials at the top level; to apply one, write what it is for in place of the `;`"
            }
            _ => "move it to the top level",
        };
        self.sink.report(error.help(help));
        self.lose(Lost::Missing, call);
    }

    fn role(&mut self, call: &Call<'_>, word: &'static Word, is_object: bool) -> Role {
        match word.meaning {
            Meaning::Object if is_object => {
                Role::Object(self.object_name(call, word).ok().map(String::into_boxed_str))
            }
            Meaning::Object => {
                let message =
                    "`object` is inside another solid: it is part of that, without a name of its own";
                self.sink.note(Diagnostic::note(call.name.span, message));
                Role::Operator(OperatorWord::Union)
            }
            Meaning::Operator(operator @ (OperatorWord::Difference | OperatorWord::Intersection)) => {
                Role::Operator(operator)
            }
            _ if is_object => Role::Objects,
            _ => Role::Operator(OperatorWord::Union),
        }
    }

    fn object_name(&mut self, call: &Call<'_>, word: &'static Word) -> Result<String, Reported> {
        let arguments = Arguments::bind(call, word, &mut self.sink)?;
        let name = arguments.text("name", &mut self.sink)?;
        self.memory.take(name.map_or(0, str::len) as u64);
        name.map(str::to_owned).ok_or_else(|| arguments.missing("name", &mut self.sink).into())
    }

    /// What a word hands down to its children.
    fn enter(
        &mut self,
        call: &Call<'_>,
        word: &'static Word,
        above: &Rc<Context>,
    ) -> Result<Rc<Context>, Lost> {
        let sink = &mut self.sink;
        let arguments = Arguments::bind(call, word, sink)?;
        let fragments = arguments.fragments.unwrap_or(above.fragments);
        let mut inner = match word.meaning {
            // Most groups hand down what they were given.
            Meaning::Operator(_) | Meaning::Object if arguments.fragments.is_none() => {
                return Ok(Rc::clone(above));
            }
            _ => Context { fragments, ..Context::clone(above) },
        };
        match word.meaning {
            Meaning::Map(map) => {
                let numbers = match map {
                    MapWord::Rotate | MapWord::Mirror => Numbers::Computed,
                    MapWord::Translate | MapWord::Scale | MapWord::Multmatrix => Numbers::Written,
                };
                let map = maps::map_of(map, &arguments, sink)?;
                let maps = above.maps.then(map, numbers, call.name.span);
                inner.maps = maps.map_err(|error| arguments.refuse(error, Lost::Empty, sink))?;
            }
            Meaning::Color => inner.surface = tinted(above.surface, &arguments, sink)?,
            Meaning::Material => {
                self.memory.take(super::materials::BYTES);
                inner.surface = self.surfaces.apply(above.surface, &arguments, sink)?;
            }
            _ => {}
        }
        Ok(Rc::new(inner))
    }

    /// Before another child of the innermost call: makes one solid of the child before it, where its operands would not
    /// be those of the call.
    fn make_room(&mut self) {
        let Some(frame) = self.frames.last_mut() else { return };
        if let (Some(operator), Run::Operands(own)) = (frame.operator(), frame.run)
            && own != operator
            && self.solids.len() > frame.start
        {
            combine(&mut self.solids, frame.start, own);
            frame.run = Run::One;
        }
    }

    /// The innermost open call ends.
    pub(super) fn close(&mut self) {
        if self.passed_over > 0 {
            self.passed_over -= 1;
        } else if !self.survey.leave() {
            self.close_frame();
        }
    }

    fn close_frame(&mut self) {
        // The scene itself stays open.
        let Some(frame) = self.frames.pop_if(|frame| frame.place.end > 0) else { return };
        let (start, place) = (frame.start, frame.place);
        match frame.role {
            Role::Objects => {}
            Role::Primitive(_, built) => self.give(built, start, place),
            Role::Operator(_) => {
                let built = self.ended(&frame);
                self.give(built, start, place);
            }
            Role::Object(ref name) => {
                let name = name.clone();
                if let Built::Solids(run, _) = self.ended(&frame) {
                    let solid = self.solid(start, run);
                    let objects = solid.map(|solid| Object { name: name.map(String::from), solid });
                    self.scene.objects.extend(objects);
                }
            }
        }
    }

    /// The one solid that a run on the stack is.
    fn solid(&mut self, start: usize, run: Run) -> Option<Solid> {
        if let Run::Operands(operator) = run {
            combine(&mut self.solids, start, operator);
        }
        self.solids.pop()
    }

    /// What an operator makes of its children.
    fn ended(&mut self, frame: &Frame) -> Built {
        let any_left_out = frame.any_missing || frame.any_incomplete;
        let none = if any_left_out { Lost::Missing } else { Lost::Empty };
        let lost = match frame.operator() {
            Some(OperatorWord::Intersection) if frame.any_empty => Some(Lost::Empty),
            Some(OperatorWord::Intersection) if frame.any_missing => Some(Lost::Missing),
            Some(OperatorWord::Difference) if frame.first_lost.is_some() => frame.first_lost,
            _ => (self.solids.len() == frame.start).then_some(none),
        };
        let Some(lost) = lost else { return Built::Solids(frame.run, any_left_out) };
        self.solids.truncate(frame.start);
        if lost == Lost::Missing && frame.present > 1 {
            self.note_left_out(frame);
        }
        Built::Nothing(lost)
    }

    /// Says that an operator went with a child that it needs.
    fn note_left_out(&mut self, frame: &Frame) {
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
    fn give(&mut self, built: Built, start: usize, place: Span) {
        let Some(frame) = self.frames.last_mut() else { return };
        let Some(operator) = frame.operator() else {
            if let Built::Solids(run, _) = built {
                self.open_up(start, run);
            }
            return;
        };
        let is_first = frame.present == 0;
        frame.present += 1;
        let is_cutter = operator == OperatorWord::Difference && !is_first;
        match built {
            Built::Nothing(lost) => {
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
            // The others are read even where there is nothing to take them from: their errors are errors.
            Built::Solids(..) if operator == OperatorWord::Difference && frame.first_lost.is_some() => {
                self.solids.truncate(start);
            }
            Built::Solids(run, is_incomplete) => {
                frame.any_incomplete |= is_incomplete;
                if is_cutter && is_incomplete && self.sink.is_clean() {
                    let message =
                        "a hole of `difference` is not as it was meant: a part of what cuts it is left out";
                    self.sink.note(Diagnostic::note(place, message));
                }
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
