//! Why the viewer ended other than by a key.

use std::io;

/// Why the viewer ended other than by a key.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The terminal could not be set up, read or written.
    #[error("the terminal failed: {0}")]
    Terminal(#[from] io::Error),
    /// The terminal went away.
    #[error("the terminal hung up")]
    HungUp,
    /// Tracing panicked; the message is already on standard error.
    #[error("the picture could not be traced")]
    Panicked,
    /// Reading the scene panicked; the message is already on standard error.
    #[error("the scene could not be read")]
    LoadingPanicked,
}
