//! The picture in tiles: the unit of work that threads share.

use crate::math::Size;

/// Dots along each side of a tile: large enough that a thread seldom runs out of work, small enough that many
/// threads end together.
pub const TILE: u32 = 32;

/// A rectangle of dots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Its number in scan order of tiles.
    pub number: u32,
    /// Its leftmost column and top row.
    pub corner: [u32; 2],
    /// Its columns and rows; smaller at the right and lower rim.
    pub size: Size,
}

impl Tile {
    /// One of no dots.
    pub const NONE: Self = Self { number: 0, corner: [0; 2], size: Size::new(0, 0) };

    /// Its dots in scan order.
    pub fn dots(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let ([x, y], size) = (self.corner, self.size);
        (y..y + size.height).flat_map(move |j| (x..x + size.width).map(move |i| (i, j)))
    }
}

impl Tile {
    /// Its dots in an order in which those that follow each other are near each other: along Morton's curve,
    /// that is by their columns and rows as binary numbers whose digits take turns.
    pub fn dots_by_nearness(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let ([x, y], size) = (self.corner, self.size);
        let even_digits =
            |number: u32| (0..TILE.ilog2()).fold(0, |all, k| all | (number >> (2 * k) & 1) << k);
        let all = (0..TILE * TILE).map(move |number| (even_digits(number), even_digits(number >> 1)));
        all.filter(move |&(i, j)| i < size.width && j < size.height).map(move |(i, j)| (x + i, y + j))
    }
}

/// Cuts a picture into tiles, in scan order.
pub fn tiles(dots: Size) -> Vec<Tile> {
    let mut all = Vec::new();
    for y in (0..dots.height).step_by(TILE as usize) {
        for x in (0..dots.width).step_by(TILE as usize) {
            let size = Size::new(TILE.min(dots.width - x), TILE.min(dots.height - y));
            all.push(Tile { number: all.len() as u32, corner: [x, y], size });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_hold_every_dot_once_in_each_order() {
        let dots = Size::new(37, 21);
        let mut seen = vec![0; dots.area()];
        for tile in tiles(dots) {
            for (i, j) in tile.dots().chain(tile.dots_by_nearness()) {
                seen[(j * dots.width + i) as usize] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n == 2));
    }
}
