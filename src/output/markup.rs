//! Cells as a page: SVG and HTML, for where there is no terminal.

use std::io::{self, Write};

use crate::glyph::{Cell, Coverage, Ground, Paint, coverage};
use crate::math::{Grid, Size};

/// A cell in units of a page: one dot of its 2 × 4 is a square of 5.
const CELL: Size = Size::new(10, 20);
const DOT: u32 = 5;

/// The cells as an SVG picture. Blocks are rectangles, and shades even fields of as much of the ink as they
/// have, so that it looks alike with any font and at any size; characters are text of the reader's own
/// monospaced font. Where cells are in the terminal's own colours, `ground` is the page's.
pub fn svg(cells: &Grid<Cell>, ground: Ground, out: &mut impl Write) -> io::Result<()> {
    let Size { width, height } = cells.size();
    let (across, down) = (width * CELL.width, height * CELL.height);
    let page = PageColors::of(ground).paper;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {across} {down}\" font-family=\"monospace\" \
         font-size=\"16\" shape-rendering=\"crispEdges\">"
    )?;
    writeln!(out, "<rect width=\"{across}\" height=\"{down}\" fill=\"{}\"/>", hex(page))?;
    for (y, row) in (0..).zip(cells.rows()) {
        let looks: Vec<Shown> = row.iter().map(|&cell| Shown::of(cell, PageColors::of(ground))).collect();
        for run in runs(&looks) {
            run.shown.write_svg([run.first * CELL.width, y * CELL.height], run.count, page, out)?;
        }
    }
    writeln!(out, "</svg>")
}

/// The cells as a page of HTML: lines of text whose runs have the colours of their cells.
pub fn html(cells: &Grid<Cell>, ground: Ground, out: &mut impl Write) -> io::Result<()> {
    let colors = PageColors::of(ground);
    writeln!(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>ray13</title>")?;
    // Rows without a gap, as terminals have them.
    writeln!(
        out,
        "<style>body{{background:{};color:{}}}pre{{font-family:monospace;line-height:1}}</style>\n<pre>",
        hex(colors.paper),
        hex(colors.ink)
    )?;
    for row in cells.rows() {
        let mut rest = row;
        while let Some(&Cell { ink, paper, .. }) = rest.first() {
            let alike = rest.iter().take_while(|cell| (cell.ink, cell.paper) == (ink, paper)).count();
            let (run, after) = rest.split_at(alike);
            let [fore, back] = [colors.ink(ink), colors.paper(paper)].map(hex);
            write!(out, "<span style=\"color:{fore};background:{back}\">")?;
            for cell in run {
                out.write_all(escaped(cell.glyph).as_bytes())?;
            }
            write!(out, "</span>")?;
            rest = after;
        }
        writeln!(out)?;
    }
    writeln!(out, "</pre>\n</html>")
}

/// What stands for the terminal's own ink and paper.
#[derive(Clone, Copy)]
pub(super) struct PageColors {
    ink: [u8; 3],
    pub(super) paper: [u8; 3],
}

impl PageColors {
    pub(super) fn of(ground: Ground) -> Self {
        match ground {
            Ground::Dark => Self { ink: [0xFF; 3], paper: [0; 3] },
            Ground::Light => Self { ink: [0; 3], paper: [0xFF; 3] },
        }
    }

    fn ink(self, paint: Paint) -> [u8; 3] {
        paint.srgb().unwrap_or(self.ink)
    }

    fn paper(self, paint: Paint) -> [u8; 3] {
        paint.srgb().unwrap_or(self.paper)
    }
}

/// What is drawn of a cell.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Shown {
    pub(super) ink: [u8; 3],
    pub(super) paper: [u8; 3],
    pub(super) strokes: Strokes,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Strokes {
    /// That share of the ink everywhere.
    Even(f64),
    /// The ink in these dots.
    Dots(u8),
    Letter(char),
}

impl Shown {
    pub(super) fn of(cell: Cell, colors: PageColors) -> Self {
        let strokes = match coverage(cell.glyph) {
            Some(Coverage::Even(share)) if !cell.glyph.is_ascii() || share == 0.0 => Strokes::Even(share),
            Some(Coverage::Dots(mask)) => Strokes::Dots(mask),
            _ => Strokes::Letter(cell.glyph),
        };
        Self { ink: colors.ink(cell.ink), paper: colors.paper(cell.paper), strokes }
    }

    fn write_svg(self, [x, y]: [u32; 2], count: u32, page: [u8; 3], out: &mut impl Write) -> io::Result<()> {
        let Self { ink, paper, strokes } = self;
        let (width, height) = (count * CELL.width, CELL.height);
        if paper != page {
            writeln!(out, "{}", rect([x, y], [width, height], paper, 1.0))?;
        }
        match strokes {
            Strokes::Even(0.0) => Ok(()),
            Strokes::Even(share) => writeln!(out, "{}", rect([x, y], [width, height], ink, share)),
            Strokes::Dots(mask) => (0..count).try_for_each(|n| {
                let path: String = dots(mask, [x + n * CELL.width, y]);
                writeln!(out, "<path fill=\"{}\" d=\"{path}\"/>", hex(ink))
            }),
            Strokes::Letter(letter) => (0..count).try_for_each(|n| {
                // The baseline of most fonts is a quarter above the bottom of their line.
                let (x, y, fill) = (x + n * CELL.width, y + 3 * CELL.height / 4, hex(ink));
                writeln!(out, "<text x=\"{x}\" y=\"{y}\" fill=\"{fill}\">{}</text>", escaped(letter))
            }),
        }
    }
}

/// Neighbours that look alike.
struct Run {
    first: u32,
    count: u32,
    shown: Shown,
}

fn runs(row: &[Shown]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (first, &shown) in (0..).zip(row) {
        match runs.last_mut() {
            Some(run) if run.shown == shown => run.count += 1,
            _ => runs.push(Run { first, count: 1, shown }),
        }
    }
    runs
}

fn rect([x, y]: [u32; 2], [width, height]: [u32; 2], fill: [u8; 3], share: f64) -> String {
    let fill = hex(fill);
    // Quarters have two digits.
    let share = if share < 1.0 { format!(" fill-opacity=\"{share}\"") } else { String::new() };
    format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"{share}/>")
}

/// The dots of a mask as squares of a path, in scan order.
fn dots(mask: u8, [x, y]: [u32; 2]) -> String {
    (0..8)
        .filter(|dot| mask >> dot & 1 == 1)
        .map(|dot| format!("M{} {}h{DOT}v{DOT}h-{DOT}z", x + dot % 2 * DOT, y + dot / 2 * DOT))
        .collect()
}

pub(super) fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

pub(super) fn escaped(glyph: char) -> String {
    match glyph {
        '<' => "&lt;".to_owned(),
        '&' => "&amp;".to_owned(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &[(char, Paint, Paint)]) -> Grid<Cell> {
        let cells: Vec<Cell> = cells.iter().map(|&(glyph, ink, paper)| Cell { glyph, ink, paper }).collect();
        Grid::from_values(Size::new(cells.len() as u32, 1), cells)
    }

    fn written(
        write: impl Fn(&Grid<Cell>, Ground, &mut Vec<u8>) -> io::Result<()>,
        cells: &[(char, Paint, Paint)],
    ) -> String {
        let mut out = Vec::new();
        write(&row(cells), Ground::Dark, &mut out).expect("a vector takes every byte");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn blocks_are_squares_and_shades_shares() {
        use Paint::{Black, DarkGray, LightGray, Terminal};
        let cells = [('░', LightGray, DarkGray), ('░', LightGray, DarkGray), ('▘', LightGray, Black)];
        let text = written(svg, &cells);
        let lines: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(
            lines,
            [
                "<rect width=\"30\" height=\"20\" fill=\"#000000\"/>",
                "<rect x=\"0\" y=\"0\" width=\"20\" height=\"20\" fill=\"#555555\"/>",
                "<rect x=\"0\" y=\"0\" width=\"20\" height=\"20\" fill=\"#aaaaaa\" fill-opacity=\"0.25\"/>",
                "<path fill=\"#aaaaaa\" d=\"M20 0h5v5h-5zM20 5h5v5h-5z\"/>",
                "</svg>",
            ]
        );
        let text = written(svg, &[('@', Terminal, Terminal), (' ', Terminal, Terminal)]);
        assert!(text.contains("<text x=\"0\" y=\"15\" fill=\"#ffffff\">@</text>\n</svg>"), "{text}");
    }

    #[test]
    fn a_page_has_the_colours_of_its_runs() {
        use Paint::{Indexed, Rgb};
        let cells = [('▀', Indexed(240), Rgb([1, 2, 3])), ('&', Indexed(240), Rgb([1, 2, 3]))];
        let text = written(html, &cells);
        assert!(
            text.contains("<pre>\n<span style=\"color:#585858;background:#010203\">▀&amp;</span>\n</pre>"),
            "{text}"
        );
    }
}
