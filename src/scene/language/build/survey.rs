//! A first reading of a text for what may stand below its uses: definitions, settings of the whole file, and
//! a root (`!`).
//!
//! Most long files have none of them, because a program wrote them: they are read once, and again only where
//! the first of them turns up.

use crate::scene::language::dictionary::{Known, look_up};
use crate::scene::language::syntax::{Call, Value};
use crate::scene::language::vocabulary::Meaning;
use crate::scene::profile::Fragments;

/// What is known of a whole file.
#[derive(Debug, Default)]
pub struct Survey {
    pub is_done: bool,
    /// `$fn`, `$fa` and `$fs` of the whole file: the last assignment counts, as in OpenSCAD.
    pub fragments: Fragments,
    /// Where the first call marked `!` has its name.
    pub root: Option<u32>,
    /// While the root is looked for: the settings at each of the open calls.
    above: Vec<Fragments>,
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
    /// The root, which has these settings.
    Root(Fragments),
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
            let mut inner = fragments;
            for argument in &call.arguments {
                if let (Some(name), Value::Number(number)) = (argument.name, &argument.value.value) {
                    set(&mut inner, name.text, *number);
                }
            }
            self.above.push(inner);
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

/// Sets one of the settings.
pub fn set(fragments: &mut Fragments, name: &str, number: f64) {
    match name {
        "$fn" => fragments.number = number,
        "$fa" => fragments.angle = number,
        "$fs" => fragments.size = number,
        _ => {}
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
