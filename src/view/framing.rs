//! The view of a scene that has no camera: the whole scene, as OpenSCAD first shows it.

use crate::math::{Bounds, DVec3};
use crate::scene::Camera;

/// OpenSCAD's `$vpr` when it starts: degrees about x, then about z.
const VIEW_ROTATION: [f64; 2] = [55.0, 25.0];

/// Empty picture left around the scene, as a share of its size.
const MARGIN: f64 = 0.06;

/// The paper's field, in degrees.
const FIELD: [f64; 2] = [40.0, 25.0];

/// A camera that sees all of the box `b` in a picture `aspect` times as wide as high on the screen.
pub fn framed(b: &Bounds, aspect: f64) -> Camera {
    let [about_x, about_z] = VIEW_ROTATION.map(f64::to_radians);
    let (sx, cx) = libm::sincos(about_x);
    let (sz, cz) = libm::sincos(about_z);
    // Where the z axis goes when it is turned about x, then about z: from the target to the eye.
    let back = DVec3::new(sx * sz, -sx * cz, cx);
    let right = DVec3::Z.cross(back).normalize();
    let up = back.cross(right);
    let half = |degrees: f64| libm::tan(0.5 * degrees.to_radians());
    let (tx, ty) = (half(FIELD[0]), half(FIELD[1]));
    let (tx, ty) = if tx > ty * aspect { (tx, tx / aspect) } else { (ty * aspect, ty) };
    let center = b.center();
    // A corner is inside the picture from where its height over the line of sight is at most the tangent times
    // its distance along it.
    let needed = |corner: DVec3| {
        let q = corner - center;
        let across = q.dot(right).abs() / tx;
        let upward = q.dot(up).abs() / ty;
        (1.0 + MARGIN) * across.max(upward) + q.dot(back)
    };
    let distance = b.corners().into_iter().map(needed).fold(0.0, f64::max);
    Camera {
        name: None,
        eye: center + distance * back,
        target: center,
        up: DVec3::Z,
        field: FIELD,
        zoom: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Size;
    use crate::view::{Lens, Picture};

    #[test]
    fn every_corner_is_in_the_picture_and_one_is_near_the_rim() {
        for (b, dots) in [
            (Bounds::new(DVec3::NEG_ONE, DVec3::ONE), Size::new(160, 100)),
            (Bounds::new(DVec3::new(5.0, 0.0, 0.0), DVec3::new(6.0, 1.0, 40.0)), Size::new(160, 100)),
            (Bounds::new(DVec3::ZERO, DVec3::new(30.0, 1.0, 1.0)), Size::new(60, 200)),
        ] {
            let picture = Picture { dots, dot_aspect: 1.0 };
            let camera = framed(&b, picture.aspect());
            let lens = Lens::new(&camera, &picture);
            let mut widest: f64 = 0.0;
            for corner in b.corners() {
                let q = corner - lens.eye;
                let depth = q.dot(lens.forward);
                assert!(depth > 0.0);
                widest = widest.max(q.dot(lens.right).abs() / depth / lens.tangents[0]);
                widest = widest.max(q.dot(lens.up).abs() / depth / lens.tangents[1]);
            }
            assert!(widest < 1.0 && widest > 0.85, "{widest}");
        }
    }
}
