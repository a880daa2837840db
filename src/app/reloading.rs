//! Scenes that follow the first one, as its file changes.

use std::fmt;
use std::sync::Arc;

use super::Painter;

/// Gives the next scene, or what is wrong with it; nothing at the end.
pub type NextScene = Box<dyn FnMut() -> Option<Result<Arc<dyn Painter>, String>> + Send>;

/// What comes after the first scene.
pub struct Reloading {
    /// Waits until the scene has changed and gives it, or what is wrong with it; nothing at the end. It is
    /// asked on a thread of its own.
    pub next: NextScene,
    /// Ends the waiting, and what the loading of a scene has begun; called before the program ends.
    pub end: Box<dyn Fn() + Send>,
}

impl Reloading {
    /// Nothing.
    pub fn never() -> Self {
        Self { next: Box::new(|| None), end: Box::new(|| {}) }
    }
}

/// The scene that a file has become, or why it is none.
pub struct Reloaded {
    /// Of the scenes that were opened, the one of this number.
    pub of: u64,
    /// The scene.
    pub scene: Result<Arc<dyn Painter>, String>,
}

impl fmt::Debug for Reloaded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reloaded")
            .field("of", &self.of)
            .field("scene", &self.scene.as_ref().map(|_| ()))
            .finish()
    }
}
