//! Why a picture is all background.

use std::fmt;

use crate::math::DVec3;

use super::{Frame, Request, Studio};

/// Why no ray from the eye met anything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nothing {
    /// No object holds anything.
    Empty,
    /// All of the scene lies behind the eye.
    Behind,
    /// All of it lies beside the picture, whose full angles across and down are these, in degrees.
    Outside([f64; 2]),
    /// All of it is smaller than a dot: the eye is so many times as far away as it is large.
    Far(f64),
    /// The scene reaches into the picture; nothing of it stands where the rays go.
    Past,
}

impl fmt::Display for Nothing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "no object holds anything"),
            Self::Behind => write!(f, "the scene lies behind the eye"),
            Self::Outside([across, down]) => {
                write!(f, "the scene lies outside of the field of {across:.1}° × {down:.1}°")
            }
            Self::Far(times) if *times < 1e6 => {
                write!(f, "the eye is {times:.0} times as far away as the scene is large")
            }
            Self::Far(times) => write!(f, "the eye is {times:.0e} times as far away as the scene is large"),
            Self::Past => write!(f, "no ray meets anything"),
        }
    }
}

impl Studio {
    /// Why a frame that was drawn of a request is all background; `None` where a ray from the eye met something, or none was
    /// traced.
    pub fn nothing_in_view(&self, request: &Request, frame: &Frame) -> Option<Nothing> {
        let counts = &frame.counts;
        (counts.primary_rays > 0 && counts.primary_hits == 0).then(|| self.why_nothing(request))
    }

    fn why_nothing(&self, request: &Request) -> Nothing {
        let (lens, _) = self.plan(request);
        let assembly = &self.assembly;
        if assembly.objects.is_empty() {
            return Nothing::Empty;
        }
        // From the eye, and halved: no difference of two finite numbers overflows.
        let from_eye = |p: DVec3| 0.5 * assembly.datum.outward(p) - 0.5 * lens.eye;
        let (lo, hi) = (assembly.limit.lo, assembly.limit.hi);
        let corners: [DVec3; 8] = std::array::from_fn(|k| {
            from_eye(DVec3::from_array(std::array::from_fn(
                |axis| if k >> axis & 1 == 1 { hi } else { lo }[axis],
            )))
        });
        // In units of the farthest, so that no product overflows either.
        let far = corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
        if far == 0.0 {
            return Nothing::Past;
        }
        let corners = corners.map(|corner| corner / far);
        let all = |is: &dyn Fn(DVec3) -> bool| corners.iter().all(|&corner| is(corner));
        if all(&|c| c.dot(lens.forward) <= 0.0) {
            return Nothing::Behind;
        }
        let [across, down] = lens.tangents;
        for (side, tangent) in [(lens.right, across), (lens.up, down)] {
            // Nothing is beyond a side of the picture that is at 90° to the line of sight or more: a tangent of 1e16.
            let beyond = |sign: f64| all(&|c| sign * c.dot(side) > tangent * c.dot(lens.forward));
            if beyond(1.0) || beyond(-1.0) {
                return Nothing::Outside(lens.field());
            }
        }
        let size = 0.5 * assembly.datum.unit * (hi - lo).length() / far;
        let distance = corners.iter().map(|c| c.length()).fold(f64::INFINITY, f64::min);
        if size < distance * lens.least_dot() { Nothing::Far(distance / size) } else { Nothing::Past }
    }
}
