//! What changed between two pictures of levels, in words and as a picture in which the changed cells are
//! marked.

use crate::glyph::{Cell, GlyphMode, Ground, Paint, Palette, compose};
use crate::math::{Grid, Size};
use crate::output;
use crate::tone::{Level, Tone};
use crate::trade::{LevelDifference, cells_apart};

use super::arguments::ComparisonArguments;
use super::error::CliError;
use super::picture::no_color;
use super::terminal;

/// The most columns of a marked picture: those of a terminal. A larger one is shown smaller.
const COLUMNS: u32 = 80;
/// And the most rows: some screens of them.
const ROWS: u32 = 120;

/// Black on yellow, by xterm's numbers.
const MARK: [Paint; 2] = [Paint::Indexed(16), Paint::Indexed(226)];

/// Where the edge of a picture cuts a cell.
const BLANK: Cell = Cell { glyph: ' ', ink: Paint::Terminal, paper: Paint::Terminal };

/// How a picture is shown in which changes are marked.
#[derive(Clone, Copy, Debug)]
pub struct Marking {
    /// Dots that differ by no more levels count as the same.
    pub tolerance: u8,
    /// Characters.
    pub glyphs: GlyphMode,
    /// What the terminal's own paper is taken for.
    pub ground: Ground,
}

impl ComparisonArguments {
    /// How changes are marked.
    pub fn marking(&self) -> Marking {
        let glyphs = self.picture.look(None).glyphs;
        Marking { tolerance: self.tolerance, glyphs, ground: self.picture.ground() }
    }
}

/// A line that says how many dots differ, and by how much.
pub fn summary(difference: &LevelDifference, tolerance: u8) -> String {
    let (all, changed) = (difference.all(), difference.beyond(0));
    if changed == 0 {
        return format!("the same {all} dots");
    }
    let by: Vec<String> = (1..=12)
        .filter(|&levels| difference.off_by(levels) > 0)
        .map(|levels| format!("{} by {levels}", difference.off_by(levels)))
        .collect();
    let share = 100.0 * changed as f64 / all as f64;
    let within = if difference.beyond(tolerance) == 0 { ", within the tolerance" } else { "" };
    format!("{changed} of {all} dots differ ({share:.2} %), in levels: {}{within}", by.join(", "))
}

/// The picture, where a cell of which a dot differs by more than is tolerated has in place of its character
/// by how many levels, as a digit of 1 to C.
pub fn picture(own: &Grid<Level>, reference: &Grid<Level>, marking: Marking) -> Result<Vec<u8>, CliError> {
    let Marking { tolerance, glyphs, ground } = marking;
    let per_cell = glyphs.dots_per_cell();
    let Size { width, height } = own.size();
    let smaller =
        width.div_ceil(per_cell.width * COLUMNS).max(height.div_ceil(per_cell.height * ROWS)).max(1);
    let light = shrunk(own, smaller);
    let shown = compose(&light, glyphs, Palette::Mono(ground), Tone::Lightness);
    let apart = cells_apart(own, reference, Size::new(per_cell.width * smaller, per_cell.height * smaller));
    let is_colored = !no_color() && terminal::of_output().is_some_and(output::Capabilities::has_256_colors);
    let size = apart.size();
    let cells = Grid::from_fn(size, |column, row| {
        let levels = apart[(column, row)];
        // What the edge cuts has no whole cell of its own.
        let is_whole = column < shown.size().width && row < shown.size().height;
        let cell = if is_whole { shown[(column, row)] } else { BLANK };
        match Level::new(levels) {
            Some(level) if levels > tolerance => {
                let [ink, paper] = if is_colored { MARK } else { [cell.ink, cell.paper] };
                Cell { glyph: level.digit(), ink, paper }
            }
            _ => cell,
        }
    });
    let mut out = Vec::new();
    let written = if is_colored { output::ansi(&cells, &mut out) } else { output::text(&cells, &mut out) };
    written.map_err(|e| CliError::Output(format!("the picture could not be encoded: {e}")))?;
    Ok(out)
}

/// The light of a picture with so many times fewer dots along each side: the mean of each square.
fn shrunk(levels: &Grid<Level>, by: u32) -> Grid<f64> {
    let Size { width, height } = levels.size();
    Grid::from_fn(Size::new(width / by, height / by), |column, row| {
        let dots =
            (row * by..(row + 1) * by).flat_map(|y| (column * by..(column + 1) * by).map(move |x| (x, y)));
        dots.map(|dot| levels[dot].light()).sum::<f64>() / f64::from(by * by)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::read_levels;

    const PLAIN: Marking = Marking { tolerance: 0, glyphs: GlyphMode::Blocks, ground: Ground::Dark };

    fn grid(text: &str) -> Grid<Level> {
        read_levels(text.as_bytes()).unwrap()
    }

    #[test]
    fn changed_cells_say_by_how_much() {
        let rows = |row: &str| grid(&format!("{row}\n").repeat(8));
        let (own, reference) = (rows("CC00000"), rows("CC0030B"));
        let marked =
            |marking: Marking| String::from_utf8(picture(&own, &reference, marking).unwrap()).unwrap();
        let text = marked(PLAIN);
        assert_eq!(text.lines().map(str::trim_end).collect::<Vec<_>>(), ["█ 3B", "█ 3B"]);
        let text = marked(Marking { tolerance: 3, ..PLAIN });
        assert_eq!(text.lines().next().map(str::trim_end), Some("█  B"));
    }

    #[test]
    fn the_picture_has_the_characters_and_the_paper_that_are_asked_for() {
        let own = grid(&"0000CCCC\n".repeat(8));
        let marked = |glyphs, ground| {
            String::from_utf8(picture(&own, &own, Marking { glyphs, ground, ..PLAIN }).unwrap()).unwrap()
        };
        let [dark, light] = [Ground::Dark, Ground::Light].map(|ground| marked(GlyphMode::Ascii, ground));
        let backward =
            |text: &str| text.lines().map(|line| line.chars().rev().collect()).collect::<Vec<String>>();
        assert!(dark.is_ascii() && dark != light, "{dark}{light}");
        assert_eq!(backward(&dark), light.lines().collect::<Vec<_>>());
        assert!(marked(GlyphMode::Braille, Ground::Dark).contains('\u{28ff}'));
    }

    #[test]
    fn large_pictures_are_shown_smaller() {
        let own = grid(&format!("{}\n", "C".repeat(1000)).repeat(100));
        let text = String::from_utf8(picture(&own, &own, PLAIN).unwrap()).unwrap();
        let widths: Vec<usize> = text.lines().map(|line| line.chars().count()).collect();
        assert!(widths.iter().all(|&width| width <= COLUMNS as usize), "{widths:?}");
    }

    #[test]
    fn the_line_says_how_many_by_how_much() {
        let difference = LevelDifference::between(&grid("0123"), &grid("0134")).unwrap();
        assert_eq!(summary(&difference, 0), "2 of 4 dots differ (50.00 %), in levels: 2 by 1");
        assert!(summary(&difference, 1).ends_with("within the tolerance"));
        let same = LevelDifference::between(&grid("01"), &grid("01")).unwrap();
        assert_eq!(summary(&same, 0), "the same 2 dots");
    }
}
