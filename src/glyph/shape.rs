//! What stands in a cell: block shapes as masks over its dots, the three shades, and the ASCII ramp.

use crate::math::Size;

/// The finest division of a cell that any shape here needs, and the traced dots of the modes that use shapes.
pub const DOTS: Size = Size::new(2, 4);
/// Their number.
pub const DOT_COUNT: usize = DOTS.area();

/// A glyph that fills some dots of its cell with ink and leaves the others to the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlyphShape {
    /// The character.
    pub glyph: char,
    /// The inked dots in scan order, the top left one in the lowest bit.
    pub mask: u8,
}

impl GlyphShape {
    /// From the four rows of the cell, the top one first; in each, bit 1 is the left dot and bit 0 the right
    /// one, as they are read.
    const fn new(glyph: char, rows: [u8; 4]) -> Self {
        let mut mask = 0;
        let mut row = 0;
        while row < 4 {
            let reversed = (rows[row] >> 1) | ((rows[row] & 1) << 1);
            mask |= reversed << (2 * row);
            row += 1;
        }
        Self { glyph, mask }
    }

    /// Each dot's own of two values.
    pub fn dots<T: Copy>(self, ink: T, paper: T) -> [T; DOT_COUNT] {
        std::array::from_fn(|dot| if self.mask >> dot & 1 == 1 { ink } else { paper })
    }
}

/// The shapes of code page 437: upright and level halves.
pub const HALVES: &[GlyphShape] = &[
    GlyphShape::new('▀', [0b11, 0b11, 0b00, 0b00]),
    GlyphShape::new('▄', [0b00, 0b00, 0b11, 0b11]),
    GlyphShape::new('▌', [0b10, 0b10, 0b10, 0b10]),
    GlyphShape::new('▐', [0b01, 0b01, 0b01, 0b01]),
];

/// The halves and every other choice of quadrants, and the lower quarter and three quarters.
pub const BLOCKS: &[GlyphShape] = &[
    GlyphShape::new('▀', [0b11, 0b11, 0b00, 0b00]),
    GlyphShape::new('▄', [0b00, 0b00, 0b11, 0b11]),
    GlyphShape::new('▌', [0b10, 0b10, 0b10, 0b10]),
    GlyphShape::new('▐', [0b01, 0b01, 0b01, 0b01]),
    GlyphShape::new('▘', [0b10, 0b10, 0b00, 0b00]),
    GlyphShape::new('▝', [0b01, 0b01, 0b00, 0b00]),
    GlyphShape::new('▖', [0b00, 0b00, 0b10, 0b10]),
    GlyphShape::new('▗', [0b00, 0b00, 0b01, 0b01]),
    GlyphShape::new('▙', [0b10, 0b10, 0b11, 0b11]),
    GlyphShape::new('▟', [0b01, 0b01, 0b11, 0b11]),
    GlyphShape::new('▛', [0b11, 0b11, 0b10, 0b10]),
    GlyphShape::new('▜', [0b11, 0b11, 0b01, 0b01]),
    GlyphShape::new('▚', [0b10, 0b10, 0b01, 0b01]),
    GlyphShape::new('▞', [0b01, 0b01, 0b10, 0b10]),
    GlyphShape::new('▂', [0b00, 0b00, 0b00, 0b11]),
    GlyphShape::new('▆', [0b00, 0b11, 0b11, 0b11]),
];

/// The choices of quadrants, one of each two that are each other's complement.
pub const QUADRANTS: &[GlyphShape] = &[
    GlyphShape::new('▀', [0b11, 0b11, 0b00, 0b00]),
    GlyphShape::new('▌', [0b10, 0b10, 0b10, 0b10]),
    GlyphShape::new('▘', [0b10, 0b10, 0b00, 0b00]),
    GlyphShape::new('▝', [0b01, 0b01, 0b00, 0b00]),
    GlyphShape::new('▖', [0b00, 0b00, 0b10, 0b10]),
    GlyphShape::new('▗', [0b00, 0b00, 0b01, 0b01]),
    GlyphShape::new('▚', [0b10, 0b10, 0b01, 0b01]),
];

/// The shape whose paper is the other's ink, where there is one.
pub fn complement(shape: GlyphShape) -> Option<GlyphShape> {
    BLOCKS.iter().find(|other| other.mask == !shape.mask).copied()
}

/// The block shape that shows the same as this one with ink and paper in each other's place, where there is
/// one.
#[inline]
pub fn complement_of(glyph: char) -> Option<char> {
    let shape = BLOCKS.iter().find(|shape| shape.glyph == glyph)?;
    complement(*shape).map(|other| other.glyph)
}

/// The shape, blank or full block that has ink in these dots, where there is one.
pub fn block_of(mask: u8) -> Option<char> {
    match mask {
        0 => Some(' '),
        0xFF => Some('█'),
        _ => BLOCKS.iter().find(|shape| shape.mask == mask).map(|shape| shape.glyph),
    }
}

/// The first of the 256 Braille patterns, the blank one.
const BRAILLE: u32 = 0x2800;
/// The bit that Unicode gives to each dot, in scan order: the columns from the top, then the row that was
/// added.
const BRAILLE_BITS: [u32; DOT_COUNT] = [0, 3, 1, 4, 2, 5, 6, 7];

/// The share of its place in the cell that a Braille dot fills, measured on the outlines of `DejaVu` Sans
/// Mono 2.37.
pub const BRAILLE_DOT: f64 = 0.2026;

/// The Braille pattern of these dots; a blank for none, as its pattern is not blank in every font.
pub fn braille_of(mask: u8) -> char {
    let bits: u32 = (0..DOT_COUNT).map(|dot| u32::from(mask >> dot & 1) << BRAILLE_BITS[dot]).sum();
    // All 256 numbers are characters.
    if bits == 0 { ' ' } else { char::from_u32(BRAILLE + bits).unwrap_or(' ') }
}

fn mask_of_braille(glyph: char) -> Option<u8> {
    let bits = u32::from(glyph).checked_sub(BRAILLE).filter(|bits| *bits < 1 << DOT_COUNT)?;
    Some((0..DOT_COUNT).map(|dot| ((bits >> BRAILLE_BITS[dot] & 1) as u8) << dot).sum())
}

/// Blank, the three shades and the full block, by quarters of ink.
pub const SHADES: [char; 5] = [' ', '░', '▒', '▓', '█'];

/// One ASCII character per level with the share of its cell that is ink, measured on the outlines of `DejaVu`
/// Sans Mono 2.37 (advance × line height). The lightest strokes any font has are far above level 1's light,
/// so the ramp keeps the order of the levels, at even steps of lightness, not their light.
pub const RAMP: [(char, f64); 13] = [
    (' ', 0.0),
    ('.', 0.0261),
    ('-', 0.0291),
    (',', 0.0442),
    (':', 0.0521),
    (';', 0.0702),
    ('*', 0.0956),
    ('=', 0.1230),
    ('x', 0.1463),
    ('o', 0.1783),
    ('$', 0.2101),
    ('#', 0.2425),
    ('@', 0.2763),
];

/// Where a glyph's ink is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    /// Evenly over the cell: the share of it, 0 to 1.
    Even(f64),
    /// In whole dots of 2 × 4: a bit for each in scan order, the top left one lowest.
    Dots(u8),
    /// The same, where each dot fills only a fixed share of its place.
    Specks(u8),
}

/// Where the ink of one of this program's glyphs is; `None` for any other character.
pub fn coverage(glyph: char) -> Option<Coverage> {
    if let Some(quarters) = SHADES.iter().position(|&shade| shade == glyph) {
        return Some(Coverage::Even(quarters as f64 / 4.0));
    }
    if let Some(shape) = BLOCKS.iter().find(|shape| shape.glyph == glyph) {
        return Some(Coverage::Dots(shape.mask));
    }
    if let Some(mask) = mask_of_braille(glyph) {
        return Some(Coverage::Specks(mask));
    }
    RAMP.iter().find(|(ascii, _)| *ascii == glyph).map(|&(_, share)| Coverage::Even(share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_read_from_the_top_left() {
        let mask = |glyph| BLOCKS.iter().find(|shape| shape.glyph == glyph).map(|shape| shape.mask);
        assert_eq!(mask('▘'), Some(0b0000_0101));
        assert_eq!(mask('▗'), Some(0b1010_0000));
        assert_eq!(mask('▂'), Some(0b1100_0000));
    }

    #[test]
    fn every_choice_of_quadrants_is_there_once() {
        let mut masks: Vec<u8> = BLOCKS.iter().map(|shape| shape.mask).collect();
        masks.sort_unstable();
        masks.dedup();
        assert_eq!(masks.len(), BLOCKS.len());
        let quadrants = |mask: u8| (mask & 0b11_0011) << 2 == mask & 0b1100_1100;
        assert_eq!(masks.iter().filter(|&&mask| quadrants(mask)).count(), 14);
    }

    #[test]
    fn a_shape_and_its_complement_share_the_cell() {
        for shape in QUADRANTS {
            let other = complement(*shape).expect("quadrants have complements");
            assert_eq!(other.mask ^ shape.mask, 0xFF);
            assert!(!QUADRANTS.contains(&other), "{} and {}", shape.glyph, other.glyph);
        }
        assert_eq!(QUADRANTS.len(), 7);
        assert_eq!((block_of(0), block_of(0xFF), block_of(0b1100_0000)), (Some(' '), Some('█'), Some('▂')));
    }

    #[test]
    fn braille_goes_there_and_back() {
        assert_eq!(braille_of(0b0000_0001), '⠁');
        assert_eq!(braille_of(0b1000_0010), '⢈');
        assert_eq!(braille_of(0xFF), '⣿');
        for mask in 1..=255 {
            assert_eq!(coverage(braille_of(mask)), Some(Coverage::Specks(mask)));
        }
    }

    #[test]
    fn the_ramp_grows() {
        assert!(RAMP.windows(2).all(|pair| pair[0].1 < pair[1].1));
    }
}
