//! The colours of ink and paper, and what they look like.

use crate::math::DVec3;
use crate::shade::luminance;
use crate::tone::{GRAYS, Level, light_of_srgb};

/// A colour of ink or paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Paint {
    /// Whatever the terminal uses when nothing is asked for.
    Terminal,
    /// Attribute 0.
    Black,
    /// Attribute 8.
    DarkGray,
    /// Attribute 7.
    LightGray,
    /// Attribute 15.
    White,
    /// Number 16 to 255 of xterm's 256 colours: a cube of 6 × 6 × 6, then 24 grays. The first 16 are the
    /// attributes, whose colours people change.
    Indexed(u8),
    /// Red, green and blue as sRGB bytes.
    Rgb([u8; 3]),
}

/// How exactly a terminal can be told a colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ColorDepth {
    /// By a number of 256.
    Indexed,
    /// By three bytes.
    #[default]
    Direct,
}

/// The bytes of a primary in xterm's cube.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];
/// The step of the cube nearest to each byte; of two that are equally near the lower.
const NEAREST_STEPS: [u8; 256] = {
    let mut steps = [0; 256];
    let mut byte = 0;
    let mut step = 0;
    while byte < steps.len() {
        if step + 1 < CUBE.len() && 2 * byte > CUBE[step] as usize + CUBE[step + 1] as usize {
            step += 1;
        }
        steps[byte] = step as u8;
        byte += 1;
    }
    steps
};
/// Where the cube begins, and behind it the grays: 8, 18 … 238.
const CUBE_START: u8 = 16;
const RAMP_START: u8 = 232;

impl Paint {
    /// The gray of a level, by its bytes.
    pub fn of_level(level: Level) -> Self {
        Self::Rgb([level.srgb(); 3])
    }

    /// The linear light, 0 to 1, as a gray, of an attribute as a PC shows it; `None` for the terminal's own
    /// colours, which nothing knows.
    pub fn light(self) -> Option<f64> {
        match self {
            Self::Terminal => None,
            Self::Black => Some(GRAYS[0]),
            Self::DarkGray => Some(GRAYS[1]),
            Self::LightGray => Some(GRAYS[2]),
            Self::White => Some(GRAYS[3]),
            Self::Indexed(index) => Some(light_of_bytes(bytes_of(index))),
            Self::Rgb(bytes) => Some(light_of_bytes(bytes)),
        }
    }

    /// Its sRGB bytes, of an attribute as a PC shows it; `None` for the terminal's own colours.
    pub const fn srgb(self) -> Option<[u8; 3]> {
        match self {
            Self::Terminal => None,
            Self::Black => Some([0x00; 3]),
            Self::DarkGray => Some([0x55; 3]),
            Self::LightGray => Some([0xAA; 3]),
            Self::White => Some([0xFF; 3]),
            Self::Indexed(index) => Some(bytes_of(index)),
            Self::Rgb(bytes) => Some(bytes),
        }
    }

    /// Whether it is one of the attributes that a Linux console has no paper of.
    pub const fn is_bright(self) -> bool {
        matches!(self, Self::DarkGray | Self::White)
    }

    /// The same for a terminal of that depth: the nearest of the cube and of the grays, by the squares of the
    /// differences of the bytes.
    #[must_use]
    pub fn at(self, depth: ColorDepth) -> Self {
        match (self, depth) {
            (Self::Rgb(bytes), ColorDepth::Indexed) => Self::Indexed(nearest_index(bytes)),
            _ => self,
        }
    }
}

fn light_of_bytes([r, g, b]: [u8; 3]) -> f64 {
    // The weights' sum is 1 only within rounding.
    if r == g && g == b { light_of_srgb(r) } else { luminance(DVec3::from([r, g, b].map(light_of_srgb))) }
}

/// The bytes of a colour of the 256; an attribute's number counts as black.
const fn bytes_of(index: u8) -> [u8; 3] {
    match index {
        ..CUBE_START => [0; 3],
        CUBE_START..RAMP_START => {
            let place = (index - CUBE_START) as usize;
            [CUBE[place / 36], CUBE[place / 6 % 6], CUBE[place % 6]]
        }
        RAMP_START.. => [8 + 10 * (index - RAMP_START); 3],
    }
}

fn nearest_index(bytes: [u8; 3]) -> u8 {
    let [r, g, b] = bytes.map(|byte| NEAREST_STEPS[usize::from(byte)]);
    let in_cube = CUBE_START + 36 * r + 6 * g + b;
    let away = |index: u8| {
        let differences = bytes_of(index).into_iter().zip(bytes).map(|(a, b)| u32::from(a.abs_diff(b)));
        differences.map(|d| d * d).sum::<u32>()
    };
    // The gray of least squares is the mean of the bytes; the ramp has one at or below it and one above.
    let sum: u16 = bytes.into_iter().map(u16::from).sum();
    let below = RAMP_START + (sum.saturating_sub(3 * 8) / (3 * 10)).min(23) as u8;
    [in_cube, below, below.saturating_add(1)].into_iter().min_by_key(|&index| away(index)).unwrap_or(in_cube)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tone::lightness;
    use proptest::prelude::*;

    #[test]
    fn the_cube_and_the_grays_are_xterm_s() {
        assert_eq!(bytes_of(16), [0, 0, 0]);
        assert_eq!(bytes_of(110), [135, 175, 215]);
        assert_eq!(bytes_of(231), [255, 255, 255]);
        assert_eq!((bytes_of(232), bytes_of(255)), ([8; 3], [238; 3]));
    }

    #[test]
    fn the_thirteen_levels_stay_thirteen_in_256_colours() {
        let paints: Vec<Paint> =
            Level::all().map(|level| Paint::of_level(level).at(ColorDepth::Indexed)).collect();
        for (level, paint) in Level::all().zip(&paints) {
            let shown = paint.light().expect("known");
            // Steps of the ramp are 10 bytes, so 5 away at most; that is 2 in L* where it is steepest.
            assert!((lightness(shown) - lightness(level.light())).abs() < 2.0, "{paint:?}");
        }
        assert!(paints.windows(2).all(|pair| pair[0].light() < pair[1].light()), "{paints:?}");
    }

    proptest! {
        #[test]
        fn no_other_index_is_nearer(bytes in prop::array::uniform3(any::<u8>())) {
            let Paint::Indexed(found) = Paint::Rgb(bytes).at(ColorDepth::Indexed) else { panic!("an index") };
            let away = |index: u8| {
                let pairs = bytes_of(index).into_iter().zip(bytes);
                pairs.map(|(a, b)| (i32::from(a) - i32::from(b)).pow(2)).sum::<i32>()
            };
            prop_assert_eq!(Some(away(found)), (16..=255).map(away).min());
        }
    }
}
