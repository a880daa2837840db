//! What the program around the viewer does with files.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use super::Painter;
use super::desk::{SaveFailure, SaveOrder};
use super::reloading::Reloading;
use crate::frame::Request;

/// What the viewer asks of the program around it. Each call may take long, and is made on a thread of its
/// own.
pub trait Files: Send + Sync {
    /// Reads a file, or a scene that is inside the program.
    ///
    /// # Errors
    /// What is wrong with it, in lines that can be shown.
    fn open(&self, name: &str) -> Result<OpenedScene, String>;

    /// Draws the picture of a request, as its format needs it, and writes it.
    ///
    /// # Errors
    /// Where a file is there that may not be lost, or the picture can not be written.
    fn save(&self, painter: &dyn Painter, request: &Request, order: &SaveOrder) -> Result<(), SaveFailure>;
}

/// A scene in the place of the one before.
pub struct OpenedScene {
    /// Who draws it.
    pub painter: Arc<dyn Painter>,
    /// Its name, as the frame shows it (in capitals).
    pub title: String,
    /// The folder that it was found in.
    pub folder: PathBuf,
    /// What comes after it as its files change.
    pub reloading: Reloading,
}

impl fmt::Debug for OpenedScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OpenedScene").field("title", &self.title).finish_non_exhaustive()
    }
}

/// A program that neither opens nor saves anything.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn open(&self, _name: &str) -> Result<OpenedScene, String> {
        Err("this program opens no other scenes".to_owned())
    }

    fn save(&self, _: &dyn Painter, _: &Request, _: &SaveOrder) -> Result<(), SaveFailure> {
        Err(SaveFailure::Because("this program saves no pictures".to_owned()))
    }
}
