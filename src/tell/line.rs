//! What one event is in words.

use crate::stage::Stage;

/// One step of the story.
#[derive(Clone, Debug, PartialEq)]
pub struct StoryLine {
    /// The stage of the flow chart that does it.
    pub stage: Stage,
    /// How many rays stand between this one and that from the eye, each with a step for its terms.
    pub depth: usize,
    /// What is done.
    pub text: String,
    /// The event that it tells, by its number; of cells without anything in them, the first. Absent for the
    /// stages that deal with the dot and not with a ray.
    pub event: Option<usize>,
}
