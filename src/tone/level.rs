//! The 13 gray levels: three steps between each two neighbours of the text attributes' four grays.

/// The linear light of the four grays of DOS text attributes, sRGB bytes 0x00, 0x55, 0xAA and 0xFF.
pub const GRAYS: [f64; 4] = [0.0, 0.090_841_711_183_407_7, 0.401_977_779_832_195_8, 1.0];

/// A 2 × 2 matrix puts three steps between two neighbouring grays.
const STEPS: usize = 4;

/// The linear light of each level.
pub(super) const LIGHTS: [f64; 13] = {
    let mut lights = [0.0; 13];
    let mut level = 0;
    while level < 13 {
        let dark = level / STEPS;
        let bright = if dark + 1 < GRAYS.len() { dark + 1 } else { dark };
        // Both products are exact scalings for 0, 2 and 4 quarters, so the grays themselves come out to the
        // bit.
        let quarters = (level % STEPS) as f64;
        lights[level] = (GRAYS[dark] * (STEPS as f64 - quarters) + GRAYS[bright] * quarters) / STEPS as f64;
        level += 1;
    }
    lights
};

/// The light midway in lightness between each level and the next. A table, so that a dot costs no cube root;
/// a test computes it.
pub(super) const BORDERS: [f64; 12] = [
    0.009_335_232_752_546_314,
    0.032_765_374_050_654_966,
    0.056_011_039_313_493_4,
    0.078_942_881_476_214_45,
    0.125_752_343_538_137_52,
    0.205_065_550_536_771_3,
    0.283_525_919_731_835_1,
    0.361_692_974_130_318_26,
    0.472_798_179_039_875_6,
    0.623_250_671_428_607_3,
    0.773_334_725_721_787_4,
    0.923_230_656_574_289_9,
];

/// The sRGB byte of each level; a test computes them.
const BYTES: [u8; 13] = [0, 42, 60, 74, 85, 114, 136, 154, 170, 196, 218, 237, 255];

/// How many equal parts light is cut into to find its level: so many that no two borders share one, and a
/// power of two, so that a part is found without rounding.
const PARTS: usize = 64;

/// The level of the darkest light in each part.
const DARKEST: [u8; PARTS] = {
    let mut levels = [0; PARTS];
    let mut part = 0;
    while part < PARTS {
        let light = part as f64 / PARTS as f64;
        while (levels[part] as usize) < BORDERS.len() && BORDERS[levels[part] as usize] <= light {
            levels[part] += 1;
        }
        assert!(
            levels[part] as usize + 1 >= BORDERS.len()
                || BORDERS[levels[part] as usize + 1] > light + 1.0 / PARTS as f64
        );
        part += 1;
    }
    levels
};

/// A gray level, 0 (black) to 12 (white).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Level(u8);

impl Level {
    /// Black.
    pub const MIN: Self = Self(0);
    /// White.
    pub const MAX: Self = Self(12);

    /// The level of a number, if it is 0 to 12.
    #[inline]
    pub const fn new(number: u8) -> Option<Self> {
        if number <= Self::MAX.0 { Some(Self(number)) } else { None }
    }

    /// All 13, from black.
    #[inline]
    pub fn all() -> impl Iterator<Item = Self> {
        (0..=Self::MAX.0).map(Self)
    }

    /// The level nearest to `light` in CIE L*; the lighter one midway; level 0 for NaN.
    #[inline]
    pub fn nearest(light: f64) -> Self {
        // Negative light and NaN become part 0.
        let darkest = DARKEST[((light * PARTS as f64) as usize).min(PARTS - 1)];
        // Above the last border there is none: no light reaches NaN.
        let border = BORDERS.get(usize::from(darkest)).copied().unwrap_or(f64::NAN);
        Self(darkest + u8::from(light >= border))
    }

    /// Where `light` lies among the levels, −½ to 12½: the number of its level, and so far between the
    /// borders of that as its light lies between theirs; −½ for no light, 12½ for white and above.
    pub fn position(light: f64) -> f64 {
        let level = Self::nearest(light);
        let number = usize::from(level.get());
        let low = if number == 0 { 0.0 } else { BORDERS[number - 1] };
        let high = BORDERS.get(number).copied().unwrap_or(LIGHTS[number]);
        f64::from(level.get()) + (((light - low) / (high - low)).clamp(0.0, 1.0) - 0.5)
    }

    /// The number, 0 to 12.
    #[inline]
    pub const fn get(self) -> u8 {
        self.0
    }

    /// Its linear light, 0 to 1.
    #[inline]
    pub const fn light(self) -> f64 {
        LIGHTS[self.0 as usize]
    }

    /// Its gray in a picture file, an sRGB byte.
    #[inline]
    pub const fn srgb(self) -> u8 {
        BYTES[self.0 as usize]
    }

    /// One character: `0` to `9`, `A`, `B`, `C`.
    #[inline]
    pub const fn digit(self) -> char {
        b"0123456789ABC"[self.0 as usize] as char
    }
}

#[cfg(test)]
mod tests {
    use super::super::lightness::{light_of_lightness, light_of_srgb, lightness, srgb_of_light};
    use super::*;

    #[test]
    fn the_grays_are_the_srgb_bytes() {
        for (gray, byte) in GRAYS.into_iter().zip([0x00, 0x55, 0xAA, 0xFF]) {
            assert!((gray - light_of_srgb(byte)).abs() < 1e-15);
        }
    }

    #[test]
    fn the_levels_are_the_printed_figures() {
        let printed = [
            0.0, 0.0227, 0.0454, 0.0681, 0.0908, 0.1686, 0.2464, 0.3242, 0.4020, 0.5515, 0.7010, 0.8505, 1.0,
        ];
        for (level, printed) in Level::all().zip(printed) {
            assert!((level.light() - printed).abs() <= 0.000_05, "level {}", level.get());
        }
        for (k, gray) in GRAYS.into_iter().enumerate() {
            assert_eq!(LIGHTS[k * STEPS], gray);
        }
    }

    #[test]
    fn the_borders_are_midway_in_lightness() {
        for (border, pair) in BORDERS.into_iter().zip(LIGHTS.windows(2)) {
            let midway = light_of_lightness(f64::midpoint(lightness(pair[0]), lightness(pair[1])));
            assert!((border - midway).abs() < 1e-14, "{border} {midway}");
        }
    }

    #[test]
    fn the_bytes_of_the_levels() {
        for level in Level::all() {
            assert_eq!(level.srgb(), srgb_of_light(level.light()));
        }
    }

    #[test]
    fn the_nearest_level_counts_the_borders_below() {
        let counted = |light: f64| BORDERS.iter().filter(|&&border| light >= border).count();
        let parts = (0..=4 * PARTS).map(|k| k as f64 / (4 * PARTS) as f64);
        let nan = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 7.0];
        for light in BORDERS.into_iter().chain(parts).chain(nan) {
            for light in [light.next_down(), light, light.next_up()] {
                assert_eq!(usize::from(Level::nearest(light).get()), counted(light), "{light}");
            }
        }
    }

    #[test]
    fn the_position_goes_from_border_to_border() {
        assert_eq!((Level::position(0.0), Level::position(1.0), Level::position(7.0)), (-0.5, 12.5, 12.5));
        for (k, border) in BORDERS.into_iter().enumerate() {
            assert!((Level::position(border) - (k as f64 + 0.5)).abs() < 1e-12);
            assert!((Level::position(border.next_down()) - (k as f64 + 0.5)).abs() < 1e-12);
        }
        for level in Level::all() {
            assert!((Level::position(level.light()) - f64::from(level.get())).abs() <= 0.5);
        }
    }

    #[test]
    fn only_thirteen_numbers_are_levels() {
        assert_eq!(Level::new(12), Some(Level::MAX));
        assert_eq!(Level::new(13), None);
        let digits: String = Level::all().map(Level::digit).collect();
        assert_eq!(digits, "0123456789ABC");
    }
}
