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
    /// The place of one of its dots in an order in which those that follow each other are near each other:
    /// along Morton's curve, that is by their columns and rows as binary numbers whose digits take turns.
    pub fn nearness(&self, (column, row): (u32, u32)) -> u32 {
        let spread = |number: u32| (0..TILE.ilog2()).fold(0, |all, k| all | (number >> k & 1) << (2 * k));
        let [left, top] = self.corner;
        spread(column - left) | spread(row - top) << 1
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
    fn tiles_hold_every_dot_once_and_give_each_a_place() {
        let dots = Size::new(37, 21);
        let mut seen = vec![0; dots.area()];
        for tile in tiles(dots) {
            let mut places = Vec::new();
            for (i, j) in tile.dots() {
                seen[(j * dots.width + i) as usize] += 1;
                places.push(tile.nearness((i, j)));
            }
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), tile.size.area());
            assert!(places.iter().all(|&place| place < TILE * TILE));
        }
        assert!(seen.iter().all(|&n| n == 1));
    }
}
