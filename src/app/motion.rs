//! How the keys move the camera: orbit about the target, fly with it, zoom. Every move keeps the camera
//! valid.

use libm::{atan2, cos, hypot, sin, tan};

use crate::math::DVec3;
use crate::scene::Camera;

/// One press turns by this many degrees: 72 go once around.
pub const ORBIT_STEP: f64 = 5.0;

/// One press flies this part of the way from the eye to the target.
pub const FLY_STEP: f64 = 1.0 / 20.0;

/// One press multiplies the zoom by the fourth root of 2: four double it.
pub const ZOOM_STEP: f64 = 1.189_207_115_002_721;

/// The highest elevation over the plane across `up`, in degrees. At 90 the line of sight would lie along `up`
/// and the picture would have no right; one tenth is what the status line shows.
const HIGHEST: f64 = 89.9;

/// The narrowest and the widest field that zooming reaches, in degrees: below, the status line shows 0.0;
/// above, the outer half of the picture is one degree of the world.
const FIELDS: [f64; 2] = [0.1, 170.0];

/// The direction of sight: azimuth in `−180..=180` and elevation in `−90..=90`, in degrees. With `up` along z
/// the azimuth counts from x towards y; with another `up`, from its own axes.
pub fn direction(camera: &Camera) -> [f64; 2] {
    let (azimuth, elevation, _) = polar(camera.target - camera.eye, camera.up);
    [azimuth.to_degrees(), elevation.to_degrees()]
}

/// Moves the eye around the target, to the right and upwards, in degrees. The distance is kept, and so is
/// `up`.
pub fn orbit(camera: &Camera, right: f64, up: f64) -> Camera {
    let (azimuth, elevation, distance) = polar(camera.eye - camera.target, camera.up);
    let highest = HIGHEST.to_radians();
    let azimuth = azimuth + right.to_radians();
    let elevation = (elevation + up.to_radians()).clamp(-highest, highest);
    let pole = unit(camera.up);
    let (east, north) = pole.any_orthonormal_pair();
    let level = east * cos(azimuth) + north * sin(azimuth);
    let offset = (level * cos(elevation) + pole * sin(elevation)) * distance;
    valid_or(camera, Camera { eye: camera.target + offset, ..camera.clone() })
}

/// Moves the eye and the target together: along the line of sight, to the right, and along `up`. Each in
/// units of the distance from the eye to the target.
pub fn fly(camera: &Camera, forward: f64, right: f64, up: f64) -> Camera {
    let sight = camera.target - camera.eye;
    let distance = length(sight);
    let ahead = unit(sight);
    let aside = unit(ahead.cross(unit(camera.up)));
    let way = (ahead * forward + aside * right + unit(camera.up) * up) * distance;
    valid_or(camera, Camera { eye: camera.eye + way, target: camera.target + way, ..camera.clone() })
}

/// Divides both tangents of the field by `factor`, as far as [`FIELDS`] allows.
pub fn zoom(camera: &Camera, factor: f64) -> Camera {
    let [narrow, wide] = camera.field.map(half_tangent);
    let nearest = narrow.max(wide) / half_tangent(FIELDS[0]);
    let widest = narrow.max(wide) / half_tangent(FIELDS[1]);
    // A view that starts beyond a limit stays where it is rather than jump.
    let zoom = (camera.zoom * factor).clamp(widest.min(camera.zoom), nearest.max(camera.zoom));
    Camera { zoom, ..camera.clone() }
}

/// From the eye to the target.
pub fn distance(camera: &Camera) -> f64 {
    length(camera.target - camera.eye)
}

fn half_tangent(degrees: f64) -> f64 {
    tan((degrees / 2.0).to_radians())
}

/// Azimuth, elevation (radians) and length of a vector, about the pole `up`.
fn polar(v: DVec3, up: DVec3) -> (f64, f64, f64) {
    let distance = length(v);
    let v = unit(v);
    let pole = unit(up);
    // For the pole z this pair is x and y, for y it is x and −z: right-handed, and without a singular pole.
    let (east, north) = pole.any_orthonormal_pair();
    let (x, y, z) = (v.dot(east), v.dot(north), v.dot(pole));
    (atan2(y, x), atan2(z, hypot(x, y)), distance)
}

/// The length, without the overflow of squares.
fn length(v: DVec3) -> f64 {
    hypot(hypot(v.x, v.y), v.z)
}

/// The direction, without the overflow of squares.
fn unit(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).normalize() } else { DVec3::Z }
}

/// The camera after a move, or the one before where the numbers end: so far from the origin that eye and
/// target become one, or beyond the largest number.
fn valid_or(before: &Camera, after: Camera) -> Camera {
    let sight = after.target - after.eye;
    let holds =
        after.eye.is_finite() && after.target.is_finite() && sight.is_finite() && sight != DVec3::ZERO;
    // Up to half the distance may be lost to rounding before a picture is no use.
    if holds && length(sight) > 0.5 * distance(before) { after } else { before.clone() }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn front() -> Camera {
        Camera {
            name: None,
            eye: DVec3::new(0.0, -9.0, 3.0),
            target: DVec3::ZERO,
            up: DVec3::Z,
            field: [40.0, 25.0],
            span: crate::scene::FieldSpan::Edges,
            zoom: 1.0,
        }
    }

    /// Half tangents of the field as zoomed.
    fn tangents(camera: &Camera) -> [f64; 2] {
        camera.field.map(|angle| half_tangent(angle) / camera.zoom)
    }

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1.0)
    }

    #[test]
    fn the_front_view_looks_north_and_down() {
        let [azimuth, elevation] = direction(&front());
        assert!(near(azimuth, 90.0));
        assert!((elevation - -18.4).abs() < 0.05);
    }

    #[test]
    fn orbiting_right_moves_the_eye_right() {
        let right = orbit(&front(), ORBIT_STEP, 0.0);
        assert!(right.eye.x > 0.0 && near(right.eye.z, 3.0));
        assert!(orbit(&front(), 0.0, ORBIT_STEP).eye.z > 3.0);
    }

    #[test]
    fn seventy_two_steps_go_once_around() {
        let around = (0..72).fold(front(), |camera, _| orbit(&camera, ORBIT_STEP, 0.0));
        assert!(around.eye.distance(front().eye) < 1e-9);
    }

    #[test]
    fn the_poles_are_approached_but_not_passed() {
        for step in [ORBIT_STEP, -ORBIT_STEP] {
            let top = (0..100).fold(front(), |camera, _| orbit(&camera, 0.0, step));
            assert!(near(direction(&top)[1], -step.signum() * 89.9));
            let back = (0..100).fold(top, |camera, _| orbit(&camera, 0.0, -step));
            assert!(near(direction(&back)[1], step.signum() * 89.9));
            assert!(near(direction(&back)[0], 90.0), "the azimuth survives the pole");
        }
    }

    #[test]
    fn another_up_has_its_own_horizon() {
        let camera = Camera { eye: DVec3::new(0.0, 0.0, 9.0), up: DVec3::new(0.0, 5.0, 0.0), ..front() };
        let [azimuth, elevation] = direction(&camera);
        assert!(near(azimuth, 90.0) && near(elevation, 0.0), "{azimuth} {elevation}");
        let right = orbit(&camera, 90.0, 0.0);
        assert!(right.eye.distance(DVec3::new(9.0, 0.0, 0.0)) < 1e-9, "{}", right.eye);
        assert_eq!(orbit(&camera, 0.0, 30.0).up, camera.up);
    }

    #[test]
    fn flying_moves_a_part_of_the_distance() {
        let camera = Camera { eye: DVec3::new(0.0, -10.0, 0.0), ..front() };
        let step = 10.0 * FLY_STEP;
        assert!(near(fly(&camera, FLY_STEP, 0.0, 0.0).eye.y, -10.0 + step));
        assert!(near(fly(&camera, 0.0, FLY_STEP, 0.0).eye.x, step));
        assert!(near(fly(&camera, 0.0, 0.0, FLY_STEP).eye.z, step));
    }

    #[test]
    fn zoom_divides_both_tangents_alike_between_its_limits() {
        let near_by = (0..4).fold(front(), |camera, _| zoom(&camera, ZOOM_STEP));
        let [across, down] = tangents(&near_by);
        assert!(near(across * 2.0, half_tangent(40.0)) && near(down * 2.0, half_tangent(25.0)));
        let widest = (0..100).fold(front(), |camera, _| zoom(&camera, 1.0 / ZOOM_STEP));
        assert!(near(tangents(&widest)[0], half_tangent(170.0)));
        let nearest = (0..100).fold(front(), |camera, _| zoom(&camera, ZOOM_STEP));
        assert!(near(tangents(&nearest)[0], half_tangent(0.1)));
        let beyond = Camera { field: [179.0, 25.0], ..front() };
        assert_eq!(zoom(&beyond, 1.0 / ZOOM_STEP).zoom, 1.0);
    }

    #[test]
    fn a_move_beyond_the_numbers_is_no_move() {
        let far = Camera { eye: DVec3::splat(1e20), target: DVec3::splat(1e20 + 1e5), ..front() };
        let moved = fly(&far, 0.01, 0.0, 0.0);
        assert!(moved.eye != moved.target);
        let vast = Camera { eye: DVec3::new(0.0, -1.7e308, 0.0), ..front() };
        assert!(fly(&vast, -1.0, 0.0, 0.0).eye.is_finite());
    }

    fn camera() -> impl Strategy<Value = Camera> {
        let vector = || prop::array::uniform3(-1.0..1.0f64).prop_map(DVec3::from_array);
        (vector(), vector(), vector(), -100..100i32)
            .prop_map(|(eye, target, up, scale)| {
                let scale = libm::exp2(f64::from(scale));
                Camera { eye: eye * scale, target: target * scale, up, ..front() }
            })
            .prop_filter("a valid camera", |camera| {
                let sight = unit(camera.target - camera.eye);
                length(camera.up) > 0.01
                    && distance(camera) > 0.01 * length(camera.eye)
                    && sight.cross(unit(camera.up)).length() > 0.01
            })
    }

    proptest! {
        #[test]
        fn orbit_keeps_the_distance(camera in camera(), right in -180.0..180.0f64, up in -180.0..180.0f64) {
            let after = orbit(&camera, right, up);
            prop_assert!((distance(&after) / distance(&camera) - 1.0).abs() < 1e-12);
            prop_assert_eq!(after.target, camera.target);
            prop_assert!(unit(after.target - after.eye).cross(unit(after.up)).length() > 1e-3);
        }

        #[test]
        fn flight_keeps_the_direction(camera in camera(), way in prop::array::uniform3(-1.0..1.0f64)) {
            let after = fly(&camera, way[0], way[1], way[2]);
            let (before, after) = (camera.target - camera.eye, after.target - after.eye);
            prop_assert!((after - before).length() < 1e-12 * before.length().max(camera.eye.length()) * 8.0);
        }
    }
}
