//! A first reading of a text for what may stand below its uses: definitions, `$fn` of the whole file, and a
//! root (`!`).
//!
//! Most long files have none of them, because a program wrote them: they are read once, and again only where
//! the first of them turns up.

use crate::scene::language::dictionary::{Known, look_up};
use crate::scene::language::syntax::{Call, Value};
use crate::scene::language::vocabulary::Meaning;

/// What is known of a whole file.
#[derive(Debug, Default)]
pub struct Survey {
    pub is_done: bool,
    /// `$fn` of the whole file: the last assignment counts, as in OpenSCAD.
    pub fragments: f64,
    /// Where the first call marked `!` has its name.
    pub root: Option<u32>,
    /// While the root is looked for: `$fn` at each of the open calls.
    above: Vec<f64>,
    is_root_found: bool,
    /// While surveying: how many calls are open.
    pub depth: usize,
    /// While surveying: the definition that is open, which takes no children.
    pub definition: Option<&'static str>,
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

/// Whether a call at the top level is no solid: a view, a light, the world, or a material with a name.
pub fn is_definition(call: &Call<'_>) -> bool {
    match look_up(call.name.text) {
        Known::Word(word) => match word.meaning {
            Meaning::Camera | Meaning::Light | Meaning::World => true,
            Meaning::Material => call.is_ended,
            _ => false,
        },
        _ => false,
    }
}
