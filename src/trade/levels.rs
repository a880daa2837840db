//! How far two pictures of levels are apart.

use crate::math::{Grid, Size};
use crate::tone::Level;

/// Levels that a dot may be apart: 0 to 12.
const STEPS: usize = 13;

/// How many dots of a picture are how many levels from a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelDifference {
    /// By how many levels a dot is off, up to 12: so many dots.
    dots: [usize; STEPS],
}

impl LevelDifference {
    /// Of two pictures; `None` where they have not the same number of dots across and down.
    pub fn between(own: &Grid<Level>, reference: &Grid<Level>) -> Option<Self> {
        if own.size() != reference.size() {
            return None;
        }
        Some(Self::of(own.values(), reference.values()))
    }

    /// Of the same dots of two pictures, in the same order.
    pub(super) fn of(own: &[Level], reference: &[Level]) -> Self {
        let mut dots = [0; STEPS];
        for (own, other) in own.iter().zip(reference) {
            dots[usize::from(apart(*own, *other))] += 1;
        }
        Self { dots }
    }

    /// Dots that are off by so many levels; none are off by more than 12.
    pub fn off_by(&self, levels: u8) -> usize {
        self.dots.get(usize::from(levels)).copied().unwrap_or(0)
    }

    /// Dots that are off by more than so many levels: with 0 all that differ.
    pub fn beyond(&self, tolerance: u8) -> usize {
        self.dots.iter().skip(usize::from(tolerance) + 1).sum()
    }

    /// All dots.
    pub fn all(&self) -> usize {
        self.dots.iter().sum()
    }
}

/// For each cell of `per_cell` dots the most levels that any of its dots is off, 0 to 12: as many cells as
/// fit whole, and those that the edge cuts.
///
/// # Panics
/// The pictures must have the same size, and a cell a dot at least.
pub fn cells_apart(own: &Grid<Level>, reference: &Grid<Level>, per_cell: Size) -> Grid<u8> {
    assert_eq!(own.size(), reference.size(), "pictures of the same dots");
    let Size { width, height } = own.size();
    let cells = Size::new(width.div_ceil(per_cell.width), height.div_ceil(per_cell.height));
    Grid::from_fn(cells, |column, row| {
        let across = |first: u32, side: u32, end: u32| first * side..((first + 1) * side).min(end);
        let rows = across(row, per_cell.height, height);
        let dots = rows.flat_map(|y| across(column, per_cell.width, width).map(move |x| (x, y)));
        dots.map(|dot| apart(own[dot], reference[dot])).max().unwrap_or(0)
    })
}

fn apart(a: Level, b: Level) -> u8 {
    a.get().abs_diff(b.get())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::read_levels;

    #[test]
    fn dots_are_counted_by_how_far_they_are_off() {
        let [own, reference] = [b"0123\n45C7\n", b"0123\n6507\n"].map(|text| read_levels(text).unwrap());
        let difference = LevelDifference::between(&own, &reference).unwrap();
        assert_eq!((difference.all(), difference.beyond(0), difference.beyond(2)), (8, 2, 1));
        assert_eq!((difference.off_by(0), difference.off_by(2), difference.off_by(12)), (6, 1, 1));
        assert_eq!((difference.beyond(12), difference.beyond(255), difference.off_by(13)), (0, 0, 0));
        assert_eq!(LevelDifference::between(&own, &read_levels(b"0123").unwrap()), None);
    }

    #[test]
    fn a_cell_is_off_as_its_worst_dot() {
        let [own, reference] =
            [b"00000\n00000\n00000\n", b"00002\n01000\n00300\n"].map(|t| read_levels(t).unwrap());
        let cells = cells_apart(&own, &reference, Size::new(2, 2));
        assert_eq!((cells.size(), cells.values()), (Size::new(3, 2), &[1, 0, 2, 0, 3, 0][..]));
    }
}
