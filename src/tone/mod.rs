//! Stage 10, DITHER: light in, levels 0 to 12 out.

/// How light becomes a level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tone {
    /// The level nearest in lightness (CIE L*).
    #[default]
    Lightness,
    /// Even steps of 1/12 in light, as in 1986.
    Even,
}
