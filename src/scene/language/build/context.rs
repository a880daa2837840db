//! What the words above hand down to a word.

use super::chain::Chain;
use super::materials::Surface;

/// What the words above hand down to a word.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// From the word's coordinates to the world's.
    pub maps: Chain,
    pub surface: Surface,
    /// `$fn`: how many sides stand for a circle, where they are few.
    pub fragments: f64,
}
