//! What the forms of pictures and figures are called.

use clap::ValueEnum;

/// Forms of a still.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StillFormat {
    /// Characters only
    Txt,
    /// Characters with ANSI colours
    Ans,
    /// ANSI art as DOS had it, for its viewers and editors: 80x25 bytes of code page 437 unless --cells says
    /// otherwise, 16 colours, a SAUCE record. Such files end in .ans
    AnsDos,
    /// What a terminal is sent, as asciinema plays it: a recording of a --turntable
    Cast,
    /// Characters as a picture of rectangles and text, the colours a PC's; a --turntable moves
    Svg,
    /// Characters as a page
    Html,
    /// One character per dot, 0 to 9 and A to C: the form to keep in a test
    Levels,
    /// One pixel per dot, of the light's own gray, or in colour with --palette color
    Png,
    /// One pixel per dot, of the light's own gray, as a portable gray map
    Pgm,
    /// The same as png, as a portable pixel map
    Ppm,
    /// Raw values of --channel, as floats
    Pfm,
}

impl StillFormat {
    /// Whether it has one pixel, or one raw value, per dot.
    pub const fn is_pixels(self) -> bool {
        matches!(self, Self::Png | Self::Pgm | Self::Ppm | Self::Pfm)
    }

    /// Whether it is made of cells.
    pub const fn has_characters(self) -> bool {
        !self.is_pixels() && !matches!(self, Self::Levels)
    }
}

/// Raw values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RawChannel {
    /// Linear light; its three primaries with --palette color
    Light,
    /// Distance from the eye, infinite where nothing is hit
    Depth,
    /// The surface's normal, turned to the eye
    Normal,
    /// The object's number from 1, 0 where nothing is hit
    Object,
}

/// Forms of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    /// A line per figure
    Text,
    /// One line of JSON
    Json,
}
