//! Tests of the language as a whole: text in, scene or messages out.

use crate::scene::{ReadOptions, Scene, read};

/// A scene that reads.
fn scene(text: &str) -> Scene {
    read("test", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// The messages of a scene that does not.
fn errors(text: &str) -> String {
    match read("test", text.as_bytes(), &ReadOptions::default()) {
        Ok(scene) => panic!("no error, but {scene:?}"),
        Err(errors) => errors.to_string(),
    }
}
