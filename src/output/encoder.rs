//! Two screens to the bytes that turn one into the other: what is sent to a terminal, in a still and in the
//! viewer alike.

use super::cursor::{Hop, Place};
use super::route::Route;
use super::screen::{Screen, ScreenCell, Spelling};
use super::sgr::Pen;
use crate::glyph::Cell;
use crate::math::Grid;

/// The bytes for a terminal, and what it writes with after them.
#[derive(Debug)]
pub struct Encoder {
    pen: Pen,
    bytes: String,
}

impl Default for Encoder {
    fn default() -> Self {
        Self { pen: Pen::TERMINAL, bytes: String::new() }
    }
}

impl Encoder {
    /// Forgets what the terminal writes with, and clears it.
    pub fn clear(&mut self) {
        self.pen = Pen::TERMINAL;
        self.bytes.push_str("\x1b[m\x1b[2J");
    }

    /// Appends what draws a whole screen where the terminal has been cleared.
    pub fn draw(&mut self, screen: &impl Screen) {
        self.change(None::<&Grid<Cell>>, screen);
    }

    /// Appends what turns a screen that shows `before` into one that shows `after`.
    ///
    /// # Panics
    /// Where they differ in size: an error of the caller.
    pub fn turn(&mut self, before: &impl Screen, after: &impl Screen) {
        assert_eq!(before.size(), after.size(), "a screen turns into one of its size");
        self.change(Some(before), after);
    }

    fn change(&mut self, before: Option<&impl Screen>, after: &impl Screen) {
        let mut route = Route::new(self.pen);
        // Somebody else may have moved the cursor: a place is absolute first.
        let mut cursor = None;
        for y in 0..after.size().height {
            Row::new(before, after, y).write(y, &mut route, &mut cursor);
        }
        self.pen = route.write(&mut self.bytes);
    }

    /// Appends a row from its first column to its last where the cursor is, for who reads it as text: without
    /// moves, and in the terminal's own colours at the end, so that nothing beyond it is painted.
    pub(super) fn row(&mut self, screen: &impl Screen, y: u32) {
        let mut route = Route::new(self.pen);
        let row = Row::new(None::<&Grid<Cell>>, screen, y);
        for place in 0..row.cells.len() {
            row.put(place, &mut route);
        }
        route.end_with(Pen::TERMINAL);
        self.pen = route.write(&mut self.bytes);
    }

    /// How many bytes there are.
    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// Takes the bytes out.
    pub fn take(&mut self) -> String {
        std::mem::take(&mut self.bytes)
    }
}

/// A row of the screen that is meant.
struct Row<'a> {
    cells: Vec<RowCell<'a>>,
    /// From which cell on all are as erasing leaves them.
    clear_from: usize,
}

struct RowCell<'a> {
    look: ScreenCell<'a>,
    /// Its first column.
    x: u32,
    is_changed: bool,
    /// The pens of the next cell behind it that changes and shows all of its pen, in each of its spellings:
    /// what cannot be seen here is told as it will be there.
    coming: [Pen; 2],
    is_beside_blocks: bool,
}

impl<'a> Row<'a> {
    fn new(before: Option<&impl Screen>, after: &'a impl Screen, y: u32) -> Self {
        let width = after.size().width;
        let mut cells = Vec::with_capacity(width as usize);
        let mut x = 0;
        while x < width {
            let look = after.look(x, y);
            let shown = before.map_or(ScreenCell::CLEAR, |before| before.look(x, y));
            // The second column of a wide character is nobody's when that goes.
            let is_orphan =
                x > 0 && before.is_some_and(|before| !before.look(x - 1, y).symbol.is_one_column());
            let is_changed = is_orphan || shown.seen() != look.seen();
            cells.push(RowCell { look, x, is_changed, coming: [Pen::TERMINAL; 2], is_beside_blocks: false });
            x += look.columns.max(1);
        }
        let clear = cells.iter().rev().take_while(|cell| cell.look.is_clear()).count();
        let mut row = Self { clear_from: cells.len() - clear, cells };
        row.look_around();
        row
    }

    fn look_around(&mut self) {
        let is_block = |cell: Option<&RowCell<'_>>| cell.is_some_and(|cell| cell.look.symbol.is_block());
        let mut coming = None;
        for place in (0..self.cells.len()).rev() {
            let before = place.checked_sub(1).and_then(|place| self.cells.get(place));
            let beside = is_block(before) || is_block(self.cells.get(place + 1));
            let cell = &mut self.cells[place];
            cell.is_beside_blocks = beside;
            cell.coming = coming.unwrap_or([cell.look.pen; 2]);
            if let (true, Some(pen)) = (cell.is_changed, cell.look.spelling().whole_pen()) {
                let other = cell.look.other_spelling(beside).and_then(|spelling| spelling.whole_pen());
                coming = Some([pen, other.unwrap_or(pen)]);
            }
        }
    }

    /// Writes what has changed, by whichever way is shortest.
    fn write(&self, y: u32, route: &mut Route<'a>, cursor: &mut Option<Place>) {
        let mut next = 0;
        for place in (0..self.cells.len()).filter(|&place| self.cells[place].is_changed) {
            self.reach(next..place, y, route, *cursor);
            let x = self.cells[place].x;
            if place >= self.clear_from && self.is_longer_than_erasing(place) {
                route.erase();
                *cursor = Some((x, y));
                return;
            }
            self.put(place, route);
            next = place + 1;
            *cursor = self.cells.get(next).filter(|_| self.is_one_column(place)).map(|cell| (cell.x, y));
        }
    }

    /// Comes to the cell behind some that have not changed: past them, or by writing them again.
    fn reach(&self, gap: std::ops::Range<usize>, y: u32, route: &mut Route<'a>, cursor: Option<Place>) {
        let hop = Hop::shortest(cursor, (self.cells[gap.end].x, y));
        let is_near = matches!(hop, Hop::Right(_))
            && gap.clone().map(|place| self.least_bytes(place)).sum::<u32>() < hop.bytes()
            && gap.clone().all(|place| self.is_one_column(place));
        if !is_near {
            return route.go(hop);
        }
        let here = route.put_aside();
        route.go(hop);
        let past = route.swap(here);
        for place in gap {
            self.put(place, route);
        }
        route.join(past);
    }

    fn put(&self, place: usize, route: &mut Route<'a>) {
        let cell = &self.cells[place];
        route.put(&self.spellings(place), &cell.coming);
    }

    fn spellings(&self, place: usize) -> impl Iterator<Item = Spelling<'a>> + Clone {
        let cell = &self.cells[place];
        std::iter::once(cell.look.spelling()).chain(cell.look.other_spelling(cell.is_beside_blocks))
    }

    fn least_bytes(&self, place: usize) -> u32 {
        self.spellings(place).map(|spelling| spelling.symbol.bytes()).min().unwrap_or(0)
    }

    fn is_one_column(&self, place: usize) -> bool {
        self.cells[place].look.symbol.is_one_column()
    }

    /// Whether to write blanks to the end of the line, from a changed one, takes more than to erase it does:
    /// one byte for each, and between them what is shorter, blanks or a move.
    fn is_longer_than_erasing(&self, place: usize) -> bool {
        let (mut bytes, mut gap) = (0, 0);
        for cell in &self.cells[place..] {
            if cell.is_changed {
                bytes += 1 + Hop::Right(gap).bytes().min(gap);
                gap = 0;
            } else {
                gap += 1;
            }
        }
        bytes > Route::ERASE_BYTES
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::Paint::{self, Black, DarkGray, LightGray, Terminal, White};
    use crate::math::Size;

    /// A row of cells.
    fn row(cells: &[(&str, Paint, Paint)]) -> Grid<Cell> {
        let cells: Vec<Cell> = cells
            .iter()
            .flat_map(|&(text, ink, paper)| text.chars().map(move |glyph| Cell { glyph, ink, paper }))
            .collect();
        Grid::from_values(Size::new(cells.len() as u32, 1), cells)
    }

    fn plain(text: &str) -> Grid<Cell> {
        row(&[(text, Terminal, Terminal)])
    }

    fn turned(before: &Grid<Cell>, after: &Grid<Cell>) -> String {
        let mut encoder = Encoder::default();
        encoder.turn(before, after);
        encoder.take()
    }

    fn drawn(screen: &Grid<Cell>) -> String {
        let mut encoder = Encoder::default();
        encoder.draw(screen);
        encoder.take()
    }

    #[test]
    fn what_looks_the_same_is_not_sent() {
        let equals = [
            (("a", White, Black), ("a", White, Black)),
            ((" ", White, Black), (" ", LightGray, Black)),
            ((" ", White, LightGray), ("█", LightGray, Black)),
            (("█", White, Black), ("█", White, LightGray)),
            (("▀", White, Black), ("▄", Black, White)),
        ];
        for (before, after) in equals {
            assert_eq!(turned(&row(&[before]), &row(&[after])), "", "{before:?} {after:?}");
        }
        // The terminal's own ink is not its own paper.
        assert_ne!(turned(&plain("▀"), &plain("▄")), "");
        assert_eq!(drawn(&plain("   ")), "");
    }

    #[test]
    fn what_stands_between_is_written_again_where_that_is_shorter() {
        assert_eq!(turned(&plain("a─b"), &plain("x─x")), "\x1b[Hx\x1b[Cx");
        assert_eq!(turned(&plain("abcb"), &plain("xbcx")), "\x1b[Hxbcx");
        assert_eq!(turned(&plain("abcdefgh"), &plain("xbcdefgx")), "\x1b[Hx\x1b[6Cx");
        // Not where it would take its colour back and forth.
        let between = |end: &str| row(&[(end, Black, White), ("b", White, Black), (end, Black, White)]);
        assert_eq!(turned(&between("a"), &between("x")), "\x1b[H\x1b[30;107mx\x1b[Cx");
    }

    #[test]
    fn a_colour_is_told_with_another_before_it_shows() {
        let cells = row(&[(" ", DarkGray, Black), (" ", DarkGray, Black), ("▒", LightGray, Black)]);
        assert_eq!(drawn(&cells), "\x1b[H\x1b[37;40m  ▒");
    }

    #[test]
    fn a_glyph_is_the_one_that_needs_no_other_colours() {
        let shade = ("░", DarkGray, Black);
        let flat = |around| row(&[around, (" ", DarkGray, DarkGray), around]);
        assert_eq!(drawn(&flat(shade)), "\x1b[H\x1b[90;40m░█░");
        assert_eq!(drawn(&flat(("x", DarkGray, Black))), "\x1b[H\x1b[90;40mx\x1b[100m \x1b[40mx", "in text");
        let halves = row(&[("▀", LightGray, Black), ("▄", Black, LightGray)]);
        assert_eq!(drawn(&halves), "\x1b[H\x1b[30;47m▄▄");
        let bright = row(&[("▀", Black, LightGray), ("▄", White, LightGray)]);
        assert_eq!(drawn(&bright), "\x1b[H\x1b[30;47m▀\x1b[97m▄", "no bright paper");
    }

    #[test]
    fn the_end_of_a_line_is_erased_on_the_terminal_s_own_paper_only() {
        assert_eq!(turned(&plain("abcdef"), &plain("abc   ")), "\x1b[1;4H   ");
        assert_eq!(turned(&plain("abcdef"), &plain("ab    ")), "\x1b[1;3H\x1b[K");
        let black = |text: &str| row(&[(text, White, Black)]);
        assert_eq!(turned(&black("abcdef"), &black("ab    ")), "\x1b[1;3H\x1b[40m    ");
    }

    #[test]
    #[should_panic(expected = "a screen turns into one of its size")]
    fn another_size_is_another_screen() {
        turned(&plain("ab"), &plain("abc"));
    }
}
