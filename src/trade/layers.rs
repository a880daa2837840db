//! How far a picture is from what it ought to be, in three layers: what rays met, the light of dots, and the
//! characters.

use crate::tone::Level;

use super::levels::LevelDifference;

/// How far a picture is from its reference. `docs/trade.md` defines each number.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// What the rays through the middles of dots met; absent where the two have other dots.
    pub geometry: Option<GeometryError>,
    /// Light before it is dithered.
    pub light: LightError,
    /// What is shown; absent of pictures without characters.
    pub characters: Option<CharacterError>,
}

/// How far off is what the rays through the middles of dots met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeometryError {
    /// All dots.
    pub dots: usize,
    /// Those that show another object, or nothing where the reference shows one, or the other way round.
    pub others: usize,
    /// The largest difference of two depths of the same object, in units of the last place: so many numbers
    /// of 64 bits lie between the two.
    pub depth_ulps: u64,
    /// The largest angle between two normals of the same object, in degrees, 0 to 180.
    pub normal: f64,
}

/// How far light is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightError {
    /// The root of the mean square, in twelfths of white's CIE L*: levels, in the mean.
    pub rms: f64,
    /// The largest, in the same unit, 0 to 12.
    pub largest: f64,
    /// How many dots are how many of the 13 levels off.
    pub levels: LevelDifference,
}

/// How far off is what the characters show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CharacterError {
    /// All cells.
    pub cells: usize,
    /// Those of another character, ink or paper than the reference's light has in the reference's
    /// characters.
    pub others: usize,
    /// What an eye sees of that: the root of the mean square difference, in twelfths of white's CIE L*,
    /// between these characters and the reference's, both through the eye's filter.
    pub seen: f64,
    /// The same between these characters and the reference's light: what the eye sees of the tracing and of
    /// the characters together.
    pub shown: f64,
    /// How much flickers when the view turns by a tenth of a dot: the same between these characters before
    /// and after; absent where the latter were not drawn.
    pub shimmer: Option<f64>,
}

impl GeometryError {
    /// The share of dots that show another object, 0 to 1.
    pub fn share(&self) -> f64 {
        share(self.others, self.dots)
    }
}

impl LightError {
    /// The share of dots whose level is wrong, 0 to 1.
    pub fn wrong(&self) -> f64 {
        self.wrong_by(1)
    }

    /// The share of dots whose level is wrong by so many or more, 0 to 1.
    pub fn wrong_by(&self, levels: u8) -> f64 {
        let off = (levels..=Level::MAX.get()).map(|n| self.levels.off_by(n)).sum();
        share(off, self.levels.all())
    }
}

impl CharacterError {
    /// The share of cells that differ, 0 to 1.
    pub fn share(&self) -> f64 {
        share(self.others, self.cells)
    }
}

fn share(some: usize, all: usize) -> f64 {
    some as f64 / all.max(1) as f64
}
