//! Where the panels stand on a screen of any size.

use ratatui::layout::{Rect, Size};

/// What is taken for the size of a terminal that reports none: the screen of the PC.
const USUAL: Size = Size::new(80, 25);

/// The smallest screen that has every panel: with 20 columns less the figures of the status line would not
/// fit, with a row less the flow chart would have more of the screen than the picture.
pub const FULL: Size = Size::new(80, 24);

/// The smallest screen that has a title and the function keys besides the picture: two of these keys and the
/// program's name fit in its columns, and most of its rows are the picture's.
pub const TITLED: Size = Size::new(20, 5);

/// No larger screen is drawn: the columns and rows of an 8K monitor (7680 × 4320) in cells of 4 × 6 pixels. A
/// terminal that reports more is mistaken, and believing it would take gigabytes.
const LARGEST: Size = Size::new(1920, 720);

/// Columns of the flow chart's panel at 80 columns, borders included, and at most: its bars take a part of
/// what a wide screen has to spare.
const CHART_COLUMNS: [u16; 2] = [26, 36];

/// Whether panels are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Panelling {
    /// Where they have room.
    #[default]
    WherePossible,
    /// Nowhere: the screen is the picture's.
    Never,
}

impl Panelling {
    /// The other.
    pub const fn other(self) -> Self {
        match self {
            Self::WherePossible => Self::Never,
            Self::Never => Self::WherePossible,
        }
    }
}

/// The places of a screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The whole screen.
    pub screen: Rect,
    /// Where the cells of the picture go.
    pub picture: Rect,
    /// The rest.
    pub around: Around,
}

/// What stands around the picture, by how much room there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Around {
    /// Room for the picture only.
    Nothing,
    /// A row above it and one below it.
    Rows(Rows),
    /// Everything.
    Panels(Panels),
}

/// The rows above and below the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rows {
    /// The title.
    pub title: Rect,
    /// The function keys.
    pub bar: Rect,
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
    pub fn new(reported: Size, panelling: Panelling) -> Self {
        let size = if reported.width == 0 || reported.height == 0 { USUAL } else { reported };
        let screen = Rect::new(0, 0, size.width.min(LARGEST.width), size.height.min(LARGEST.height));
        let fits = |least: Size| screen.width >= least.width && screen.height >= least.height;
        if fits(FULL) && panelling == Panelling::WherePossible {
            let panels = Panels::on(screen);
            Self { screen, picture: inside(panels.picture), around: Around::Panels(panels) }
        } else if fits(TITLED) {
            let title = Rect { height: 1, ..screen };
            let bar = Rect { y: screen.bottom() - 1, height: 1, ..screen };
            let picture = Rect { y: title.bottom(), height: screen.height - 2, ..screen };
            Self { screen, picture, around: Around::Rows(Rows { title, bar }) }
        } else {
            Self { screen, picture: screen, around: Around::Nothing }
        }
    }
}

impl Layout {
    /// The rows that what is opened may stand over: title, figures and function keys stay.
    pub fn body(&self) -> Rect {
        match &self.around {
            Around::Panels(panels) => panels.chart.union(panels.picture),
            Around::Rows(_) | Around::Nothing => self.picture,
        }
    }
}

impl Panels {
    /// All of them, on a screen that has the room.
    fn on(screen: Rect) -> Self {
        let outer = Rect { height: screen.height - 1, ..screen };
        let bar = Rect { y: outer.bottom(), height: 1, ..screen };
        let inner = inside(outer);
        let status = Rect { y: inner.bottom() - 1, height: 1, ..inner };
        let panels = Rect { height: inner.height - 1, ..inner };
        let spare = screen.width - FULL.width;
        let chart_columns = (CHART_COLUMNS[0] + spare / 8).min(CHART_COLUMNS[1]);
        let chart = Rect { width: chart_columns, ..panels };
        let picture = Rect { x: chart.right(), width: panels.width - chart_columns, ..panels };
        Self { outer, chart, picture, status, bar }
    }
}

/// A rectangle without its border of one cell.
pub const fn inside(area: Rect) -> Rect {
    Rect { x: area.x + 1, y: area.y + 1, width: area.width - 2, height: area.height - 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(size: Size) -> Layout {
        Layout::new(size, Panelling::WherePossible)
    }

    #[test]
    fn the_smallest_full_screen_has_every_panel() {
        for (height, status) in [(24, 21), (25, 22)] {
            let layout = layout(Size::new(80, height));
            assert_eq!(layout.picture, Rect::new(28, 2, 50, height - 6));
            let Around::Panels(panels) = layout.around else { panic!("panels") };
            assert_eq!(panels.status, Rect::new(1, status, 78, 1));
            assert_eq!(panels.bar, Rect::new(0, height - 1, 80, 1));
        }
    }

    #[test]
    fn a_large_screen_gives_its_space_to_the_picture() {
        let layout = layout(Size::new(200, 60));
        assert_eq!(layout.picture, Rect::new(38, 2, 160, 54));
    }

    #[test]
    fn a_small_screen_keeps_its_title_and_its_keys() {
        for size in
            [Size::new(79, 25), Size::new(80, 23), Size::new(40, 10), Size::new(20, 5), Size::new(200, 5)]
        {
            let layout = layout(size);
            let Around::Rows(Rows { title, bar }) = layout.around else { panic!("rows at {size}") };
            assert_eq!([title.y, bar.y], [0, size.height - 1]);
            assert_eq!(layout.picture, Rect::new(0, 1, size.width, size.height - 2));
        }
    }

    #[test]
    fn without_panels_the_picture_has_all_but_two_rows() {
        let alone = Layout::new(Size::new(200, 60), Panelling::Never);
        assert_eq!(alone.picture, Rect::new(0, 1, 200, 58));
    }

    #[test]
    fn the_smallest_screens_are_all_picture() {
        for size in [Size::new(19, 5), Size::new(20, 4), Size::new(200, 1), Size::new(1, 1)] {
            let layout = layout(size);
            assert_eq!(layout.around, Around::Nothing);
            assert_eq!(layout.picture.as_size(), size);
        }
    }

    #[test]
    fn no_size_is_taken_as_80_by_25_and_silly_sizes_are_bounded() {
        for size in [Size::new(0, 0), Size::new(0, 25), Size::new(80, 0)] {
            assert_eq!(layout(size), layout(Size::new(80, 25)));
        }
        assert_eq!(layout(Size::new(u16::MAX, u16::MAX)).screen.as_size(), LARGEST);
    }
}
