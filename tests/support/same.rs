//! The picture of a request by each engine.

use ray13::frame::{Frame, Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{EngineChoice, StructureChoice};
use ray13::scene::{Camera, ReadOptions, read};

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;

/// The picture of the fast engine.
pub fn fast(studio: &Studio, request: &Request) -> Frame {
    let mut request = request.clone();
    (request.options.engine, request.options.structure) = (EngineChoice::Fast, StructureChoice::Auto);
    let frame = studio.draw_anew(&request);
    assert_eq!((frame.engine, frame.space.name()), (EngineChoice::Fast, "boxes"));
    frame
}

/// The picture of the exact engine by a structure.
pub fn exact(studio: &Studio, request: &Request, structure: StructureChoice) -> Frame {
    let mut request = request.clone();
    (request.options.engine, request.options.structure) = (EngineChoice::Exact, structure);
    let frame = studio.draw_anew(&request);
    assert_eq!(frame.engine, EngineChoice::Exact);
    frame
}

/// Checks that both engines give the same picture of a text in which something stands before a lamp: by its
/// own camera, and from some eyes.
#[track_caller]
pub fn same(name: &str, text: &str, dots: Size, eyes: &[DVec3]) {
    let scene = read(name, text.as_bytes(), &ReadOptions::default());
    let studio = Studio::new(scene.unwrap_or_else(|e| panic!("{e}"))).unwrap();
    let own = studio.camera(0, f64::from(dots.width) / f64::from(dots.height));
    let target = DVec3::new(0.1, 0.05, -0.07);
    let others = eyes.iter().map(|&eye| Camera { eye, target, ..own.clone() });
    for camera in others.chain([own.clone()]) {
        let request = request(camera, dots);
        let frame = fast(&studio, &request);
        assert!(frame.counts.shadow_hits > 0, "no light is stopped");
        let what = format!("from {}", request.camera.eye);
        assert_same_picture(&what, &frame, &exact(&studio, &request, StructureChoice::None));
    }
}
