//! The scenes inside the program, and plain requests for pictures of scenes.

use ray13::frame::Request;
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::Options;
use ray13::scene::{Camera, ReadOptions, Scene, embedded, read};
use ray13::tone::Tone;

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

/// Square dots and otherwise what the program does when nothing is asked for.
pub fn request(camera: Camera, dots: Size) -> Request {
    Request {
        camera,
        dots,
        dot_aspect: 1.0,
        options: Options::default(),
        glyphs: GlyphMode::default(),
        palette: Palette::default(),
        tone: Tone::default(),
    }
}
