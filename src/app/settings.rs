//! With what the viewer starts.

use std::path::PathBuf;
use std::time::Duration;

use super::desk::SaveFormat;
use crate::glyph::{GlyphMode, Ground, Palette};
use crate::output::Capabilities;
use crate::plan::Options;
use crate::scene::Camera;
use crate::tone::Tone;

/// With what the viewer starts.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// The name of the scene, as the frame shows it (in capitals).
    pub title: String,
    /// The index of the first view.
    pub view: usize,
    /// A camera of one's own, in place of the view; the first press of Tab leaves it for the view.
    pub camera: Option<Camera>,
    /// Shading model, shadows, structure, threads; and how many rays a dot has when nothing moves.
    pub options: Options,
    /// The time of a picture while the eye moves: where one ray a dot takes longer, there are fewer and
    /// larger dots until nothing moves. Absent where pictures take what they take.
    pub frame_time: Option<Duration>,
    /// Bytes a second that are sent at most, on average, above 0; absent where there is no limit.
    pub bytes_per_second: Option<f64>,
    /// Whether, where `options` have one ray a dot, the picture is anti-aliased when nothing moves: with as
    /// many rays as each dot needs for [`ERROR`](crate::plan::ERROR).
    pub adaptive_at_rest: bool,
    /// Characters.
    pub glyphs: GlyphMode,
    /// Colours, of the picture and of the panels.
    pub palette: Palette,
    /// What the terminal's own paper is, where there is only that.
    pub ground: Ground,
    /// What of these two the terminal has a say in.
    pub questions: Questions,
    /// Light to level.
    pub tone: Tone,
    /// What the terminal can be told and what it can draw.
    pub terminal: Capabilities,
    /// Whether pictures are drawn dot by dot at first, as the PC/AT drew them.
    pub slow: bool,
    /// The folder whose scenes are offered first; where it is empty, that in which the program runs.
    pub folder: PathBuf,
    /// The forms in which the picture can be saved.
    pub formats: Vec<SaveFormat>,
}

/// What a terminal's answers may decide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Questions {
    /// The grays of [`Palette::Dos`].
    pub grays: bool,
    /// Where ink goes that is the terminal's own.
    pub ground: bool,
}
