//! Balls around what rays may meet.

use ray13::math::DVec3;

/// A ball.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    pub center: DVec3,
    pub radius: f64,
}

impl Ball {
    /// One around points.
    pub fn around(points: &[DVec3]) -> Self {
        let center = points.iter().fold(DVec3::ZERO, |sum, &p| sum + p / points.len() as f64);
        let radius = points.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
        Self { center, radius }
    }

    /// Whether a ray of direction `d`, of length 1, comes near it; a hundredth of its radius, and what
    /// rounding takes from the way there, are far more than any rounding.
    pub fn may_meet(&self, origin: DVec3, d: DVec3) -> bool {
        let to = self.center - origin;
        let near = self.radius * 1.01 + 8.0 * f64::EPSILON * (self.center.length() + origin.length());
        to.cross(d).length() <= near && to.dot(d) >= -near
    }
}
