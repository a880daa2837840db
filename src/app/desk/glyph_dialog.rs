//! F7: in which characters the picture is drawn; it shows each at once.

use super::form::{DialogForm, FormEvent, FormField};
use super::order::{DeskCommand, DeskEvent};
use crate::glyph::GlyphMode;

/// The sets of characters.
#[derive(Clone, Debug, PartialEq)]
pub struct GlyphDialog {
    /// What is asked for.
    pub form: DialogForm,
    modes: Vec<GlyphMode>,
    before: GlyphMode,
}

impl GlyphDialog {
    /// Offers those that the terminal draws; `now` is one of them.
    pub fn new(modes: Vec<GlyphMode>, now: GlyphMode) -> Self {
        let row = |mode: &GlyphMode| {
            let dots = mode.dots_per_cell();
            format!("{:<10} {} × {} dots in a cell", mode.name(), dots.width, dots.height)
        };
        let chosen = modes.iter().position(|&mode| mode == now).unwrap_or(0);
        let hint = "Arrows show the picture in other characters; Enter keeps them, Esc goes back";
        let list = FormField::list("&Characters", hint, modes.iter().map(row).collect(), chosen);
        let form = DialogForm::new("GLYPHS", vec![list], vec!["&OK", "Cancel"]);
        Self { form: DialogForm { width: 42, ..form }, modes, before: now }
    }

    /// What comes of what a key did to the form.
    pub fn answer(&mut self, event: FormEvent) -> DeskEvent {
        match event {
            FormEvent::Changed(_) => match self.modes.get(self.form.chosen(0)) {
                Some(&mode) => DeskEvent::Does(DeskCommand::Draw(mode)),
                None => DeskEvent::Stays,
            },
            FormEvent::Entered(_) | FormEvent::Pressed(0) => DeskEvent::Closes(None),
            FormEvent::Cancelled | FormEvent::Pressed(_) => {
                DeskEvent::Closes(Some(DeskCommand::Draw(self.before)))
            }
            FormEvent::Nothing => DeskEvent::Stays,
        }
    }
}
