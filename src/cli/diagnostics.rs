//! Diagnostics with the lines they speak of.

use crate::scene::Diagnostics;

/// The diagnostics as text for people.
pub fn render(diagnostics: &Diagnostics, _colour: bool) -> String {
    diagnostics.to_string()
}
