//! Light through glass, where one ray alone goes from surface to surface and the rays of a tile ask object by object.

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{Camera, ReadOptions, read};

use crate::request::request;
use crate::same::{difference, exact, fast};

#[track_caller]
fn same(name: &str, text: &str, dots: Size, eyes: &[DVec3]) {
    let scene = read(name, text.as_bytes(), &ReadOptions::default());
    let studio = Studio::new(scene.unwrap_or_else(|e| panic!("{e}"))).unwrap();
    let own = studio.camera(0, f64::from(dots.width) / f64::from(dots.height));
    let target = DVec3::new(0.1, 0.05, -0.07);
    let others = eyes.iter().map(|&eye| Camera { eye, target, ..own.clone() });
    for camera in others.chain([own.clone()]) {
        let request = request(camera, dots);
        let frame = fast(&studio, &request);
        assert!(frame.counts.shadow_hits > 0, "no light is stopped");
        if let Some(fault) = difference(&frame, &exact(&studio, &request, StructureChoice::None)) {
            panic!("from {}: {fault}", request.camera.eye);
        }
    }
}

// Found by random scenes: one way goes into the first and leaves both in one place, where the second is passed over.
#[test]
fn two_solids_that_end_in_one_place() {
    let text = "material(kd = 0.8, ks = 0.2, n = 24, kt = 0.7, index = 1.4) {
        cube(at = [0, 0, 0], semi = [0.5, 0.5, 1]);
        cube(at = [0.5, -1, 0], semi = [1.5, 1.5, 0.5]);
    }";
    let eyes = [DVec3::new(4.0, 3.0, 11.0), DVec3::new(6.0, 8.0, 7.0), DVec3::new(-5.0, 9.0, 6.0)];
    same("cubes.scene", text, Size::new(43, 37), &eyes);
}

// Found by random texts: the corners of the patch do not lie in a plane, and behind the ball it seems to be met again.
#[test]
fn a_bent_patch_that_reaches_into_a_ball() {
    let text = "l 2 1.129 0.9911721690219883 1 1 1
f 0 0 0 0 0.58 0 0.51 2
s 1 -2 0.01 5
pp 4
0.01 0 -2 0 0 0 0.01 1 3 0 0 0 4.097 0 1.074 0 0 0 0.01 -7.332 5 0 0 0
";
    same("patch.nff", text, Size::new(16, 10), &[]);
}
