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
    /// Beyond which faces of the world's box an eye ray starts, after it was moved nearer.
    Coded {
        /// Bit `2·axis` below the lower face, `2·axis + 1` above the upper; 0 inside.
        outcode: u8,
        /// So far it was moved.
        moved: f64,
    },
    /// The ray misses the world.
    Clipped,
    /// The ray comes into the world's box.
    Entered {
        /// Where, from where it was moved to.
        t: f64,
    },
    /// The ray comes into a cell, or a box.
    Cell {
        /// Where it does, or before.
        from: f64,
        /// The cell's number in scan order, x fastest, where it is one of the lattice of all objects.
        number: Option<u32>,
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
    /// An eye ray, a mirror or a Snell ray meets nothing.
    Missed,
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
        /// `Ip · V · (kd·C·(L·N) + ks·cosⁿθ)`, as luminance.
        adds: f64,
    },
    /// The light of a surface by itself, `ambient + lamps / (R + k)`, as luminance.
    Gathered {
        /// `Ia·C`.
        ambient: f64,
        /// `Σ Ip · V · (kd·C·(L·N) + ks·cosⁿθ)`.
        lamps: f64,
        /// `R`: the way from the eye to the surface.
        path_length: f64,
        /// All of it.
        light: f64,
    },
    /// What comes of a mirror or Snell ray, and of all that were sent on from where it ended: the last that
    /// was sent and has not arrived yet.
    Arrived {
        /// The light along it, as luminance.
        light: f64,
        /// `kr`, or `kt` of what went on: the share of it that is added.
        share: f64,
    },
}

impl RayEvent {
    /// The stage of the flow chart that it belongs to.
    pub const fn stage(&self) -> Stage {
        match self {
            Self::Sent { .. } => Stage::Ray,
            Self::Coded { .. } | Self::Clipped | Self::Entered { .. } => Stage::Clip,
            Self::Cell { .. } => Stage::Cell,
            Self::Tested { .. } => Stage::Solid,
            Self::Evaluated { .. } | Self::Crossed { .. } | Self::Hit { .. } | Self::Missed => Stage::Csg,
            Self::Lit { .. } | Self::Gathered { .. } | Self::Arrived { .. } | Self::Truncated => Stage::Shade,
        }
    }
}
