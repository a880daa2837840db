//! What a person sees of a terminal's cell, however it was told.

use ray13::glyph::{Coverage, coverage};

/// What is seen of a cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Seen {
    /// Of what fills its dots wholly or not at all the colour of each.
    Dots([vt100::Color; 8]),
    /// Of any other the character, its ink and its paper.
    Glyph(char, vt100::Color, vt100::Color),
}

impl Seen {
    /// What is seen of a character with an ink and a paper.
    pub fn new(glyph: char, ink: vt100::Color, paper: vt100::Color) -> Self {
        let dots =
            |mask: u8| Self::Dots(std::array::from_fn(|dot| if mask >> dot & 1 == 1 { ink } else { paper }));
        match coverage(glyph) {
            Some(Coverage::Dots(mask)) => dots(mask),
            Some(Coverage::Even(0.0)) => dots(0),
            Some(Coverage::Even(1.0)) => dots(0xFF),
            _ => Self::Glyph(glyph, ink, paper),
        }
    }

    /// What a terminal shows.
    pub fn shown(cell: &vt100::Cell) -> Self {
        Self::new(cell.contents().chars().next().unwrap_or(' '), cell.fgcolor(), cell.bgcolor())
    }
}
