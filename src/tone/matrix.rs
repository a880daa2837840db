//! Ordered-dither matrices (Jarvis, Judice and Ninke 1976), fixed to the screen.

/// A matrix of distinct ranks 0 .. `WIDTH · HEIGHT`, repeated over the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix<const WIDTH: usize, const HEIGHT: usize>(pub [[u8; WIDTH]; HEIGHT]);

impl<const WIDTH: usize, const HEIGHT: usize> Matrix<WIDTH, HEIGHT> {
    /// The threshold at a place of the screen, in the open range 0 to 1: the middle of its rank's share.
    pub fn threshold(&self, column: u32, row: u32) -> f64 {
        let rank = self.0[row as usize % HEIGHT][column as usize % WIDTH];
        (f64::from(rank) + 0.5) / (WIDTH * HEIGHT) as f64
    }
}

/// For the four grays: three steps between two neighbours, and so 13 levels.
pub const FOUR_GRAYS: Matrix<2, 2> = Matrix([[0, 2], [3, 1]]);

/// For a device with only ink and paper: 12 thresholds, and so 13 levels. Neighbouring ranks stand far apart,
/// so that a middle level looks even.
pub const INK_ONLY: Matrix<4, 3> = Matrix([[0, 6, 2, 8], [9, 3, 11, 5], [4, 10, 1, 7]]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rank_stands_once() {
        let mut ranks: Vec<u8> = INK_ONLY.0.concat();
        ranks.sort_unstable();
        assert_eq!(ranks, (0..12).collect::<Vec<u8>>());
        let mut ranks: Vec<u8> = FOUR_GRAYS.0.concat();
        ranks.sort_unstable();
        assert_eq!(ranks, (0..4).collect::<Vec<u8>>());
    }

    #[test]
    fn a_level_lights_its_share_of_the_matrix() {
        for level in 0..=12 {
            let share = level as f64 / 12.0;
            let lit = (0..12).filter(|&k| INK_ONLY.threshold(k % 4, k / 4) < share).count();
            assert_eq!(lit, level);
        }
    }
}
