//! A screen of cells as text, with and without its colours.

use std::io::{self, Write};

use super::sgr::Pen;
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
/// colours of aixterm), those of xterm for colours by number, one line per row. Only the colour that changes
/// is sent, and none for the ink of a blank. Each line ends in the terminal's own colours, so that nothing
/// beyond the picture is painted.
pub fn ansi(cells: &Grid<Cell>, out: &mut impl Write) -> io::Result<()> {
    let mut line = String::new();
    for row in cells.rows() {
        line.clear();
        let mut now = Pen::TERMINAL;
        for cell in row {
            let meant = Pen::new(cell.ink.into(), cell.paper.into());
            let next = if cell.glyph == ' ' { now.for_blank(meant) } else { meant };
            now.change_to(next, &mut line);
            line.push(cell.glyph);
        }
        now.change_to(Pen::TERMINAL, &mut line);
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
    use proptest::prelude::*;
    use std::num::NonZeroU16;

    const PAINTS: [Paint; 9] = [
        Paint::Terminal,
        Paint::Black,
        Paint::DarkGray,
        Paint::LightGray,
        Paint::White,
        Paint::Indexed(16),
        Paint::Indexed(255),
        Paint::Rgb([0, 128, 255]),
        Paint::Rgb([42; 3]),
    ];

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

    /// What a terminal holds for a paint.
    fn seen(paint: Paint) -> vt100::Color {
        match paint {
            Paint::Terminal => vt100::Color::Default,
            Paint::Black => vt100::Color::Idx(0),
            Paint::DarkGray => vt100::Color::Idx(8),
            Paint::LightGray => vt100::Color::Idx(7),
            Paint::White => vt100::Color::Idx(15),
            Paint::Indexed(index) => vt100::Color::Idx(index),
            Paint::Rgb([r, g, b]) => vt100::Color::Rgb(r, g, b),
        }
    }

    fn any_cell() -> impl Strategy<Value = Cell> {
        let glyphs = prop::sample::select(" ░▒▓█▀▄▌▐▘▝▖▗▙▟▛▜▚▞▂▆.-,:;*=xo$#@⠁⢈⣿".chars().collect::<Vec<_>>());
        let paint = prop::sample::select(PAINTS.to_vec());
        (glyphs, paint.clone(), paint).prop_map(|(glyph, ink, paper)| Cell { glyph, ink, paper })
    }

    fn any_grid() -> impl Strategy<Value = Grid<Cell>> {
        (1_u32..12, 1_u32..8).prop_flat_map(|(width, height)| {
            let size = Size::new(width, height);
            prop::collection::vec(any_cell(), size.area())
                .prop_map(move |cells| Grid::from_values(size, cells))
        })
    }

    proptest! {
        #[test]
        fn a_terminal_shows_the_cells_that_were_meant(cells in any_grid()) {
            // One column and row more than the picture, to see that nothing beyond it is painted.
            let Size { width, height } = cells.size();
            let [rows, columns] = [height, width].map(|n| NonZeroU16::new(n as u16 + 1).expect("not 0"));
            let mut terminal = vt100::Parser::new(rows, columns, 0);
            terminal.process(written(&cells).replace('\n', "\r\n").as_bytes());
            for y in 0..=height {
                for x in 0..=width {
                    let place = (y as u16, x as u16);
                    let shown = terminal.screen().cell(place.0, place.1).expect("on the screen");
                    if x == width || y == height {
                        prop_assert!(!shown.has_contents());
                        prop_assert_eq!(shown.bgcolor(), vt100::Color::Default);
                        continue;
                    }
                    let meant = cells[(x, y)];
                    prop_assert_eq!(shown.contents(), meant.glyph.to_string());
                    prop_assert_eq!(shown.bgcolor(), seen(meant.paper));
                    if meant.glyph != ' ' {
                        prop_assert_eq!(shown.fgcolor(), seen(meant.ink));
                    }
                }
            }
        }
    }
}
