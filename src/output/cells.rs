//! A screen of cells as text, with and without its colours.

use std::io::{self, Write};

use super::encoder::Encoder;
use crate::glyph::Cell;
use crate::math::Grid;

/// The characters alone, one line per row of cells, each line at its full width. Colours are lost, so this is
/// for pictures in the terminal's own ink ([`Palette::Mono`](crate::glyph::Palette::Mono)) and in ASCII.
pub fn text(cells: &Grid<Cell>, out: &mut impl Write) -> io::Result<()> {
    let mut line = String::new();
    for row in cells.rows() {
        line.clear();
        line.extend(row.iter().map(|cell| cell.glyph));
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// The cells with SGR sequences: those of 16-colour terminals for the attributes (ECMA-48, and the bright
/// colours of aixterm), those of xterm for colours by number, one line per row, in as few bytes as the
/// [`Encoder`] finds. Each line ends in the terminal's own colours, so that nothing beyond the picture is
/// painted.
pub fn ansi(cells: &Grid<Cell>, out: &mut impl Write) -> io::Result<()> {
    let mut encoder = Encoder::default();
    for y in 0..cells.size().height {
        encoder.row(cells, y);
        let mut line = encoder.take();
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Paint;
    use crate::math::Size;

    fn row(cells: &[(char, Paint, Paint)]) -> Grid<Cell> {
        let cells: Vec<Cell> = cells.iter().map(|&(glyph, ink, paper)| Cell { glyph, ink, paper }).collect();
        Grid::from_values(Size::new(cells.len() as u32, 1), cells)
    }

    fn written(cells: &Grid<Cell>) -> String {
        let mut out = Vec::new();
        ansi(cells, &mut out).expect("a vector takes every byte");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn only_the_colour_that_changes_is_sent() {
        use Paint::{Black, DarkGray, LightGray, Terminal};
        let cells = row(&[
            ('░', DarkGray, Black),
            ('▒', DarkGray, Black),
            ('▒', DarkGray, LightGray),
            (' ', Black, LightGray),
            ('▌', LightGray, LightGray),
            ('x', Terminal, Terminal),
        ]);
        assert_eq!(written(&cells), "\x1b[90;40m░▒\x1b[47m▒ \x1b[37m▌\x1b[mx\n");
        assert_eq!(written(&row(&[('x', Terminal, Terminal)])), "x\n");
    }

    #[test]
    fn colours_by_number_have_their_own_parameters() {
        let cells = row(&[
            ('▀', Paint::Rgb([1, 2, 3]), Paint::Rgb([4, 5, 6])),
            ('▀', Paint::Rgb([1, 2, 3]), Paint::Indexed(250)),
            ('▀', Paint::Indexed(17), Paint::Indexed(250)),
        ]);
        assert_eq!(written(&cells), "\x1b[38;2;1;2;3;48;2;4;5;6m▀\x1b[48;5;250m▀\x1b[38;5;17m▀\x1b[m\n");
    }

    #[test]
    fn text_keeps_the_full_width() {
        let cells = row(&[('a', Paint::White, Paint::Black), (' ', Paint::White, Paint::White)]);
        let mut out = Vec::new();
        text(&cells, &mut out).expect("a vector takes every byte");
        assert_eq!(out, b"a \n");
    }
}
