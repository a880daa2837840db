//! One ray in words: what each stage of the flow chart makes of it.
//!
//! [`Story`] tells the events of a [`FollowedRay`](crate::frame::FollowedRay), line by line: those of rays
//! that are sent on stand deeper. Nothing is computed a second time: all numbers are the exact engine's own.

mod figure;
mod line;
mod names;
mod story;
mod teller;

pub use line::StoryLine;
pub use story::{Story, StoryRow};
