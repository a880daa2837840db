//! What a piece of a Bézier patch lies in: a ball, and a slab across its mean normal. Most rays that come
//! near its box are told by these, for a tenth of what its control points cost, to pass beside it.

use crate::math::{Bounds, DVec3, Number, Vector};

/// A ball, and a slab through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shell {
    center: DVec3,
    radius: f64,
    /// Of length 1, or 0: then the slab is the whole of space.
    axis: DVec3,
    half_height: f64,
}

impl Shell {
    /// Around control points. A line is beside them only where it is farther away than `apart`, which has to
    /// be at least what rounding may have moved a point by.
    pub fn around(points: &[DVec3; 16], axis: DVec3, apart: f64) -> Self {
        let center = Bounds::around(*points).center();
        let farthest = |of: &dyn Fn(DVec3) -> f64| points.iter().map(|&p| of(p - center)).fold(0.0, f64::max);
        let radius = farthest(&|q| q.length()) + apart;
        let half_height = farthest(&|q| q.dot(axis).abs()) + apart;
        Self { center, radius, axis, half_height }
    }

    /// Which lines certainly pass beside it, from `o` along `d`, of length 1.
    ///
    /// The slab is looked at along the ray: by the plane that holds the ray and leans as little as it can
    /// from the slab's. A point of the ball and the slab is no farther from the middle across that plane
    /// than half the slab's height and the radius times the sine of the angle between ray and slab.
    #[inline(always)]
    pub fn is_beside<N: Number>(&self, o: Vector<N>, d: Vector<N>) -> N::Mask {
        let way = o - self.center;
        let foot = way - d * way.dot(d);
        let zero = d.x.same(0.0);
        let height = foot.dot_one(self.axis).magnitude();
        let reach = d.dot_one(self.axis).magnitude() * self.radius + self.half_height;
        foot.length_squared().is_above(zero.same(self.radius * self.radius)) | height.is_above(reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet over the unit square, a tenth high.
    fn shell() -> Shell {
        let points = std::array::from_fn(|i| {
            DVec3::new((i % 4) as f64 / 3.0, (i / 4) as f64 / 3.0, 0.1 * (i % 2) as f64)
        });
        Shell::around(&points, DVec3::Z, 1e-12)
    }

    fn is_beside(o: DVec3, d: DVec3) -> bool {
        shell().is_beside(o.into(), d.normalize().into())
    }

    #[test]
    fn a_ray_beside_the_ball_or_the_slab_is_beside() {
        assert!(is_beside(DVec3::new(2.0, 0.5, 5.0), DVec3::NEG_Z));
        assert!(is_beside(DVec3::new(-5.0, 0.5, 0.2), DVec3::X), "within the ball, above the slab");
        assert!(is_beside(DVec3::new(0.5, 0.5, 0.2), DVec3::new(1.0, 0.0, 0.05)));
    }

    #[test]
    fn a_ray_through_any_of_the_points_is_not() {
        for d in [DVec3::Z, DVec3::X, DVec3::new(1.0, 2.0, 0.1), DVec3::new(-1.0, 0.3, -0.001)] {
            for (x, y, z) in [(0.0, 0.0, 0.0), (1.0, 1.0, 0.1), (1.0, 0.0, 0.1), (0.5, 0.5, 0.05)] {
                let p = DVec3::new(x, y, z);
                assert!(!is_beside(p - d * 3.0, d), "{p} {d}");
            }
        }
    }
}
