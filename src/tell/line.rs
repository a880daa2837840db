//! What one event is in words.

use crate::stage::Stage;

/// One step of the story.
#[derive(Clone, Debug, PartialEq)]
pub struct StoryLine {
    /// The stage of the flow chart that does it.
    pub stage: Stage,
    /// How deep it stands: what a surface sends on and is lit by stands deeper than the ray that met it, and
    /// what comes of such a ray deeper than that.
    pub depth: usize,
    /// What is done.
    pub text: String,
}
