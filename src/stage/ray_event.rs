//! What happens to a ray on its way through the stages.

use crate::math::Ray;

use super::Stage;

/// Why a ray is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye.
    Eye,
    /// Along the mirror direction.
    Mirror,
    /// Along Snell's direction.
    Snell,
    /// Towards a lamp.
    Shadow,
}

/// What happens to a ray. Distances are along the ray, in the assembly's unit; ids are those of the assembly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RayEvent {
    /// A ray is sent: what follows is about it, until the next is sent or [`RayEvent::Lit`] says what came of
    /// a shadow ray.
    Sent {
        /// Why.
        kind: RayKind,
        /// The ray, of length 1, in the assembly's coordinates.
        ray: Ray,
        /// The share of its light that reaches the eye, 0 to 1.
        weight: f64,
    },
    /// The mirror or Snell ray that was sent last is not followed, for its small weight or its depth.
    Truncated,
    /// The ray misses the world.
    Clipped,
    /// The ray comes into a cell, or a box.
    Cell {
        /// Where it does, or before.
        from: f64,
    },
    /// The ray is tested against a primitive.
    Tested {
        /// The primitive.
        primitive: u32,
        /// Where it crosses the primitive first and last; absent where it does not. Of a primitive that the
        /// ray leaves the first is 0; of a surface both are where it is met first.
        span: Option<[f64; 2]>,
    },
    /// A CSG expression is evaluated along the ray.
    Evaluated {
        /// Primitives of the expression.
        leaves: usize,
        /// Crossings that are looked at.
        crossings: usize,
    },
    /// The ray crosses a surface of an object, the first that it comes to there.
    Crossed {
        /// The object.
        object: u32,
        /// The primitive.
        primitive: u32,
        /// The face of the primitive.
        surface: u32,
        /// Where.
        t: f64,
        /// How far that may be off.
        error: f64,
        /// Whether the ray goes into the object there.
        entering: bool,
    },
    /// What an eye ray, a mirror or a Snell ray meets first of all.
    Hit {
        /// The object.
        object: u32,
        /// The primitive.
        primitive: u32,
        /// The face of the primitive.
        surface: u32,
        /// Where; from where the ray was sent.
        t: f64,
    },
    /// A lamp that shines on a surface, and the terms of its light there.
    Lit {
        /// The lamp, by its place among those that the plan requires.
        lamp: usize,
        /// `kd · (L·N)`.
        diffuse: f64,
        /// `ks · cosⁿθ`.
        highlight: f64,
        /// The share of the lamp's light that arrives, 0 to 1; absent where shadows are not asked for.
        visible: Option<f64>,
    },
}

impl RayEvent {
    /// The stage of the flow chart that it belongs to.
    pub const fn stage(&self) -> Stage {
        match self {
            Self::Sent { .. } => Stage::Ray,
            Self::Clipped => Stage::Clip,
            Self::Cell { .. } => Stage::Cell,
            Self::Tested { .. } => Stage::Solid,
            Self::Evaluated { .. } | Self::Crossed { .. } | Self::Hit { .. } => Stage::Csg,
            Self::Lit { .. } | Self::Truncated => Stage::Shade,
        }
    }
}
