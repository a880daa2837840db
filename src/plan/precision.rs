//! In how many digits rays from the eye are asked what they meet.
//!
//! Of solids that are cut, and of convex ones but balls, numbers of 24 bits say it in less time than those of 53. Which surface
//! is met stays certain: where half the digits leave a doubt, at silhouettes and edges and where two surfaces are near each
//! other, all are asked. But where it is met is off by up to [`Digits::COARSER`] times as much, some 2·10⁻⁵ in the unit in which
//! the world reaches to ±2. That is allowed where it is so small a part of a dot, of what is nearest to the eye, that light is off
//! by less than a quarter of a level.
//!
//! Rays that start on surfaces need all digits: between two curved mirrors what is off grows with each generation, and the edge
//! of a shadow shows where a point is.

use crate::math::{DVec3, Digits};
use crate::solid::Assembly;
use crate::view::Lens;

use super::{EngineChoice, Options, PrecisionChoice};

/// In how many digits rays from the eye are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Those of `f32`; of `f64` where these leave a doubt.
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

/// The part of a dot that a hit may be off. From one dot to the next light differs by as many levels as there are at most, and by
/// so small a part of that way by a quarter of a level.
const UNSEEN: f64 = 0.25 / LEVELS;

/// Steps from black to white.
const LEVELS: f64 = 12.0;

/// Whether a chord is there is certain where it is longer than what its two ends may be off, which is what their faces are, over
/// the sine of the angle between face and ray: in a solid so many times as thick, for rays within a sine of an eighth.
const THICK: f64 = 16.0;

/// Of more objects around the eye none is asked how near it is.
const ASKED: usize = 1 << 16;

/// More primitives have no number in 24 bits.
const NUMBERED: usize = 1 << f32::MANTISSA_DIGITS;

/// What decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Digital {
    /// The person.
    Asked(Precision),
    /// The exact engine has one precision.
    Exact,
    /// Rays start on surfaces.
    SentOn,
    /// There are surfaces that bound no solid, or nothing but balls.
    NoGain,
    /// A primitive is thin.
    Thin,
    /// So many dots would a hit be off.
    Dots(f64),
    /// So few.
    Unseen(f64),
}

impl Digital {
    pub fn precision(self) -> Precision {
        match self {
            Self::Asked(precision) => precision,
            Self::Unseen(_) => Precision::Single,
            Self::Exact | Self::SentOn | Self::NoGain | Self::Thin | Self::Dots(_) => Precision::Double,
        }
    }

    pub fn of(
        assembly: &Assembly,
        lens: &Lens,
        options: &Options,
        (engine, sends_on): (EngineChoice, bool),
    ) -> Self {
        match options.precision {
            _ if engine == EngineChoice::Exact => return Self::Exact,
            PrecisionChoice::Double => return Self::Asked(Precision::Double),
            PrecisionChoice::Single if assembly.primitives.len() <= NUMBERED => {
                return Self::Asked(Precision::Single);
            }
            _ if sends_on => return Self::SentOn,
            _ => {}
        }
        let makeup = &assembly.makeup;
        let gains = makeup.surfaces == 0 && makeup.balls < assembly.objects.len();
        if !gains || assembly.primitives.len() > NUMBERED {
            return Self::NoGain;
        }
        let off = assembly.off * f32::COARSER;
        if makeup.thinnest < THICK * off {
            return Self::Thin;
        }
        let dots = off / (nearest(assembly, lens) * lens.least_dot());
        if dots <= UNSEEN { Self::Unseen(dots) } else { Self::Dots(dots) }
    }
}

/// How near anything is to the eye at least.
fn nearest(assembly: &Assembly, lens: &Lens) -> f64 {
    let eye = assembly.datum.inward_near(lens.eye);
    let distance = |lo: DVec3, hi: DVec3| (eye.clamp(lo, hi) - eye).length();
    let to_world = distance(assembly.limit.lo, assembly.limit.hi);
    if to_world > 0.0 || assembly.objects.len() > ASKED {
        return to_world;
    }
    assembly.objects.iter().map(|o| distance(o.bounds.lo, o.bounds.hi)).fold(f64::INFINITY, f64::min)
}
