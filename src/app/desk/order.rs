//! What menus and dialogs ask of the rest of the program.

use std::path::PathBuf;

use crate::app::actions::Action;
use crate::glyph::GlyphMode;
use crate::scene::Camera;

/// What comes of a key in a menu or a dialog.
#[derive(Clone, Debug, PartialEq)]
pub enum DeskEvent {
    /// It stays open.
    Stays,
    /// It stays open, and this is to be done.
    Does(DeskCommand),
    /// It closes, and this is to be done.
    Closes(Option<DeskCommand>),
    /// It closes, and this is to be done as if its key had been pressed.
    Acts(Action),
}

/// What a dialog asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum DeskCommand {
    /// To open a file, or a scene that is inside the program.
    Open(String),
    /// To see the scene from here.
    Look(Box<Camera>),
    /// To draw the picture in these characters.
    Draw(GlyphMode),
    /// To save the picture.
    Save(SaveOrder),
    /// To add a line to a text file.
    Append {
        /// The file, which need not be there.
        path: PathBuf,
        /// The line, without its end.
        line: String,
    },
}

/// A picture that is to be saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveOrder {
    /// Where.
    pub path: PathBuf,
    /// As what: the name of a [`SaveFormat`].
    pub format: String,
    /// Whether a file that is there may be lost.
    pub replaces: bool,
}

/// A form that a picture can be saved in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SaveFormat {
    /// Its name, which is also the ending of its files.
    pub name: String,
    /// What is in it.
    pub holds: String,
}

/// Why a picture was not saved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SaveFailure {
    /// A file of that name is there.
    Exists,
    /// For another reason.
    Because(String),
}
