//! What a plan was made from, decision by decision.

use super::options::Shading;
use super::precision::PrecisionReason;

/// What a plan was made from, decision by decision. [`Plan::explain`](super::Plan::explain) puts it into
/// words.
#[derive(Clone, Debug, PartialEq)]
pub struct Reasons {
    pub(super) cut: Cut,
    pub(super) digital: PrecisionReason,
    pub(super) shading: Shading,
    /// The depth constant.
    pub(super) depth: Result<f64, Absent>,
    /// The first material that has a highlight, by its index.
    pub(super) highlight: Result<usize, Absent>,
    /// The first material that sends rays on, by its index.
    pub(super) secondary: Result<usize, Absent>,
    pub(super) shadows: Result<(), Absent>,
    /// The first thing that has a colour.
    pub(super) colored: Option<&'static str>,
    pub(super) color_wanted: bool,
}

/// Why space is cut as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// The person wants it so.
    Asked,
    /// There is so little to tell apart that a structure would only add its own steps.
    Few,
    /// There is more.
    Many,
    /// The fast engine goes through boxes.
    ForTiles,
}

/// What a term needs and does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Absent {
    /// The shading model has no such term.
    InModel(Shading),
    /// The scene gives no depth constant.
    DepthConstant,
    /// No light shines.
    Light,
    /// No material has a highlight.
    Highlight,
    /// No material is a mirror or glass.
    MirrorOrGlass,
    /// The person does not want it.
    Wish,
}
