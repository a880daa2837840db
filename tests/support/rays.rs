//! The rays of a picture, worked out without the program's own code.

use ray13::math::{DVec3, Size};
use ray13::scene::Camera;

/// The direction that each dot looks along, of length 1, in scan order: the picture geometry of the design,
/// written out again.
pub fn directions(camera: &Camera, dots: Size) -> Vec<DVec3> {
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let tangent = |degrees: f64| libm::tan(degrees.to_radians() / 2.0) / camera.zoom;
    let (mut across, mut down) = (tangent(camera.field[0]), tangent(camera.field[1]));
    // The field asked for is contained: the other angle widens until dots are as wide as high.
    let (width, height) = (f64::from(dots.width), f64::from(dots.height));
    across = across.max(down * width / height);
    down = down.max(across * height / width);
    let mut all = Vec::new();
    for j in 0..dots.height {
        for i in 0..dots.width {
            let x = (2.0 * (f64::from(i) + 0.5) / width - 1.0) * across;
            let y = (1.0 - 2.0 * (f64::from(j) + 0.5) / height) * down;
            all.push((forward + x * right + y * up).normalize());
        }
    }
    all
}
