//! What a pass over a tile is for.

/// What is asked of the rays from the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// What they see and its light.
    Light,
    /// What they see.
    Surfaces,
}
