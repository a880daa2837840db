//! Light in one channel or in three.

use std::ops::{Add, Mul};

use crate::math::DVec3;

/// The shares of the linear primaries (sRGB, Rec. 709) in luminance.
const LUMINANCE: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// The luminance of linear light.
pub fn luminance(rgb: DVec3) -> f64 {
    rgb.dot(LUMINANCE)
}

/// An amount of linear light: its luminance as `f64`, or its three primaries as [`DVec3`].
pub trait Channel:
    Copy + Send + Sync + Add<Output = Self> + Mul<f64, Output = Self> + Mul<Output = Self>
{
    /// No light.
    const DARK: Self;

    /// From the three primaries.
    fn from_rgb(rgb: DVec3) -> Self;

    /// Its luminance.
    fn gray(self) -> f64;

    /// Its three primaries, equal where only the luminance is known.
    fn rgb(self) -> DVec3;
}

impl Channel for f64 {
    const DARK: Self = 0.0;

    fn from_rgb(rgb: DVec3) -> Self {
        // Three equal channels are that gray; the weights' sum is 1 only within rounding.
        if rgb.x == rgb.y && rgb.y == rgb.z { rgb.x } else { luminance(rgb) }
    }

    fn gray(self) -> f64 {
        self
    }

    fn rgb(self) -> DVec3 {
        DVec3::splat(self)
    }
}

impl Channel for DVec3 {
    const DARK: Self = DVec3::ZERO;

    fn from_rgb(rgb: DVec3) -> Self {
        rgb
    }

    fn gray(self) -> f64 {
        f64::from_rgb(self)
    }

    fn rgb(self) -> DVec3 {
        self
    }
}
