//! Which tiles of a picture are whose, where several machines draw one picture.

use crate::math::Size;

use super::tile::{TILE, Tile, tiles};

/// How far the fractional parts of two coordinates' sum go on with each tile to the right and each one down:
/// the powers of the plastic number's inverse, by which the places of any few consecutive parts are spread
/// evenly over the plane (Roberts: The unreasonable effectiveness of quasirandom sequences, 2018).
pub const PLASTIC: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];

/// One of several equal shares of a picture's tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TileShare {
    number: u32,
    of: u32,
}

impl TileShare {
    /// The whole picture.
    pub const ALL: Self = Self { number: 1, of: 1 };

    /// Share `number`, from 1, of so many; none where there is no such share.
    pub const fn new(number: u32, of: u32) -> Option<Self> {
        if 1 <= number && number <= of { Some(Self { number, of }) } else { None }
    }

    /// From 1.
    pub const fn number(self) -> u32 {
        self.number
    }

    /// How many shares there are.
    pub const fn of(self) -> u32 {
        self.of
    }

    /// Its tiles in scan order: of as many dots in each share as tiles can be shared out, and spread over the
    /// picture, since tiles that cost much stand together. Every tile is in one share.
    pub fn tiles(self, dots: Size) -> Vec<Tile> {
        let mut all = tiles(dots);
        if self == Self::ALL {
            return all;
        }
        let along = |tile: &Tile| {
            let [column, row] = tile.corner.map(|corner| f64::from(corner / TILE));
            (column * PLASTIC[0] + row * PLASTIC[1]).fract()
        };
        all.sort_by(|a, b| along(a).total_cmp(&along(b)).then(a.number.cmp(&b.number)));
        let end = |share: u32| (all.len() as u64 * u64::from(share) / u64::from(self.of)) as usize;
        let mut own = all[end(self.number - 1)..end(self.number)].to_vec();
        own.sort_unstable_by_key(|tile| tile.number);
        own
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tile_is_in_one_share_and_shares_are_equal() {
        for (dots, of) in [(Size::new(400, 180), 8), (Size::new(33, 31), 5), (Size::new(640, 400), 3)] {
            let all = tiles(dots);
            let shares: Vec<_> = (1..=of).map(|k| TileShare::new(k, of).unwrap().tiles(dots)).collect();
            let least = all.len() / of as usize;
            assert!(shares.iter().all(|share| (least..=least + 1).contains(&share.len())));
            let mut together = shares.concat();
            together.sort_unstable_by_key(|tile| tile.number);
            assert_eq!(together, all);
        }
        assert_eq!(TileShare::ALL.tiles(Size::new(100, 100)), tiles(Size::new(100, 100)));
        assert_eq!(TileShare::new(0, 3), None);
        assert_eq!(TileShare::new(4, 3), None);
    }

    /// Each share has tiles in each quarter of the picture: half of a fair part at least, twice at most.
    #[test]
    fn shares_are_spread_over_the_picture() {
        let dots = Size::new(1920, 1088);
        for number in 1..=16 {
            let mut quarters = [0; 4];
            for tile in TileShare::new(number, 16).unwrap().tiles(dots) {
                let [x, y] = tile.corner;
                quarters[usize::from(2 * x >= dots.width) + 2 * usize::from(2 * y >= dots.height)] += 1;
            }
            let fair = tiles(dots).len() / 16 / 4;
            assert!(quarters.iter().all(|&n| 2 * n >= fair && n <= 2 * fair), "{quarters:?}");
        }
    }
}
