//! The same input gives the same bytes, on any number of threads.

mod request;
mod scenery;

use std::process::Command;

use ray13::frame::{Frame, Studio};
use ray13::math::Size;
use request::request;
use scenery::embedded_scenes;

/// One, an even number and more than divide the rows evenly.
const THREADS: [usize; 3] = [1, 2, 7];

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
        let first = draw(THREADS[0]);
        let one = contents(&first);
        for threads in THREADS {
            let frame = draw(threads);
            assert!(contents(&frame) == one, "{name} on {threads} threads");
        }
    }
}

#[test]
fn files_do_not_depend_on_threads() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("threads");
    std::fs::create_dir_all(&folder).unwrap();
    for scene in ray13::scene::embedded() {
        let file = folder.join(format!("{}.scene", scene.name));
        std::fs::write(&file, scene.text).unwrap();
        for format in ["txt", "ans", "levels", "png", "pfm"] {
            let bytes = |threads: usize| {
                let out = Command::new(env!("CARGO_BIN_EXE_ray13"))
                    .arg("render")
                    .arg(&file)
                    .args(["--dots", "90x66", "--format", format, "--threads", &threads.to_string()])
                    .output()
                    .unwrap();
                assert!(out.status.success(), "{}: {}", scene.name, String::from_utf8_lossy(&out.stderr));
                assert!(!out.stdout.is_empty());
                out.stdout
            };
            let one = bytes(THREADS[0]);
            for threads in THREADS {
                assert!(bytes(threads) == one, "{} as {format} on {threads} threads", scene.name);
            }
        }
    }
}
