//! Pictures and rays in words.
//!
//! [`Story`] tells what each stage of the flow chart makes of one ray, line by line, from the events of a
//! [`FollowedRay`](crate::frame::FollowedRay): those of rays that are sent on stand deeper. Nothing is
//! computed a second time: all numbers are the exact engine's own. [`described`] says what a view shows.

mod description;
mod figure;
mod line;
mod names;
mod story;
mod teller;

pub use description::{described, why_unseen};
pub use line::StoryLine;
pub use names::object_name;
pub use story::{Story, StoryRow};
