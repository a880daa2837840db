//! What a cell of the screen looks like, and the other ways to say the same.

use super::sgr::{Color, Pen};
use crate::glyph::{self, Cell};
use crate::math::{Grid, Size};

/// A screen as the encoder reads it.
pub trait Screen {
    /// Columns and rows.
    fn size(&self) -> Size;

    /// The cell of a column and row, from 0 at the top left. In what a wide character covers besides its
    /// first column may be anything.
    fn look(&self, column: u32, row: u32) -> ScreenCell<'_>;
}

/// A character, or what some of them make together, and what it is written with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScreenCell<'a> {
    /// What is written.
    pub symbol: Symbol<'a>,
    /// What it is written with.
    pub pen: Pen,
    /// How many columns it covers, 1 or more.
    pub columns: u32,
}

/// What is written into a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol<'a> {
    /// One character.
    Char(char),
    /// Several that are shown as one; never a single one.
    Cluster(&'a str),
}

impl<'a> Symbol<'a> {
    /// The symbol of a text.
    pub fn new(text: &'a str) -> Self {
        let mut characters = text.chars();
        match (characters.next(), characters.next()) {
            (Some(only), None) => Self::Char(only),
            _ => Self::Cluster(text),
        }
    }

    /// Whether every terminal puts the cursor one column on: Latin letters, and what frames and pictures are
    /// made of. Of anything else it is not asked; the next place is then absolute.
    pub const fn is_one_column(self) -> bool {
        matches!(
            self,
            Self::Char(
                ' '..='~'
                | '\u{a0}'..='\u{2ff}'
                | '\u{2190}'..='\u{21ff}'
                | '\u{2500}'..='\u{25ff}'
                | '\u{2800}'..='\u{28ff}',
            )
        )
    }

    /// How long it is in UTF-8.
    pub const fn bytes(self) -> u32 {
        match self {
            Self::Char(character) => character.len_utf8() as u32,
            Self::Cluster(text) => text.len() as u32,
        }
    }

    /// Appends it.
    pub fn put(self, line: &mut String) {
        match self {
            Self::Char(character) => line.push(character),
            Self::Cluster(text) => line.push_str(text),
        }
    }

    /// Whether it is one of the block elements, which fill cells as pictures do and text does not.
    pub const fn is_block(self) -> bool {
        matches!(self, Self::Char('\u{2580}'..='\u{259f}'))
    }
}

const BLANK: Symbol<'_> = Symbol::Char(' ');
const FULL: Symbol<'_> = Symbol::Char('█');

/// One way to write a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spelling<'a> {
    /// What is written.
    pub symbol: Symbol<'a>,
    pen: Pen,
    free: Free,
}

/// What of a spelling's pen cannot be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Free {
    Nothing,
    /// What shows strokes: of a blank.
    Strokes,
    /// The paper: of a full block.
    Paper,
}

impl Spelling<'_> {
    /// The pen that writes it, with what cannot be seen of it taken from another.
    pub fn pen(&self, other: Pen) -> Pen {
        match self.free {
            Free::Nothing => self.pen,
            Free::Strokes => other.for_blank(self.pen),
            Free::Paper => Pen { paper: other.paper, ..self.pen },
        }
    }

    /// The same, where all of it can be seen.
    pub fn whole_pen(&self) -> Option<Pen> {
        (self.free == Free::Nothing).then_some(self.pen)
    }
}

impl<'a> ScreenCell<'a> {
    /// A blank as a cleared screen has it.
    pub const CLEAR: Self = Self { symbol: BLANK, pen: Pen::TERMINAL, columns: 1 };

    /// Whether erasing leaves this: a blank on the terminal's own paper.
    pub fn is_clear(&self) -> bool {
        self.symbol == BLANK && self.pen.paper == Color::Terminal && !self.pen.reversed
    }

    /// As it is meant.
    pub fn spelling(&self) -> Spelling<'a> {
        let Pen { bold, dim, reversed, .. } = self.pen;
        let free = match self.symbol {
            BLANK => Free::Strokes,
            FULL if !(bold || dim || reversed) => Free::Paper,
            _ => Free::Nothing,
        };
        Spelling { symbol: self.symbol, pen: self.pen, free }
    }

    /// Another way that shows the same, where there is one: a full block of the paper's colour for a blank
    /// and the other way round, and a block with ink and paper in each other's place for its complement. No
    /// paper becomes bright by it: some terminals have none.
    ///
    /// A full block stands for a blank only `beside_blocks`: text stays text, for those who copy it or have
    /// it read to them, and where there are no block elements there comes none.
    pub fn other_spelling(&self, beside_blocks: bool) -> Option<Spelling<'a>> {
        let Pen { ink, paper, bold, dim, reversed } = self.pen;
        if self.symbol == BLANK {
            let flat = Pen::new(paper, paper);
            let is_told = paper != Color::Terminal && !reversed && beside_blocks;
            return is_told.then_some(Spelling { symbol: FULL, pen: flat, free: Free::Paper });
        }
        if bold || dim || reversed || ink == Color::Terminal || (ink.is_bright() && !paper.is_bright()) {
            return None;
        }
        if self.symbol == FULL {
            return Some(Spelling { symbol: BLANK, pen: Pen::new(ink, ink), free: Free::Strokes });
        }
        let Symbol::Char(character) = self.symbol else { return None };
        let other = glyph::complement_of(character).filter(|_| paper != Color::Terminal)?;
        Some(Spelling { symbol: Symbol::Char(other), pen: Pen::new(paper, ink), free: Free::Nothing })
    }

    /// What can be seen of it: the same for all looks that look alike.
    #[must_use]
    pub fn seen(&self) -> Self {
        let plain = !(self.pen.bold || self.pen.dim || self.pen.reversed);
        let Pen { ink, paper, .. } = self.pen;
        match self.symbol {
            BLANK => Self { pen: Pen::TERMINAL.for_blank(self.pen), ..*self },
            FULL if plain && ink != Color::Terminal => {
                Self { symbol: BLANK, pen: Pen::new(Color::Terminal, ink), ..*self }
            }
            Symbol::Char(character) if plain && ![ink, paper].contains(&Color::Terminal) => {
                match glyph::complement_of(character) {
                    Some(other) if other < character => {
                        Self { symbol: Symbol::Char(other), pen: Pen::new(paper, ink), ..*self }
                    }
                    _ => *self,
                }
            }
            _ => *self,
        }
    }
}

impl Screen for Grid<Cell> {
    fn size(&self) -> Size {
        self.size()
    }

    fn look(&self, column: u32, row: u32) -> ScreenCell<'_> {
        let Cell { glyph, ink, paper } = self[(column, row)];
        ScreenCell { symbol: Symbol::Char(glyph), pen: Pen::new(ink.into(), paper.into()), columns: 1 }
    }
}
