//! What a pass over a tile is for.

/// What the rays from the eye are traced for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// What they see and its light.
    Light,
    /// What they see.
    Surfaces,
}
