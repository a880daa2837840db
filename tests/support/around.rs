//! A scene from all around, as two readings of it are held against each other.

use ray13::frame::{Frame, Studio};
use ray13::math::{DVec3, Size};
use ray13::scene::{Camera, Scene};

use super::request::request;

/// Dots of a picture.
pub const DOTS: Size = Size { width: 60, height: 60 };

/// The picture of a scene.
pub fn frame(scene: &Scene, camera: &Camera) -> Frame {
    Studio::new(scene.clone()).unwrap().draw_anew(&request(camera.clone(), DOTS))
}

/// How far the eye stands off, and cameras that look at the scene's middle from these directions.
pub fn cameras_around(scene: &Scene, eyes: [[f64; 3]; 3]) -> (f64, [Camera; 3]) {
    let own = Studio::new(scene.clone()).unwrap().camera(0, 1.0);
    let away = (own.eye - own.target).length();
    let camera = |eye: [f64; 3]| {
        let eye = own.target + DVec3::from(eye).normalize() * away;
        Camera { eye, up: DVec3::new(0.13, 0.95, 0.2), ..own.clone() }
    };
    (away, eyes.map(camera))
}
