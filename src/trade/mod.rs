//! What pictures cost, and what they are worth: measured, not guessed.
//!
//! [`Sweep`] measures how time trades against accuracy over all [`KNOBS`] of a picture: each [`Setting`] is
//! timed, and compared with a [`Reference`] in three layers ([`Accuracy`]). Those that no other beats are the
//! [`front`]; [`Wish::recommended`] picks of them.

mod eye_filter;
mod front;
mod knobs;
mod layers;
mod levels;
mod many_rays;
mod measurement;
mod measures;
mod plot;
mod plot_svg;
mod reference;
mod seen_screen;
mod setting;
mod sweep;
mod timing;

pub use eye_filter::EyeDistance;
pub use front::{Wish, front};
pub use knobs::{KNOBS, Knob};
pub use layers::{Accuracy, CharacterError, GeometryError, LightError};
pub use levels::{LevelDifference, cells_apart};
pub use measurement::Measurement;
pub use plot::{AxisTick, LogAxis, PlotPoint, TradePlot};
pub use plot_svg::svg;
pub use reference::{Reference, ReferenceError, ReferenceGoal};
pub use setting::Setting;
pub use sweep::{NothingMeasured, PassedOver, Sweep, SweepLimits, SweepStep, WhyPassedOver};
pub use timing::{Effort, Times, Timing, peak_memory};
