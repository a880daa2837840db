//! The scenes inside the program.

use ray13::scene::{ReadOptions, Scene, embedded, read};

/// The name and the scene of each, in the order of `ray13 scenes`.
pub fn embedded_scenes() -> Vec<(&'static str, Scene)> {
    embedded()
        .iter()
        .map(|scene| {
            let read = read(scene.name, scene.text.as_bytes(), &ReadOptions::default());
            (scene.name, read.unwrap_or_else(|e| panic!("{e}")))
        })
        .collect()
}
