//! What opens over the screen of a DOS program: pull-down menus, and dialogs with a shadow.

pub mod camera_line;
mod form;
mod form_view;
mod glyph_dialog;
mod hot;
mod input_line;
mod line_dialog;
mod menu_bar;
mod open_dialog;
mod order;
mod save_dialog;
mod view_dialog;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::KeyEvent;
use ratatui::layout::{Position, Rect};

use super::theme::Theme;
use form::DialogForm;
pub use glyph_dialog::GlyphDialog;
pub use menu_bar::MenuBar;
use menu_bar::MenuEvent;
pub use open_dialog::OpenDialog;
pub use order::{DeskCommand, DeskEvent, SaveFailure, SaveFormat, SaveOrder};
pub use save_dialog::SaveDialog;
pub use view_dialog::{ViewDialog, ViewPlace};

use line_dialog::LineDialog;

/// What is open.
#[derive(Clone, Debug, PartialEq)]
pub enum Desk {
    /// The menus.
    Menus(MenuBar),
    /// Which scene is to be opened.
    Open(OpenDialog),
    /// From where it is seen.
    View(ViewDialog),
    /// Where a view is to be written to.
    Line(LineDialog),
    /// In which characters it is drawn.
    Glyphs(GlyphDialog),
    /// Where the picture is to be saved.
    Save(SaveDialog),
}

impl Desk {
    /// What is said of that where the keys go.
    pub fn hint(&self) -> &str {
        match self {
            Self::Menus(menus) => menus.hint(),
            _ => self.form().map_or("", DialogForm::hint),
        }
    }

    /// Does what a key asks for.
    pub fn take(&mut self, key: KeyEvent) -> DeskEvent {
        if let Self::Menus(menus) = self {
            return told(menus.take(key));
        }
        match self.form_mut().map(|form| form.take(key)) {
            Some(event) => self.answer(event),
            None => DeskEvent::Stays,
        }
    }

    /// Does what a click at a place of the screen asks for.
    pub fn click(&mut self, at: Position, screen: Rect) -> DeskEvent {
        if let Self::Menus(menus) = self {
            return told(menus.click(at, screen));
        }
        match self.form_mut().map(|form| form.click(at, screen)) {
            Some(event) => self.answer(event),
            None => DeskEvent::Stays,
        }
    }

    /// Draws it over the screen; gives the places that it covers.
    pub fn draw(&self, theme: &Theme, screen: Rect, buffer: &mut Buffer) -> Vec<Rect> {
        match self {
            Self::Menus(menus) => menus.draw(theme, screen, buffer).to_vec(),
            _ => self.form().map(|form| form.draw(theme, screen, buffer)).into_iter().collect(),
        }
    }

    fn answer(&mut self, event: form::FormEvent) -> DeskEvent {
        match self {
            Self::Menus(_) => DeskEvent::Stays,
            Self::Open(dialog) => dialog.answer(event),
            Self::View(dialog) => match dialog.answer(event) {
                view_dialog::ViewEvent::Desk(event) => event,
                view_dialog::ViewEvent::Writes(camera) => {
                    *self = Self::Line(LineDialog::new(*camera));
                    DeskEvent::Stays
                }
            },
            Self::Line(dialog) => dialog.answer(event),
            Self::Glyphs(dialog) => dialog.answer(event),
            Self::Save(dialog) => dialog.answer(event),
        }
    }

    fn form(&self) -> Option<&DialogForm> {
        Some(match self {
            Self::Menus(_) => return None,
            Self::Open(dialog) => &dialog.form,
            Self::View(dialog) => &dialog.form,
            Self::Line(dialog) => &dialog.form,
            Self::Glyphs(dialog) => &dialog.form,
            Self::Save(dialog) => &dialog.form,
        })
    }

    fn form_mut(&mut self) -> Option<&mut DialogForm> {
        Some(match self {
            Self::Menus(_) => return None,
            Self::Open(dialog) => &mut dialog.form,
            Self::View(dialog) => &mut dialog.form,
            Self::Line(dialog) => &mut dialog.form,
            Self::Glyphs(dialog) => &mut dialog.form,
            Self::Save(dialog) => &mut dialog.form,
        })
    }

    /// Says in the dialog what went wrong.
    pub fn fail(&mut self, message: String) {
        if let Some(form) = self.form_mut() {
            form.message = Some(message);
        }
    }
}

fn told(event: MenuEvent) -> DeskEvent {
    match event {
        MenuEvent::Stays => DeskEvent::Stays,
        MenuEvent::Left => DeskEvent::Closes(None),
        MenuEvent::Chosen(action) => DeskEvent::Acts(action),
    }
}
