//! What comes of what takes its time.

use super::desk::SaveFailure;
use super::files::OpenedScene;
use super::follow_order::FollowedDot;
use super::trade_panel::TradeFigures;
use crate::trade::SweepStep;

/// What came of an errand.
#[derive(Debug)]
pub enum Done {
    /// A scene was read, or could not be; of several that were asked for, the one of this number.
    Opened(u64, Result<OpenedScene, String>),
    /// The picture was saved, in these words.
    Saved(Result<String, SaveFailure>),
    /// A line was added to a file, in these words.
    Appended(Result<String, String>),
    /// The trade is being measured, and is so far.
    Measuring(SweepStep),
    /// The trade was measured, or nothing was.
    Measured(Option<Box<TradeFigures>>),
    /// The ray was followed that is looked at.
    Followed(Box<FollowedDot>),
    /// The ray was followed of a dot that is being drawn.
    Scanned(Box<FollowedDot>),
}
