//! The picture: cells of glyph, ink and paper as ratatui cells.

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::{Color, Modifier};
use ratatui_core::widgets::Widget;

use crate::glyph::{Cell, Paint};
use crate::math::Grid;

/// The cells of a finished frame, from the top left corner of the area; what does not fit is cut off.
#[derive(Clone, Copy, Debug)]
pub struct PictureWidget<'a>(pub &'a Grid<Cell>);

impl Widget for PictureWidget<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        (&self).render(area, buffer);
    }
}

impl Widget for &PictureWidget<'_> {
    fn render(self, area: Rect, buffer: &mut Buffer) {
        let area = area.intersection(buffer.area);
        for (y, row) in (area.top()..area.bottom()).zip(self.0.rows()) {
            for (x, cell) in (area.left()..area.right()).zip(row) {
                let place = &mut buffer[(x, y)];
                place.set_char(cell.glyph).set_fg(color(cell.ink)).set_bg(color(cell.paper));
                place.modifier = Modifier::empty();
            }
        }
    }
}

/// The attribute of the 16-colour set, or the colour by number. ratatui calls attribute 7 `Gray`.
const fn color(paint: Paint) -> Color {
    match paint {
        Paint::Terminal => Color::Reset,
        Paint::Black => Color::Black,
        Paint::DarkGray => Color::DarkGray,
        Paint::LightGray => Color::Gray,
        Paint::White => Color::White,
        Paint::Indexed(index) => Color::Indexed(index),
        Paint::Rgb([r, g, b]) => Color::Rgb(r, g, b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Size;

    fn cells(width: u32, height: u32) -> Grid<Cell> {
        Grid::filled(
            Size::new(width, height),
            Cell { glyph: '▓', ink: Paint::White, paper: Paint::LightGray },
        )
    }

    #[test]
    fn every_paint_has_its_attribute() {
        let paints = [Paint::Terminal, Paint::Black, Paint::DarkGray, Paint::LightGray, Paint::White];
        let colors = [Color::Reset, Color::Black, Color::DarkGray, Color::Gray, Color::White];
        assert_eq!(paints.map(color), colors);
        assert_eq!(color(Paint::Indexed(240)), Color::Indexed(240));
        assert_eq!(color(Paint::Rgb([1, 2, 3])), Color::Rgb(1, 2, 3));
    }

    #[test]
    fn a_cell_keeps_its_glyph_ink_and_paper() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 3));
        PictureWidget(&cells(1, 1)).render(Rect::new(2, 1, 2, 2), &mut buffer);
        let cell = &buffer[(2, 1)];
        assert_eq!((cell.symbol(), cell.fg, cell.bg), ("▓", Color::White, Color::Gray));
        assert_eq!(buffer[(3, 1)].symbol(), " ", "nothing beyond the picture is touched");
    }

    #[test]
    fn a_picture_larger_than_the_area_is_cut_off() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 3));
        PictureWidget(&cells(9, 9)).render(Rect::new(1, 1, 2, 9), &mut buffer);
        assert_eq!(buffer[(2, 2)].symbol(), "▓");
        assert_eq!(buffer[(3, 2)].symbol(), " ");
        PictureWidget(&cells(0, 0)).render(buffer.area, &mut buffer);
    }
}
