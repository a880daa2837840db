//! The same input gives the same bytes, on any number of threads.

use crate::support::request::request;
use crate::support::scenery::embedded_scenes;
use ray13::frame::{Frame, Studio};
use ray13::math::Size;

/// An even number, and more than divide the rows evenly.
const THREADS: [usize; 2] = [2, 7];

/// Everything of a frame that is not a time, floats to the bit.
fn contents(frame: &Frame) -> impl PartialEq + use<> {
    let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let normals: Vec<_> =
        frame.normal.as_ref().unwrap().values().iter().map(|n| n.to_array().map(f64::to_bits)).collect();
    let object = frame.object.as_ref().unwrap().values().to_vec();
    let cells = frame.cells.as_ref().unwrap().values().to_vec();
    (
        bits(frame.light.values()),
        bits(frame.depth.as_ref().unwrap().values()),
        normals,
        object,
        cells,
        frame.counts,
    )
}

#[test]
fn frames_do_not_depend_on_threads() {
    for (name, scene) in embedded_scenes() {
        let studio = Studio::new(scene).unwrap();
        let draw = |threads| {
            let mut request = request(studio.camera(0, 1.5), Size::new(122, 84));
            request.options.threads = threads;
            studio.draw_anew(&request)
        };
        let one = contents(&draw(1));
        for threads in THREADS {
            let frame = draw(threads);
            assert!(contents(&frame) == one, "{name} on {threads} threads");
        }
    }
}
