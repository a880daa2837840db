//! A file has the same bytes on any number of threads.

use std::fs;

use super::{done, folder, ray13};

#[test]
fn files_do_not_depend_on_threads() {
    let folder = folder("threads");
    for scene in ray13::scene::embedded() {
        let file = folder.join(format!("{}.scene", scene.name));
        fs::write(&file, scene.text).unwrap();
        // Threads share out the frame; what is written of it is made by one, and looked at once.
        let formats =
            if scene.name == "die" { &["txt", "ans", "levels", "png", "pfm"][..] } else { &["pfm"] };
        for format in formats {
            let bytes = |threads: usize| {
                let mut command = ray13();
                command.arg("render").arg(&file);
                command.args(["--dots", "90x66", "--format", format, "--threads", &threads.to_string()]);
                let bytes = done(&command.output().unwrap());
                assert!(!bytes.is_empty());
                bytes
            };
            let one = bytes(1);
            for threads in [2, 7] {
                assert!(bytes(threads) == one, "{} as {format} on {threads} threads", scene.name);
            }
        }
    }
}
