//! In which precision rays from the eye are asked what they meet.
//!
//! Of solids that are cut, and of convex ones but balls, numbers of 24 bits say it in less time than those of
//! 53. Which surface is met stays certain: where single precision is uncertain, at silhouettes and edges and
//! where two surfaces are near each other, all are asked. But where it is met is off by up to
//! [`Real::EPSILON_RATIO`] times as much, some 2·10⁻⁵ in the unit in which the world reaches to ±2. That is
//! allowed where it is so small a part of a dot, of what is nearest to the eye, that light is off by less
//! than a quarter of a level.
//!
//! Rays that start on surfaces need double precision: between two curved mirrors what is off grows with each
//! generation, and the edge of a shadow shows where a point is.

use crate::math::{DVec3, Real};
use crate::solid::Assembly;
use crate::view::PinholeCamera;

use super::{EngineChoice, Options, PrecisionChoice};

/// In which precision rays from the eye are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Those of `f32`; of `f64` where these are uncertain.
    Single,
    /// Those of `f64`.
    Double,
}

impl Precision {
    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Double => "double",
        }
    }
}

/// The part of a dot that a hit may be off. From one dot to the next light differs by as many levels as there
/// are at most, and by so small a part of that way by a quarter of a level.
const UNSEEN: f64 = 0.25 / LEVELS;

/// Steps from black to white.
const LEVELS: f64 = 12.0;

/// A chord is at least as long as a solid is thick, and its two ends are off by twice `place_error` over the
/// sine of the angle between ray and face. So in a solid 16 `place_error` thick all chords are certain whose
/// rays meet its faces at a sine of an eighth or more.
const THICK: f64 = 16.0;

/// Of more objects around the eye none is asked how near it is: a few nanoseconds each are a tenth of a
/// millisecond.
const ASKED: usize = 1 << 15;

/// Inverse maps, their squares and the squares of those are far from the limits of f32 where solids are
/// thicker than this.
const PLAIN: f64 = 1.0 / (1_u32 << 30) as f64;

/// More primitives have no number in 24 bits.
const NUMBERED: usize = 1 << f32::MANTISSA_DIGITS;

/// What decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PrecisionReason {
    /// The person.
    Asked(Precision),
    /// The exact engine has one precision.
    Exact,
    /// Rays start on surfaces.
    SentOn,
    /// There are surfaces that bound no solid, meshes that are cut, or nothing but balls.
    NoGain,
    /// A primitive is thin.
    Thin,
    /// There are so many primitives that not all have a number.
    Many,
    /// The eye may be as near to a solid as can be.
    Near,
    /// So many dots would a hit be off.
    Dots(f64),
    /// So few.
    Unseen(f64),
}

impl PrecisionReason {
    pub fn precision(self) -> Precision {
        match self {
            Self::Asked(precision) => precision,
            Self::Unseen(_) => Precision::Single,
            Self::Exact
            | Self::SentOn
            | Self::NoGain
            | Self::Thin
            | Self::Many
            | Self::Near
            | Self::Dots(_) => Precision::Double,
        }
    }

    pub fn of(
        assembly: &Assembly,
        pinhole: &PinholeCamera,
        options: &Options,
        (engine, sends_on): (EngineChoice, bool),
    ) -> Self {
        match options.precision {
            _ if engine == EngineChoice::Exact => return Self::Exact,
            PrecisionChoice::Double => return Self::Asked(Precision::Double),
            _ if assembly.primitives.len() > NUMBERED => return Self::Many,
            PrecisionChoice::Single if assembly.stats.thinnest < PLAIN => return Self::Thin,
            PrecisionChoice::Single => return Self::Asked(Precision::Single),
            _ if sends_on => return Self::SentOn,
            PrecisionChoice::Auto => {}
        }
        let stats = &assembly.stats;
        if stats.surfaces > 0 || stats.cut_meshes > 0 || stats.balls == assembly.objects.len() {
            return Self::NoGain;
        }
        let place_error = assembly.place_error * f32::EPSILON_RATIO;
        if stats.thinnest < THICK * place_error {
            return Self::Thin;
        }
        let least_dot = nearest(assembly, pinhole) * pinhole.least_dot();
        if least_dot == 0.0 {
            return Self::Near;
        }
        let dots = place_error / least_dot;
        if dots <= UNSEEN { Self::Unseen(dots) } else { Self::Dots(dots) }
    }
}

/// How near anything is to the eye at least.
fn nearest(assembly: &Assembly, pinhole: &PinholeCamera) -> f64 {
    let eye = assembly.scene_frame.inward_near(pinhole.eye);
    let distance = |lo: DVec3, hi: DVec3| (eye.clamp(lo, hi) - eye).length();
    let to_world = distance(assembly.limit.lo, assembly.limit.hi);
    if to_world > 0.0 || assembly.objects.len() > ASKED {
        return to_world;
    }
    assembly.objects.iter().map(|o| distance(o.bounds.lo, o.bounds.hi)).fold(f64::INFINITY, f64::min)
}
