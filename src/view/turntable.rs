//! A scene on a turntable: cameras that go round its upright axis, and what a full turn shows of it.

use std::f64::consts::TAU;

use crate::math::DVec3;
use crate::scene::Camera;

/// Of a full turn the outline is taken in so many directions: between two of them a point stands out by at
/// most 1 − cos 5°, 0.4 %, and framing leaves 6 % free.
const SWEPT: u32 = 36;

/// An axis about which a camera turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turntable {
    middle: DVec3,
    /// The axis' direction, of length 1.
    pole: DVec3,
}

impl Turntable {
    /// The axis through a point along `up`, which is of any length but 0.
    pub fn new(middle: DVec3, up: DVec3) -> Self {
        // Scaled first, so that no square overflows or vanishes.
        Self { middle, pole: (up / up.abs().max_element()).normalize() }
    }

    /// The camera after a share of a full turn, 0 to 1, counter-clockwise as seen from above: the scene turns
    /// the other way.
    pub fn camera(&self, camera: &Camera, turn: f64) -> Camera {
        if turn == 0.0 {
            return camera.clone();
        }
        let moved = |point: DVec3| self.middle + self.turned(point - self.middle, turn);
        Camera {
            eye: moved(camera.eye),
            target: moved(camera.target),
            up: self.turned(camera.up, turn),
            ..camera.clone()
        }
    }

    /// The support in a direction of all that a scene covers in a full turn; `support` is the scene's own,
    /// the greatest `p · v` of its points.
    pub fn swept_support(&self, support: impl Fn(DVec3) -> f64, v: DVec3) -> f64 {
        let outward = |k: u32| {
            let turned = self.turned(v, f64::from(k) / f64::from(SWEPT));
            support(turned) - self.middle.dot(turned)
        };
        (0..SWEPT).map(outward).fold(f64::NEG_INFINITY, f64::max) + self.middle.dot(v)
    }

    /// A direction turned about the axis (Rodrigues).
    fn turned(&self, v: DVec3, turn: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(turn * TAU);
        let along = self.pole * self.pole.dot(v);
        along + (v - along) * cos + self.pole.cross(v) * sin
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::FieldSpan;

    fn camera() -> Camera {
        Camera {
            name: None,
            eye: DVec3::new(3.0, -9.0, 5.0),
            target: DVec3::new(1.0, 0.0, 1.0),
            up: DVec3::Z,
            field: [40.0, 25.0],
            span: FieldSpan::Edges,
            zoom: 1.0,
        }
    }

    #[test]
    fn a_quarter_of_a_turn_takes_the_eye_to_the_right() {
        let table = Turntable::new(DVec3::new(1.0, 1.0, 7.0), DVec3::Z * 1e300);
        let turned = table.camera(&camera(), 0.25);
        assert!((turned.eye - DVec3::new(11.0, 3.0, 5.0)).length() < 1e-14, "{}", turned.eye);
        assert!((turned.target - DVec3::new(2.0, 1.0, 1.0)).length() < 1e-14, "{}", turned.target);
        assert_eq!(table.camera(&camera(), 0.0), camera());
    }

    #[test]
    fn what_turns_covers_a_ring() {
        // A point three units beside the axis comes to all sides of it.
        let table = Turntable::new(DVec3::new(2.0, 0.0, 0.0), DVec3::Z);
        let support = |v: DVec3| DVec3::new(5.0, 0.0, 4.0).dot(v);
        for (v, expected) in [(DVec3::X, 5.0), (DVec3::NEG_X, 1.0), (DVec3::Y, 3.0), (DVec3::Z, 4.0)] {
            assert!((table.swept_support(support, v) - expected).abs() < 1e-12, "{v}");
        }
    }
}
