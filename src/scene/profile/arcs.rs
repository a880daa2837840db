//! How many corners stand for a circle, as OpenSCAD counts them.

use crate::math::DVec2;
use crate::scene::degrees;

/// More corners than this no curve, and no sweep, is cut into: it would take longer than anybody waits.
pub const MOST_CORNERS: f64 = 2e6;

/// Below this length OpenSCAD takes a radius for none: the side of a cell of its grid, 2⁻²⁰.
const LEAST_RADIUS: f64 = 1.0 / (1 << 20) as f64;

/// `$fn`, `$fa` and `$fs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragments {
    /// `$fn`: how many sides stand for a circle; 0 leaves it to the others.
    pub number: f64,
    /// `$fa`: the least angle of a side, in degrees.
    pub angle: f64,
    /// `$fs`: the least length of a side.
    pub size: f64,
}

impl Default for Fragments {
    fn default() -> Self {
        Self { number: 0.0, angle: 12.0, size: 2.0 }
    }
}

impl Fragments {
    /// How many sides stand for a circle of this radius: a whole number, 3 or more.
    pub fn of_circle(&self, radius: f64) -> f64 {
        if !(radius >= LEAST_RADIUS && self.number.is_finite()) {
            return 3.0;
        }
        if self.number > 0.0 {
            return self.number.trunc().max(3.0);
        }
        let (angle, size) = self.least();
        (360.0 / angle).min(radius * std::f64::consts::TAU / size).max(5.0).ceil()
    }

    /// How many slices a twist by so many degrees takes, of what reaches to `radius` from the axis and is
    /// scaled by `scale` towards its end.
    pub fn of_twist(&self, radius: f64, height: f64, twist: f64, scale: f64) -> f64 {
        let twist = twist.abs();
        // Three in a turn at least: of fewer, sides would cross the axis.
        let least = (twist / 120.0).ceil().max(1.0);
        if !(radius >= LEAST_RADIUS && self.number.is_finite()) {
            return least;
        }
        if self.number > 0.0 {
            return (twist / 360.0 * self.number).ceil().max(least);
        }
        let (angle, size) = self.least();
        let turn = twist.to_radians();
        let way = if scale == 1.0 {
            libm::hypot(turn * radius, height)
        } else {
            // A spiral of Archimedes between two radii, `turn` apart.
            let end = if scale > 1.0 { turn * scale / (scale - 1.0) } else { turn / (1.0 - scale) };
            let length =
                |theta: f64| 0.5 * radius / end * (theta * (1.0 + theta * theta).sqrt() + libm::asinh(theta));
            libm::hypot(length(end) - length(end - turn), height)
        };
        (twist / angle).ceil().min((way / size).ceil()).max(least)
    }

    /// How many slices a scale that is not the same along both axes takes, where it moves no point by more
    /// than `shift`.
    pub fn of_shift(&self, shift: f64, height: f64) -> f64 {
        if !(shift >= LEAST_RADIUS && self.number.is_finite()) {
            return 1.0;
        }
        if self.number > 0.0 {
            return self.number.trunc().max(1.0);
        }
        (libm::hypot(shift, height) / self.least().1).ceil().max(1.0)
    }

    /// `$fa` and `$fs`, not below OpenSCAD's least.
    fn least(&self) -> (f64, f64) {
        let least = |x: f64| if x > 0.01 { x } else { 0.01 };
        (least(self.angle), least(self.size))
    }
}

/// The corners of a regular polygon within a circle of this radius, the first on the x axis.
pub fn corners(radius: f64, count: f64) -> Vec<DVec2> {
    let corner = |i: usize| {
        let angle = 360.0 * i as f64 / count;
        DVec2::new(radius * degrees::cos(angle), radius * degrees::sin(angle))
    };
    (0..count as usize).map(corner).collect()
}
