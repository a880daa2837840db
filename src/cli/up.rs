//! `--up`, which turns the camera or a mesh file.

use crate::math::DVec3;
use crate::scene::UpAxis;

/// What `--up` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Up {
    /// The direction upwards in the picture.
    Direction(DVec3),
    /// The axis of a mesh file that is up.
    Axis(UpAxis),
}

impl Up {
    /// The direction upwards in the picture, where it is given.
    pub fn direction(self) -> Option<DVec3> {
        match self {
            Self::Direction(direction) => Some(direction),
            Self::Axis(_) => None,
        }
    }

    /// The axis of a mesh file that is up, where it is given.
    pub fn axis(self) -> Option<UpAxis> {
        match self {
            Self::Direction(_) => None,
            Self::Axis(axis) => Some(axis),
        }
    }
}
