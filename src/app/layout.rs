//! Where the panels stand on a screen of any size.

use ratatui::layout::{Rect, Size};

/// The smallest screen that has room for more than the picture.
pub const FULL: Size = Size::new(80, 25);

/// No larger screen is drawn: the columns and rows of an 8K monitor (7680 × 4320) in cells of 4 × 6 pixels. A
/// terminal that reports more is mistaken, and believing it would take gigabytes.
const LARGEST: Size = Size::new(1920, 720);

/// Columns of the flow chart's panel at 80 columns, borders included, and at most: its bars take a part of
/// what a wide screen has to spare.
const CHART_COLUMNS: [u16; 2] = [26, 36];

/// The places of a screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The whole screen.
    pub screen: Rect,
    /// Where the cells of the picture go.
    pub picture: Rect,
    /// The rest; absent on a screen with room for the picture only.
    pub panels: Option<Panels>,
}

/// The places around the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Panels {
    /// The double-line frame.
    pub outer: Rect,
    /// The flow chart with its border.
    pub chart: Rect,
    /// The picture with its border.
    pub picture: Rect,
    /// One row for the figures, inside the double-line frame.
    pub status: Rect,
    /// One row for the function keys, below the frame.
    pub bar: Rect,
}

impl Layout {
    /// The places on a screen of a size that the terminal reported. Where it reported nothing, 80 × 25.
    pub fn new(reported: Size) -> Self {
        let size = if reported.width == 0 || reported.height == 0 { FULL } else { reported };
        let screen = Rect::new(0, 0, size.width.min(LARGEST.width), size.height.min(LARGEST.height));
        if screen.width < FULL.width || screen.height < FULL.height {
            return Self { screen, picture: screen, panels: None };
        }
        let outer = Rect { height: screen.height - 1, ..screen };
        let bar = Rect { y: outer.bottom(), height: 1, ..screen };
        let inner = inside(outer);
        let status = Rect { y: inner.bottom() - 1, height: 1, ..inner };
        let panels = Rect { height: inner.height - 1, ..inner };
        let spare = screen.width - FULL.width;
        let chart_columns = (CHART_COLUMNS[0] + spare / 8).min(CHART_COLUMNS[1]);
        let chart = Rect { width: chart_columns, ..panels };
        let picture = Rect { x: chart.right(), width: panels.width - chart_columns, ..panels };
        let around = Panels { outer, chart, picture, status, bar };
        Self { screen, picture: inside(picture), panels: Some(around) }
    }
}

/// A rectangle without its border of one cell.
const fn inside(area: Rect) -> Rect {
    Rect { x: area.x + 1, y: area.y + 1, width: area.width - 2, height: area.height - 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_full_screen_has_every_panel() {
        let layout = Layout::new(FULL);
        assert_eq!(layout.picture, Rect::new(28, 2, 50, 19));
        let panels = layout.panels.unwrap();
        assert_eq!(panels.status, Rect::new(1, 22, 78, 1));
        assert_eq!(panels.bar, Rect::new(0, 24, 80, 1));
    }

    #[test]
    fn a_large_screen_gives_its_space_to_the_picture() {
        let layout = Layout::new(Size::new(200, 60));
        assert_eq!(layout.picture, Rect::new(38, 2, 160, 54));
    }

    #[test]
    fn a_small_screen_is_all_picture() {
        for size in [Size::new(79, 25), Size::new(80, 24), Size::new(40, 10), Size::new(1, 1)] {
            let layout = Layout::new(size);
            assert_eq!(layout.panels, None);
            assert_eq!(layout.picture.as_size(), size);
        }
    }

    #[test]
    fn no_size_is_taken_as_80_by_25_and_silly_sizes_are_bounded() {
        for size in [Size::new(0, 0), Size::new(0, 25), Size::new(80, 0)] {
            assert_eq!(Layout::new(size), Layout::new(FULL));
        }
        assert_eq!(Layout::new(Size::new(u16::MAX, u16::MAX)).screen.as_size(), LARGEST);
    }
}
