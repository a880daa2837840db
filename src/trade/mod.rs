//! What pictures cost, and what they are worth: measured, not guessed.

mod levels;
mod timing;

pub use levels::{LevelDifference, cells_apart};
pub use timing::{Effort, Timing, peak_memory};
