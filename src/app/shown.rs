//! The picture on the screen, with what it took to get there.

use std::time::Duration;

use super::refinement::RaysTold;
use crate::frame::Frame;
use crate::stage::Stage;

/// The last finished picture and what it took to send it.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The picture.
    pub frame: Frame,
    /// Its rays.
    pub rays: Option<RaysTold>,
    /// Bytes to the terminal; 0 until they are known.
    pub bytes: usize,
    /// The dot that is being drawn, where the picture comes dot by dot.
    pub in_hand: Option<DotInHand>,
    /// The time it took to draw the screen and turn it into these bytes.
    pub display: Duration,
    /// From the last update before it to the terminal's answer; absent where none has come.
    pub round_trip: Option<Duration>,
}

/// The dot that is being drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DotInHand {
    /// The stage that its ray is in, where that is known.
    pub stage: Option<Stage>,
    /// The part of the picture that is there, 0 to 1.
    pub share: f64,
}

impl Shown {
    /// From the request to the bytes, in milliseconds.
    pub fn total_ms(&self) -> f64 {
        self.frame.total.as_secs_f64() * 1e3 + self.display.as_secs_f64() * 1e3
    }
}
