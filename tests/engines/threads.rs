//! The same input gives the same bytes, on any number of threads.

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::scenery::embedded_scenes;
use ray13::frame::Studio;
use ray13::math::Size;

/// An even number, and more than divide the rows evenly.
const THREADS: [usize; 2] = [2, 7];

#[test]
fn frames_do_not_depend_on_threads() {
    for (name, scene) in embedded_scenes() {
        let studio = Studio::new(scene).unwrap();
        let draw = |threads| {
            let mut request = request(studio.camera(0, 1.5), Size::new(122, 84));
            request.options.threads = threads;
            studio.draw_anew(&request)
        };
        let one = draw(1);
        for threads in THREADS {
            let frame = draw(threads);
            let what = format!("{name} on {threads} threads");
            assert_same_picture(&what, &frame, &one);
            assert_eq!(frame.counts, one.counts, "{what}");
        }
    }
}
