//! What is left of a part that can not be shown.

use crate::scene::diagnostic::Reported;

/// What a call without a solid is to what holds it. Why there is none has gone to the sink.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lost {
    /// Nothing, as OpenSCAD means it: a cube of no size. A difference from it is nothing, an intersection
    /// with it, too.
    Empty,
    /// Something that is not known: an operator that needs it is not known either.
    Missing,
}

impl From<Reported> for Lost {
    fn from(Reported: Reported) -> Self {
        Self::Missing
    }
}

impl From<Lost> for Reported {
    fn from(_: Lost) -> Self {
        Self
    }
}
