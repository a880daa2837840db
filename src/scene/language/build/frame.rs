//! A call that is open, and what became of one that is closed.

use std::rc::Rc;

use super::context::Context;
use super::form::Form;
use super::lost::Lost;
use super::origin::Origin;
use crate::scene::language::syntax::TextSpan;
use crate::scene::language::vocabulary::OperatorWord;

/// A call that is open.
#[derive(Debug)]
pub struct OpenCall {
    pub role: Role,
    /// The place of its word.
    pub place: TextSpan,
    pub context: Rc<Context>,
    /// Where its solids, or its facets, begin on their stack.
    pub start: usize,
    /// What its solids are to each other, where there are any.
    pub run: Run,
    /// How many children OpenSCAD would see, so far.
    pub present: usize,
    /// What the first child is, where it is no solid.
    pub first_lost: Option<Lost>,
    pub any_empty: bool,
    pub any_missing: bool,
    /// Whether a child is there, but without some part of it.
    pub any_incomplete: bool,
}

/// What the children of a call are for.
#[derive(Debug)]
pub enum Role {
    /// Each is an object of the lattice.
    Objects,
    /// All are one object of this name; none where the name is an error.
    Object(Option<Box<str>>),
    /// They are operands.
    Operator(OperatorWord),
    /// They are facets, of which something is made.
    Form(Form, Origin),
    /// There may be none, because the call is a primitive.
    Primitive(&'static str, BuiltCall),
}

/// Solids one after the other on the stack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Run {
    /// One solid.
    One,
    /// The operands of an operator that is still to be made of them.
    Operands(OperatorWord),
}

/// What became of a call.
#[derive(Clone, Copy, Debug)]
pub enum BuiltCall {
    /// What is last on the stack; and whether a part of it was left out.
    Solids(Run, bool),
    /// The same of what is last on the stack of facets.
    Piece(bool),
    Nothing(Lost),
}

impl OpenCall {
    /// The scene itself.
    pub fn scene(context: Rc<Context>) -> Self {
        Self::new(Role::Objects, TextSpan { start: 0, end: 0 }, context, 0)
    }

    pub fn new(role: Role, place: TextSpan, context: Rc<Context>, start: usize) -> Self {
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
    pub fn operator(&self) -> Option<OperatorWord> {
        match self.role {
            Role::Operator(operator) | Role::Form(Form::Operator(operator), _) => Some(operator),
            Role::Form(..) | Role::Object(_) => Some(OperatorWord::Union),
            Role::Objects | Role::Primitive(..) => None,
        }
    }
}
