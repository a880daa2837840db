//! Light in one channel or in three.

use std::ops::{Add, Div, Mul};

use crate::math::{DVec3, LANES, Lanes, Number};

/// The shares of the linear primaries (sRGB, Rec. 709) in luminance.
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// The most light that a surface or a source sends: 2⁻¹³ of the largest number, about 2·10³⁰⁴. White is 1.
///
/// Kept below it, no sum overflows: a light by both shares of a surface is at most twice as much, a third
/// comes from the lights before it, and a dot's 64 × 64 samples are 2¹² of them.
const BRIGHTEST: f64 = f64::MAX / 8192.0;

/// The luminance of linear light.
#[inline]
pub fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(LUMINANCE)
}

/// The same, or as much of one part as may be where it is more.
#[inline(always)]
pub(crate) fn limited<N: Number>(part: N) -> N {
    part.smaller(part.same(BRIGHTEST))
}

/// An amount of linear light: its luminance as `f64`, or its three primaries as [`DVec3`].
pub trait Channel:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Mul<f64, Output = Self>
    + Mul<Output = Self>
    + Div<f64, Output = Self>
{
    /// No light.
    const DARK: Self;

    /// How many numbers it is.
    const PARTS: usize;

    /// One of its numbers, `part` below [`Channel::PARTS`].
    fn part(self, part: usize) -> f64;

    /// The amount whose numbers are the first of these.
    fn from_parts(parts: [f64; 3]) -> Self;

    /// The light of the rays of a register, below [`REGISTERS`](crate::math::REGISTERS), out of a column for
    /// each part.
    fn of_register(columns: &[Lanes], register: usize) -> [Self; LANES];

    /// From the three primaries.
    fn from_rgb(rgb: DVec3) -> Self;

    /// The same, or as much as may be where it is more.
    #[must_use]
    fn limited(self) -> Self;

    /// The light of a source, by its three primaries.
    #[inline]
    fn source(rgb: DVec3) -> Self {
        // Limited first: the weights of three that are nearly the largest number may pass it.
        Self::from_rgb(rgb.limited())
    }

    /// Its luminance.
    fn gray(self) -> f64;

    /// Its three primaries, equal where only the luminance is known.
    fn rgb(self) -> DVec3;
}

impl Channel for f64 {
    const DARK: Self = 0.0;
    const PARTS: usize = 1;

    #[inline(always)]
    fn part(self, _: usize) -> f64 {
        self
    }

    #[inline(always)]
    fn from_parts([gray, ..]: [f64; 3]) -> Self {
        gray
    }

    #[inline(always)]
    fn of_register(columns: &[Lanes], register: usize) -> [Self; LANES] {
        columns[0].register(register)
    }

    #[inline]
    fn from_rgb(rgb: DVec3) -> Self {
        // Three equal channels are that gray; the weights' sum is 1 only within rounding.
        if rgb.x == rgb.y && rgb.y == rgb.z { rgb.x } else { luminance(rgb) }
    }

    #[inline]
    fn limited(self) -> Self {
        self.min(BRIGHTEST)
    }

    #[inline]
    fn gray(self) -> f64 {
        self
    }

    #[inline]
    fn rgb(self) -> DVec3 {
        DVec3::splat(self)
    }
}

impl Channel for DVec3 {
    const DARK: Self = DVec3::ZERO;
    const PARTS: usize = 3;

    #[inline(always)]
    fn part(self, part: usize) -> f64 {
        self[part]
    }

    #[inline(always)]
    fn from_parts(parts: [f64; 3]) -> Self {
        Self::from_array(parts)
    }

    #[inline(always)]
    fn of_register(columns: &[Lanes], register: usize) -> [Self; LANES] {
        let [red, green, blue] =
            [columns[0].register(register), columns[1].register(register), columns[2].register(register)];
        let mut lights = [Self::ZERO; LANES];
        for (lane, light) in lights.iter_mut().enumerate() {
            *light = Self::new(red[lane], green[lane], blue[lane]);
        }
        lights
    }

    #[inline]
    fn from_rgb(rgb: DVec3) -> Self {
        rgb
    }

    #[inline]
    fn limited(self) -> Self {
        self.min(Self::splat(BRIGHTEST))
    }

    #[inline]
    fn gray(self) -> f64 {
        f64::from_rgb(self)
    }

    #[inline]
    fn rgb(self) -> DVec3 {
        self
    }
}
