//! The words that hold others: unions opened into objects, CSG operators flattened, maps handed down.
//!
//! Unions are gathered by walking through them, so that no list is copied from level to level: reading
//! stays linear in the length of the text however the text is nested.

use super::arguments::Arguments;
use super::chain::Numbers;
use super::materials::tinted;
use super::{Builder, Context, maps};
use crate::scene::diagnostic::Reported;
use crate::scene::language::syntax::Call;
use crate::scene::language::vocabulary::{Known, MapWord, Meaning, OperatorWord, Word, look_up};
use crate::scene::{Diagnostic, Object, Solid};

/// What became of a call.
enum Built {
    Solid(Solid),
    /// Nothing, as OpenSCAD means it: a difference from it is nothing, an intersection with it, too.
    Empty,
    /// Not known: the call was left out, or is an error. It takes no part in what holds it.
    Missing,
}

/// How the solids of an `intersection` were found.
#[derive(Default)]
struct Meeting {
    solids: Vec<Solid>,
    any_empty: bool,
    any_missing: bool,
}

/// How many children OpenSCAD would see.
fn count_present(call: &Call<'_>) -> usize {
    call.children.iter().filter(|child| !child.modifiers.disable && !child.modifiers.background).count()
}

/// The word of a call that holds others and means the union of them: unions, maps and surfaces do, and any
/// operator with one operand is that operand.
fn union_word(call: &Call<'_>) -> Option<&'static Word> {
    let Known::Word(word) = look_up(call.name.text) else { return None };
    match word.meaning {
        Meaning::Operator(OperatorWord::Union) | Meaning::Map(_) | Meaning::Color | Meaning::Object => {
            Some(word)
        }
        // Without children it is a definition.
        Meaning::Material if !call.children.is_empty() => Some(word),
        Meaning::Operator(_) if count_present(call) == 1 => Some(word),
        _ => None,
    }
}

impl Builder<'_> {
    /// Opens unions down to what is no union: the objects.
    pub(super) fn open(&mut self, calls: &[Call<'_>], context: &Context) {
        for call in calls {
            if !self.is_present(call) {
                continue;
            }
            match union_word(call) {
                Some(word) if word.meaning == Meaning::Object => self.object(call, word, context),
                Some(word) => {
                    let inner = self.enter(call, word, context).unwrap_or_else(|Reported| context.clone());
                    self.open(&call.children, &inner);
                }
                None => {
                    if let Built::Solid(solid) = self.solid(call, context) {
                        self.scene.objects.push(Object { name: None, solid });
                    }
                }
            }
        }
    }

    fn object(&mut self, call: &Call<'_>, word: &'static Word, context: &Context) {
        let name = self.object_name(call, word);
        let inner = self.enter(call, word, context).unwrap_or_else(|Reported| context.clone());
        if let (Ok(name), Built::Solid(solid)) = (name, self.united(call, &inner)) {
            self.scene.objects.push(Object { name: Some(name), solid });
        }
    }

    fn object_name(&mut self, call: &Call<'_>, word: &'static Word) -> Result<String, Reported> {
        let arguments = Arguments::bind(call, word, self.sink)?;
        let name = arguments.text("name", self.sink)?;
        name.map(str::to_owned).ok_or_else(|| arguments.missing("name", self.sink))
    }

    /// Whether a call takes part; says so where it is left out.
    pub(super) fn is_present(&mut self, call: &Call<'_>) -> bool {
        if call.modifiers.disable || self.sink.is_full() {
            return false;
        }
        if call.modifiers.background {
            let message = format!("`%` leaves `{}` out", call.name.text);
            self.sink.note(Diagnostic::note(call.name.span, message));
        }
        !call.modifiers.background
    }

    /// What a word hands down to its children.
    fn enter(&mut self, call: &Call<'_>, word: &'static Word, above: &Context) -> Result<Context, Reported> {
        let sink = &mut *self.sink;
        let arguments = Arguments::bind(call, word, sink)?;
        let fragments = arguments.fragments.unwrap_or(above.fragments);
        let mut inner = Context { fragments, ..above.clone() };
        match word.meaning {
            Meaning::Map(map) => {
                let numbers = match map {
                    MapWord::Rotate | MapWord::Mirror => Numbers::Computed,
                    MapWord::Translate | MapWord::Scale | MapWord::Multmatrix => Numbers::Written,
                };
                let map = maps::map_of(map, &arguments, sink)?;
                inner.maps = above.maps.then(map, numbers, call.name.span, sink)?;
            }
            Meaning::Color => inner.surface = tinted(above.surface, &arguments, sink)?,
            Meaning::Material => inner.surface = self.surfaces.apply(above.surface, &arguments, sink)?,
            _ => {}
        }
        Ok(inner)
    }

    /// The solid of a call inside a solid.
    fn solid(&mut self, call: &Call<'_>, context: &Context) -> Built {
        let Some(word) = self.word(call) else { return Built::Missing };
        match word.meaning {
            Meaning::Solid(kind) => match self.primitive(kind, word, call, context) {
                Ok(solid) => Built::Solid(solid),
                Err(Reported) => Built::Missing,
            },
            Meaning::Material if call.children.is_empty() => self.misplaced(call),
            Meaning::Camera | Meaning::Light | Meaning::World => self.misplaced(call),
            _ => {
                let inner = self.enter(call, word, context).unwrap_or_else(|Reported| context.clone());
                match word.meaning {
                    Meaning::Operator(OperatorWord::Difference) => self.difference(call, &inner),
                    Meaning::Operator(OperatorWord::Intersection) => self.intersection(call, &inner),
                    _ => self.united(call, &inner),
                }
            }
        }
    }

    fn misplaced(&mut self, call: &Call<'_>) -> Built {
        let name = call.name.text;
        // What holds it may be braces, or one word before it: `rotate(90) light(…);`.
        let error = Diagnostic::error(call.name.span, format!("`{name}` can not be part of another call"));
        let help = match name {
            "material" => {
                "define materials at the top level; to apply one, write what it is for in place of the `;`"
            }
            _ => "write it at the top level, with no word before it and no braces around it",
        };
        self.sink.report(error.help(help));
        Built::Missing
    }

    fn united(&mut self, call: &Call<'_>, context: &Context) -> Built {
        let mut solids = Vec::new();
        let any_missing = self.unite(&call.children, context, &mut solids);
        joined(solids, Solid::Union, any_missing)
    }

    /// Puts the operands of a union into `solids`; tells whether any was left out.
    fn unite(&mut self, calls: &[Call<'_>], context: &Context, solids: &mut Vec<Solid>) -> bool {
        let mut any_missing = false;
        for call in calls {
            if !self.is_present(call) {
                continue;
            }
            if let Some(word) = union_word(call) {
                self.note_lost_name(call, word);
                let inner = self.enter(call, word, context).unwrap_or_else(|Reported| context.clone());
                any_missing |= self.unite(&call.children, &inner, solids);
                continue;
            }
            match self.solid(call, context) {
                Built::Solid(solid) => solids.push(solid),
                Built::Empty => {}
                Built::Missing => any_missing = true,
            }
        }
        any_missing
    }

    fn note_lost_name(&mut self, call: &Call<'_>, word: &Word) {
        if word.meaning == Meaning::Object {
            let message = "`object` is inside another solid: it is part of that, without a name of its own";
            self.sink.note(Diagnostic::note(call.name.span, message));
        }
    }

    fn difference(&mut self, call: &Call<'_>, context: &Context) -> Built {
        let Some(first) = call.children.iter().position(|child| self.is_present(child)) else {
            return Built::Empty;
        };
        let rest = &call.children[first + 1..];
        let mut solids = match self.solid(&call.children[first], context) {
            // (A − B) − C is A − B − C.
            Built::Solid(Solid::Difference(solids)) => solids,
            Built::Solid(solid) => vec![solid],
            nothing => {
                // The others are read even where there is nothing to take them from: their errors are errors.
                self.unite(rest, context, &mut Vec::new());
                return nothing;
            }
        };
        self.unite(rest, context, &mut solids);
        joined(solids, Solid::Difference, false)
    }

    fn intersection(&mut self, call: &Call<'_>, context: &Context) -> Built {
        let mut meeting = Meeting::default();
        self.intersect(&call.children, context, &mut meeting);
        if meeting.any_empty {
            return Built::Empty;
        }
        joined(meeting.solids, Solid::Intersection, meeting.any_missing)
    }

    /// Puts the operands of an intersection into `meeting`.
    fn intersect(&mut self, calls: &[Call<'_>], context: &Context, meeting: &mut Meeting) {
        for call in calls {
            if !self.is_present(call) {
                continue;
            }
            if let Some(word) = intersection_word(call) {
                self.note_lost_name(call, word);
                let inner = self.enter(call, word, context).unwrap_or_else(|Reported| context.clone());
                self.intersect(&call.children, &inner, meeting);
                continue;
            }
            match self.solid(call, context) {
                Built::Solid(solid) => meeting.solids.push(solid),
                Built::Empty => meeting.any_empty = true,
                Built::Missing => meeting.any_missing = true,
            }
        }
    }
}

/// The word of a call that means the intersection of its children: any operator with one operand does, too.
fn intersection_word(call: &Call<'_>) -> Option<&'static Word> {
    match look_up(call.name.text) {
        Known::Word(word) => match (count_present(call), word.meaning) {
            (0, _) => None,
            (1, _) => union_word(call),
            (_, Meaning::Operator(OperatorWord::Intersection)) => Some(word),
            _ => None,
        },
        _ => None,
    }
}

/// One solid is itself; none is nothing, or not known where some were left out.
fn joined(mut solids: Vec<Solid>, join: impl Fn(Vec<Solid>) -> Solid, any_missing: bool) -> Built {
    match (solids.len(), any_missing) {
        (0, true) => Built::Missing,
        (0, false) => Built::Empty,
        (1, _) => solids.pop().map_or(Built::Empty, Built::Solid),
        _ => Built::Solid(join(solids)),
    }
}
