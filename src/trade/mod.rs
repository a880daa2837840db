//! What pictures cost, and what they are worth: measured, not guessed.

mod timing;

pub use timing::{Effort, Timing, peak_memory};
