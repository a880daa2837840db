//! Rectangles of values: dots of a picture, cells of a screen.

use std::ops::{Index, IndexMut};

use rayon::prelude::*;

/// Values that a thread computes at least before another helps: some tens of microseconds of the cheapest,
/// several times what it costs to wake a thread.
const SHARE: usize = 1024;

/// A width and a height, in dots or in cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Size {
    /// How many columns.
    pub width: u32,
    /// How many rows.
    pub height: u32,
}

impl Size {
    /// A size of `width` columns and `height` rows.
    #[inline]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// The number of places: `width · height`.
    #[inline]
    pub const fn area(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// A rectangle of values, row by row from the top, each row from the left. Indexed by `(column, row)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    size: Size,
    values: Vec<T>,
}

impl<T> Grid<T> {
    /// A grid of `values` in scan order.
    ///
    /// # Panics
    /// When the number of values is not the area of `size`: an error of the caller.
    #[inline]
    pub fn from_values(size: Size, values: Vec<T>) -> Self {
        assert_eq!(values.len(), size.area(), "a grid holds one value per place");
        Self { size, values }
    }

    /// A grid whose value at each `(column, row)` is computed.
    #[inline]
    pub fn from_fn(size: Size, mut value: impl FnMut(u32, u32) -> T) -> Self {
        let mut values = Vec::with_capacity(size.area());
        for row in 0..size.height {
            for column in 0..size.width {
                values.push(value(column, row));
            }
        }
        Self { size, values }
    }

    /// Columns and rows.
    #[inline]
    pub const fn size(&self) -> Size {
        self.size
    }

    /// All values in scan order.
    #[inline]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// All values in scan order, to change.
    #[inline]
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The rows from the top.
    #[inline]
    pub fn rows(&self) -> impl Iterator<Item = &[T]> {
        // `chunks` refuses a width of 0, whose grid has no values at all.
        self.values.chunks(self.size.width.max(1) as usize)
    }

    /// The same rectangle with each value mapped.
    #[inline]
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Grid<U> {
        Grid { size: self.size, values: self.values.iter().map(f).collect() }
    }

    #[inline]
    fn place(&self, (column, row): (u32, u32)) -> usize {
        debug_assert!(column < self.size.width && row < self.size.height);
        row as usize * self.size.width as usize + column as usize
    }
}

impl<T: Copy + Send> Grid<T> {
    /// The same as [`Grid::from_fn`], with large grids shared out by rows among the threads of the caller's
    /// rayon pool.
    pub fn from_fn_in_parallel(size: Size, value: impl Fn(u32, u32) -> T + Sync) -> Self {
        if size.area() < 2 * SHARE {
            return Self::from_fn(size, value);
        }
        let width = size.width as usize;
        let mut grid = Self::filled(size, value(0, 0));
        let rows = grid.values.par_chunks_mut(width).enumerate().with_min_len(SHARE.div_ceil(width));
        rows.for_each(|(row, places)| {
            for (column, place) in (0..).zip(places) {
                *place = value(column, row as u32);
            }
        });
        grid
    }
}

impl<T: Clone> Grid<T> {
    /// A grid that holds `value` everywhere.
    #[inline]
    pub fn filled(size: Size, value: T) -> Self {
        Self { size, values: vec![value; size.area()] }
    }
}

impl<T> Index<(u32, u32)> for Grid<T> {
    type Output = T;
    #[inline]
    fn index(&self, place: (u32, u32)) -> &T {
        &self.values[self.place(place)]
    }
}

impl<T> IndexMut<(u32, u32)> for Grid<T> {
    #[inline]
    fn index_mut(&mut self, place: (u32, u32)) -> &mut T {
        let place = self.place(place);
        &mut self.values[place]
    }
}
