//! The view of a scene that has no camera: the whole scene, as OpenSCAD first shows it.

use crate::math::DVec3;
use crate::scene::{Camera, FieldSpan};

/// OpenSCAD's `$vpr` when it starts: degrees about x, then about z.
const VIEW_ROTATION: [f64; 2] = [55.0, 25.0];

/// The share of the picture, along each axis, that the scene may fill.
const FILLED: f64 = 0.94;

/// The paper's field, in degrees.
const FIELD: [f64; 2] = [40.0, 25.0];

/// A camera that sees all of a scene from where OpenSCAD first does: [`framed_from`] there.
pub fn framed(support: impl Fn(DVec3) -> f64, aspect: f64) -> Camera {
    let [about_x, about_z] = VIEW_ROTATION.map(f64::to_radians);
    let (sx, cx) = libm::sincos(about_x);
    let (sz, cz) = libm::sincos(about_z);
    // Where the z axis goes when it is turned about x, then about z: from the target to the eye.
    framed_from(DVec3::new(sx * sz, -sx * cz, cx), DVec3::Z, support, aspect)
}

/// A camera that sees all of a scene, in the middle of a picture `aspect` times as wide as high on the
/// screen. `back` is the direction from the target to the eye, of length 1, and `pole` upwards in the
/// picture, not along `back`; `support(v)` is the greatest `p · v` of the scene's points.
///
/// A point q is left of the picture's right rim where `q·right − a ≤ t · (d − q·back)`, the eye being at
/// `a·right + b·up + d·back` and t the tangent of half the field: where `q · (right + t·back) ≤ a + t·d`. The
/// four rims ask for the support in four directions; two opposite ones give `d` by their sum, `a` or `b` by
/// their difference.
pub fn framed_from(back: DVec3, pole: DVec3, support: impl Fn(DVec3) -> f64, aspect: f64) -> Camera {
    let right = pole.cross(back).normalize();
    let up = back.cross(right);
    let half = |degrees: f64| libm::tan(0.5 * degrees.to_radians()) * FILLED;
    let (tx, ty) = (half(FIELD[0]), half(FIELD[1]));
    let (tx, ty) = if tx > ty * aspect { (tx, tx / aspect) } else { (ty * aspect, ty) };
    let rims = |axis: DVec3, t: f64| {
        let (plus, minus) = (support(axis + t * back), support(t * back - axis));
        (0.5 * (plus - minus), 0.5 * (plus + minus) / t)
    };
    let (a, across) = rims(right, tx);
    let (b, upward) = rims(up, ty);
    let d = across.max(upward);
    // The target is what the eye turns about: the middle of the scene along the line of sight.
    let middle = 0.5 * (support(back) - support(-back));
    let at = |depth: f64| a * right + b * up + depth * back;
    let camera = Camera {
        name: None,
        eye: at(d),
        target: at(middle),
        up: pole,
        field: FIELD,
        span: FieldSpan::Edges,
        zoom: 1.0,
    };
    if camera.check().is_ok() {
        return camera;
    }
    // A scene so small, where it stands, that eye and target are the same number: seen from any distance it
    // is a point.
    let away = camera.target.abs().max_element().max(1.0);
    Camera { eye: camera.target + away * back, ..camera }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Bounds, Size};
    use crate::view::{Picture, PinholeCamera};

    // What showed of a scene had vanished beside what was cut from it, and the eye stood at its target.
    #[test]
    fn a_point_is_seen_from_somewhere() {
        for point in [DVec3::ZERO, DVec3::ONE, DVec3::new(-1e300, 1e9, 0.0)] {
            assert_eq!(framed(|v| v.dot(point), 1.6).check(), Ok(()), "{point}");
        }
    }

    #[test]
    fn every_corner_is_in_the_picture_and_two_opposite_ones_are_at_the_rim() {
        for (b, dots) in [
            (Bounds::new(DVec3::NEG_ONE, DVec3::ONE), Size::new(160, 100)),
            (Bounds::new(DVec3::new(5.0, 0.0, 0.0), DVec3::new(6.0, 1.0, 40.0)), Size::new(160, 100)),
            (Bounds::new(DVec3::ZERO, DVec3::new(30.0, 1.0, 1.0)), Size::new(60, 200)),
        ] {
            let picture = Picture { dots, dot_aspect: 1.0 };
            let support =
                |v: DVec3| b.corners().into_iter().map(|p| p.dot(v)).fold(f64::NEG_INFINITY, f64::max);
            let pinhole = PinholeCamera::new(&framed(support, picture.aspect()), &picture);
            let place = |corner: DVec3| {
                let q = corner - pinhole.eye;
                let depth = q.dot(pinhole.forward);
                assert!(depth > 0.0);
                [
                    q.dot(pinhole.right) / depth / pinhole.tangents[0],
                    q.dot(pinhole.up) / depth / pinhole.tangents[1],
                ]
            };
            let places = b.corners().map(place);
            let reach = |axis: usize, sign: f64| places.iter().map(|p| sign * p[axis]).fold(0.0, f64::max);
            let ends = [reach(0, 1.0), reach(0, -1.0), reach(1, 1.0), reach(1, -1.0)];
            assert!(ends.iter().all(|&e| e < FILLED + 1e-12), "{ends:?}");
            let full = |a: f64, b: f64| (a - FILLED).abs() < 1e-12 && (b - FILLED).abs() < 1e-12;
            assert!(full(ends[0], ends[1]) || full(ends[2], ends[3]), "{ends:?}");
        }
    }
}
