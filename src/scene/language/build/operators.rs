//! The words that hold others: unions opened into objects, CSG operators flattened, maps handed down.

use std::rc::Rc;

use super::arguments::BoundArguments;
use super::chain::{Chain, Numbers};
use super::context::{Context, FormSpace};
use super::form::Form;
use super::frame::{BuiltCall, OpenCall, Role, Run};
use super::lost::Lost;
use super::materials::tinted;
use super::origin::Origin;
use super::pieces::Made;
use super::{Builder, forms, maps};
use crate::scene::diagnostic::Reported;
use crate::scene::language::syntax::{Call, TextSpan};
use crate::scene::language::vocabulary::{FormWord, MapWord, Meaning, OperatorWord, Word};
use crate::scene::profile::Fragments;
use crate::scene::{Diagnostic, Digits, Object, Solid};

impl Builder {
    /// Begins the scene, with the settings of the whole file.
    pub(super) fn begin(&mut self, fragments: Fragments) {
        self.frames = vec![OpenCall::scene(Rc::new(Context { fragments, ..Context::default() }))];
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
            Meaning::Solid(_) | Meaning::Figure(_) | Meaning::Import => {
                let built = match self.leaf(word, call, &context) {
                    // The most frequent of all: what is an object at once waits for nobody.
                    Ok(Made::Solid(solid)) if is_object && call.is_ended => {
                        return self.scene.objects.push(Object { name: None, solid });
                    }
                    Ok(Made::Solid(solid)) => {
                        self.solids.push(solid);
                        BuiltCall::Solids(Run::One, false)
                    }
                    Ok(Made::Piece(piece)) => {
                        self.pieces.push(piece);
                        BuiltCall::Piece(false)
                    }
                    Err(lost) => BuiltCall::Nothing(lost),
                };
                if call.is_ended {
                    return self.give(built, start, call.name.span);
                }
                self.frames.push(OpenCall::new(
                    Role::Primitive(word.name, built),
                    call.name.span,
                    context,
                    start,
                ));
            }
            Meaning::Material if call.is_ended => self.misplaced(call),
            Meaning::Camera | Meaning::Light | Meaning::World => self.misplaced(call),
            _ => {
                let (role, inner) = match self.enter(call, word, &context) {
                    Ok((Some(form), inner)) => (Role::Form(form, Origin::of(word, call)), inner),
                    Ok((None, inner)) => (self.role(call, word, is_object), inner),
                    // What is below a wrong map is left out. Where it is an error, errors below it are looked
                    // for, too.
                    Err(lost) if self.sink.leaves_out() && self.sink.is_clean() => {
                        return self.lose(lost, call);
                    }
                    Err(_) => (self.role(call, word, is_object), context),
                };
                let start = if let Role::Form(..) = role { self.pieces.len() } else { start };
                self.frames.push(OpenCall::new(role, call.name.span, inner, start));
                if call.is_ended {
                    self.close_frame();
                }
            }
        }
    }

    /// Passes over a call that is an operand without a solid.
    fn lose(&mut self, lost: Lost, call: &Call<'_>) {
        self.give(BuiltCall::Nothing(lost), self.solids.len(), call.name.span);
        self.pass_over(call);
    }

    fn misplaced(&mut self, call: &Call<'_>) {
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
        let arguments = BoundArguments::bind(call, word, &mut self.sink)?;
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
    ) -> Result<(Option<Form>, Rc<Context>), Lost> {
        let sink = &mut self.sink;
        let arguments = BoundArguments::bind(call, word, sink)?;
        let form = self.form(word, &arguments, above, call.name.span)?;
        let sink = &mut self.sink;
        let fragments = arguments.fragments(above.fragments);
        let mut inner = match word.meaning {
            // Most groups hand down what they were given.
            Meaning::Operator(_) | Meaning::Object if !arguments.has_settings() => {
                return Ok((form, Rc::clone(above)));
            }
            _ => Context { fragments, ..Context::clone(above) },
        };
        match word.meaning {
            Meaning::Map(map) => {
                let numbers = match map {
                    MapWord::Rotate | MapWord::Mirror => Numbers::Computed,
                    // OpenSCAD writes no other map.
                    MapWord::Multmatrix if self.digits == Digits::Six => Numbers::Printed,
                    MapWord::Translate | MapWord::Scale | MapWord::Multmatrix => Numbers::Written,
                };
                let map = maps::map_of(map, &arguments, sink)?;
                let is_flat = matches!(above.space, FormSpace::Extruded { .. });
                let map = if is_flat { maps::flattened(&map) } else { map };
                let maps = above.maps.then(map, numbers, call.name.span);
                inner.maps = maps.map_err(|error| arguments.refuse(error, Lost::Empty, sink))?;
            }
            Meaning::Color => inner.surface = tinted(above.surface, &arguments, sink)?,
            Meaning::Material => {
                self.memory.take(super::materials::BYTES);
                inner.surface = self.surfaces.apply(above.surface, &arguments, sink)?;
            }
            // What is swept straight up is exact: each figure is a solid of its own.
            Meaning::Form(FormWord::LinearExtrude) if form.is_none() => {
                let sweep = forms::sweep(&arguments, fragments, sink)?;
                inner.space = FormSpace::Extruded { bottom: sweep.bottom, top: sweep.top };
                let lean = forms::lean(&arguments, sink)?;
                let maps = above.maps.then(lean, Numbers::Written, call.name.span);
                inner.maps = maps.map_err(|error| arguments.refuse(error, Lost::Empty, sink))?;
            }
            // What something is made of is where that begins.
            Meaning::Form(_) => {
                inner.space = FormSpace::Faceted;
                inner.maps = Chain::default();
            }
            _ => {}
        }
        Ok((form, Rc::new(inner)))
    }

    /// Whether what an `object` holds can be one: several things only where all are solids.
    fn is_object(&mut self, solid: &Solid, place: TextSpan) -> bool {
        if matches!(solid, Solid::Primitive(_)) {
            return true;
        }
        let mut has_surface = false;
        solid.visit(&mut |primitive| has_surface |= primitive.shape.is_surface());
        if has_surface {
            let error = Diagnostic::error(place, "`object` holds a surface beside something else");
            self.sink.report(
                error.help("a surface is an object by itself: give each part an `object` of its own"),
            );
        }
        !has_surface
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
            Role::Form(ref form, origin) => {
                let form = form.clone();
                let above = self.frames.last().map(|above| Rc::clone(&above.context)).unwrap_or_default();
                let start = self.solids.len();
                let built = match self.formed(&form, &frame, &above, origin) {
                    Ok((Made::Solid(solid), is_incomplete)) => {
                        self.solids.push(solid);
                        BuiltCall::Solids(Run::One, is_incomplete)
                    }
                    Ok((Made::Piece(piece), is_incomplete)) => {
                        self.pieces.push(piece);
                        BuiltCall::Piece(is_incomplete)
                    }
                    Err(lost) => BuiltCall::Nothing(lost),
                };
                self.give(built, start, place);
            }
            Role::Operator(_) => {
                let built = self.ended(&frame);
                self.give(built, start, place);
            }
            Role::Object(ref name) => {
                let name = name.clone();
                if let BuiltCall::Solids(run, _) = self.ended(&frame) {
                    let solid = self.solid(start, run).filter(|solid| self.is_object(solid, place));
                    let objects = solid.map(|solid| Object { name: name.map(String::from), solid });
                    self.scene.objects.extend(objects);
                }
            }
        }
    }
}
