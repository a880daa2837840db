//! Screens of cells as one SVG that moves, for where neither a script nor a terminal is at hand, such as a
//! README.
//!
//! Screens lie one above the other, and one at a time is visible, by a style sheet and without a script. Each
//! is a handful of paths, one for a colour, whose horizontal strokes are runs of equal cells: a stroke as
//! high as what it draws is a third of the text of a rectangle. A shade is the one colour that it is from
//! afar.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::markup::{PageColors, Shown, Strokes, escaped, hex};
use crate::glyph::{Cell, Ground};
use crate::math::{Grid, Size};

/// A cell in units of the page: one dot of its 2 × 4 is a square of 2, whose middle is a whole number.
const CELL: [u32; 2] = [4, 8];

/// The heights of strokes: of a cell, half of one, and a dot. The letters are their classes.
const HEIGHTS: [(char, u32); 3] = [('a', 8), ('b', 4), ('c', 2)];

/// The screens as an SVG that shows them one after the other, so many a second, for ever. Who wants less
/// motion, and who knows of none, sees the first. Where cells are in the terminal's own colours, `ground` is
/// the page's.
pub fn animated_svg(
    screens: &[Grid<Cell>],
    ground: Ground,
    fps: f64,
    out: &mut impl Write,
) -> io::Result<()> {
    let size = screens.first().map_or(Size::new(0, 0), Grid::size);
    let (across, down) = (size.width * CELL[0], size.height * CELL[1]);
    let page = PageColors::of(ground);
    let count = screens.len().max(1) as f64;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {across} {down}\" font-family=\"monospace\" \
         font-size=\"6.4\" shape-rendering=\"crispEdges\">"
    )?;
    write!(out, "<style>path{{fill:none}}")?;
    for (class, height) in HEIGHTS {
        write!(out, ".{class}{{stroke-width:{height}px}}")?;
    }
    // Rounded up, so that no moment is without a screen.
    let share = (1e6 / count).ceil() / 1e4;
    write!(
        out,
        ".f{{visibility:hidden;animation:f {}s step-end infinite}}@keyframes f{{0%{{visibility:visible}}\
         {share}%,to{{visibility:hidden}}}}@media(prefers-reduced-motion:reduce){{.f{{animation:none}}}}",
        seconds(count / fps)
    )?;
    writeln!(out, "</style>")?;
    writeln!(out, "<rect width=\"{across}\" height=\"{down}\" fill=\"{}\"/>", short(page.paper))?;
    for (n, screen) in screens.iter().enumerate() {
        let style = if n == 0 {
            "visibility:visible".to_owned()
        } else {
            format!("animation-delay:{}s", seconds(n as f64 / fps))
        };
        write!(out, "<g class=\"f\" style=\"{style}\">")?;
        Strata::of(screen, page).write(out)?;
        writeln!(out, "</g>")?;
    }
    writeln!(out, "</svg>")
}

type Rgb = [u8; 3];

/// What is drawn of a screen: strokes of each height by their colour, and letters.
struct Strata {
    strokes: [BTreeMap<Rgb, Strokeful>; 3],
    letters: String,
}

impl Strata {
    fn of(screen: &Grid<Cell>, page: PageColors) -> Self {
        let mut strata = Self { strokes: Default::default(), letters: String::new() };
        for (y, row) in (0..).zip(screen.rows()) {
            let looks: Vec<Look> = row.iter().map(|&cell| Look::of(Shown::of(cell, page))).collect();
            // Two columns of dots to a cell; half cells and dots only where they differ from what is below.
            let columns = 2 * looks.len();
            let whole = |x: usize| Some(looks[x / 2].below(x % 2)).filter(|color| *color != page.paper);
            strata.runs(0, [y, 8, 4], columns, whole);
            for half in 0..2 {
                let pair = |x: usize| looks[x / 2].pair(2 * half, x % 2);
                strata.runs(1, [2 * y + half as u32, 4, 2], columns, pair);
                for dot in 2 * half..2 * half + 2 {
                    let single = |x: usize| looks[x / 2].single(dot, x % 2);
                    strata.runs(2, [4 * y + dot as u32, 2, 1], columns, single);
                }
            }
            strata.letter_runs(y, &looks);
        }
        strata
    }

    /// Strokes for the columns of equal colour. The row is that of a grid of rows so high, with its middle
    /// so far down in it.
    fn runs(
        &mut self,
        stratum: usize,
        [row, height, middle]: [u32; 3],
        columns: usize,
        color: impl Fn(usize) -> Option<Rgb>,
    ) {
        let y = row * height + middle;
        let mut x = 0;
        while x < columns {
            let here = color(x);
            let end = (x + 1..columns).find(|&x| color(x) != here).unwrap_or(columns);
            if let Some(here) = here {
                let [from, length] = [x, end - x].map(|n| 2 * n as u32);
                self.strokes[stratum].entry(here).or_default().draw([from, y], length);
            }
            x = end;
        }
    }

    fn letter_runs(&mut self, y: u32, looks: &[Look]) {
        let mut x = 0;
        while x < looks.len() {
            let Some((ink, _)) = looks[x].letter else {
                x += 1;
                continue;
            };
            let alike = looks[x..].iter().map_while(|look| look.letter.filter(|letter| letter.0 == ink));
            let run: Vec<char> = alike.map(|(_, letter)| letter).collect();
            let text: String = run.iter().map(|&letter| escaped(letter)).collect();
            let length = run.len() as u32 * CELL[0];
            // The baseline of most fonts is a quarter above the bottom of their line.
            let (left, base) = (x as u32 * CELL[0], y * CELL[1] + 3 * CELL[1] / 4);
            self.letters += &format!(
                "<text x=\"{left}\" y=\"{base}\" textLength=\"{length}\" fill=\"{}\">{text}</text>",
                short(ink)
            );
            x += run.len();
        }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for (strokes, (class, _)) in self.strokes.iter().zip(HEIGHTS) {
            if strokes.is_empty() {
                continue;
            }
            write!(out, "<g class=\"{class}\">")?;
            for (color, path) in strokes {
                write!(out, "<path stroke=\"{}\" d=\"{}\"/>", short(*color), path.text)?;
            }
            write!(out, "</g>")?;
        }
        out.write_all(self.letters.as_bytes())
    }
}

/// What is drawn of a cell, in dots.
struct Look {
    ink: Rgb,
    paper: Rgb,
    /// The dots in the ink.
    mask: u8,
    letter: Option<(Rgb, char)>,
}

/// The dots of the left column in a mask.
const LEFT: u8 = 0b0101_0101;

impl Look {
    fn of(Shown { ink, paper, strokes }: Shown) -> Self {
        match strokes {
            Strokes::Even(share) => {
                let mix = |ink: u8, paper: u8| {
                    let [ink, paper] = [ink, paper].map(f64::from);
                    (paper + share * (ink - paper)).round() as u8
                };
                let mixed = std::array::from_fn(|k| mix(ink[k], paper[k]));
                Self { ink: mixed, paper: mixed, mask: 0, letter: None }
            }
            Strokes::Dots(mask) => Self { ink, paper, mask, letter: None },
            Strokes::Letter(letter) => Self { ink, paper, mask: 0, letter: Some((ink, letter)) },
        }
    }

    fn column(&self, column: usize) -> u8 {
        self.mask >> column & LEFT
    }

    /// The colour of a column from top to bottom: the ink where all of its dots have it.
    fn below(&self, column: usize) -> Rgb {
        if self.column(column) == LEFT { self.ink } else { self.paper }
    }

    fn has(&self, row: usize, column: usize) -> bool {
        self.column(column) != LEFT && self.column(column) >> (2 * row) & 1 == 1
    }

    /// The ink where this row and the one below both have it, and are half a cell together.
    fn pair(&self, row: usize, column: usize) -> Option<Rgb> {
        (self.has(row, column) && self.has(row + 1, column)).then_some(self.ink)
    }

    /// The ink where this row of two has it, and the other has not.
    fn single(&self, row: usize, column: usize) -> Option<Rgb> {
        (self.has(row, column) && !self.has(row ^ 1, column)).then_some(self.ink)
    }
}

/// The strokes of a colour, as the text of a path.
#[derive(Default)]
struct Strokeful {
    text: String,
    at: [u32; 2],
}

impl Strokeful {
    fn draw(&mut self, [x, y]: [u32; 2], length: u32) {
        let [dx, dy] = [(x, self.at[0]), (y, self.at[1])].map(|(to, from)| i64::from(to) - i64::from(from));
        // A sign keeps two numbers apart as well as a blank does.
        let gap = if dy < 0 { "" } else { " " };
        let (near, far) = (format!("m{dx}{gap}{dy}"), format!("M{x} {y}"));
        let way = if self.text.is_empty() || far.len() < near.len() { far } else { near };
        self.text += &format!("{way}h{length}");
        self.at = [x + length, y];
    }
}

/// A colour in as few digits as it needs.
fn short(color: Rgb) -> String {
    if color.iter().all(|byte| byte % 17 == 0) {
        let [r, g, b] = color.map(|byte| byte / 17);
        return format!("#{r:x}{g:x}{b:x}");
    }
    hex(color)
}

/// A time to within a tenth of a millisecond, without zeros that say nothing.
fn seconds(time: f64) -> f64 {
    (time * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Paint::{self, Black, LightGray, Terminal};

    fn written(screens: &[&[(char, Paint, Paint)]]) -> String {
        let row = |cells: &&[(char, Paint, Paint)]| {
            let cells: Vec<Cell> =
                cells.iter().map(|&(glyph, ink, paper)| Cell { glyph, ink, paper }).collect();
            Grid::from_values(Size::new(cells.len() as u32, 1), cells)
        };
        let screens: Vec<Grid<Cell>> = screens.iter().map(row).collect();
        let mut out = Vec::new();
        animated_svg(&screens, Ground::Dark, 4.0, &mut out).expect("a vector takes every byte");
        String::from_utf8(out).expect("text")
    }

    #[test]
    fn screens_follow_each_other_in_strokes_of_one_colour() {
        let shade = ('▒', LightGray, Black);
        let text = written(&[
            &[shade, shade, (' ', Black, Black), ('▌', LightGray, Black)],
            &[('▀', LightGray, Black), ('▀', LightGray, Black), ('▂', LightGray, Black), shade],
        ]);
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(
            lines,
            [
                "<rect width=\"16\" height=\"8\" fill=\"#000\"/>",
                "<g class=\"f\" style=\"visibility:visible\"><g class=\"a\"><path stroke=\"#555\" d=\"M0 4h8\"/>\
                 <path stroke=\"#aaa\" d=\"M12 4h2\"/></g></g>",
                "<g class=\"f\" style=\"animation-delay:0.25s\"><g class=\"a\"><path stroke=\"#555\" \
                 d=\"M12 4h4\"/></g><g class=\"b\"><path stroke=\"#aaa\" d=\"M0 2h8\"/></g>\
                 <g class=\"c\"><path stroke=\"#aaa\" d=\"M8 7h4\"/></g></g>",
                "</svg>",
            ]
        );
        assert!(text.contains("animation:f 0.5s step-end infinite") && text.contains("50%,to{"), "{text}");
    }

    #[test]
    fn letters_stay_letters() {
        let text = written(&[&[('@', Terminal, Terminal), ('<', Terminal, Terminal)]]);
        let letters = "<text x=\"0\" y=\"6\" textLength=\"8\" fill=\"#fff\">@&lt;</text>";
        assert!(text.contains(letters), "{text}");
    }

    #[test]
    fn no_screen_is_a_page_all_the_same() {
        assert!(written(&[]).ends_with("</svg>\n"));
    }
}
