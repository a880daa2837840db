//! Every view of every scene inside the program, as text that a person can look at and compare.

use crate::support::request::request;
use crate::support::scenery::embedded_scenes;
use ray13::frame::{Frame, Studio};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::output::{ansi, levels, text};
use ray13::scene::Camera;

/// What `Write` functions of the library write, as text.
fn written(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Escapes as `␛`, so that a snapshot is text on every screen.
fn visible(ansi: &str) -> String {
    ansi.replace('\x1b', "␛")
}

/// Draws every view of every scene and hands over its name, `scene-view`.
fn each_view(mut look: impl FnMut(&str, &Studio, &dyn Fn(f64) -> Camera)) {
    for (scene, contents) in embedded_scenes() {
        let studio = Studio::new(contents).unwrap();
        for index in 0..studio.scene().views.len().max(1) {
            let camera = |aspect| studio.camera(index, aspect);
            let name = camera(1.0).name.unwrap_or_else(|| "framed".to_owned());
            look(&format!("{scene}-{name}"), &studio, &camera);
        }
    }
}

/// The cells of all screens here.
const CELLS: Size = Size::new(60, 20);

/// A picture in characters, on cells twice as high as wide.
fn in_characters(
    studio: &Studio,
    camera: &dyn Fn(f64) -> Camera,
    glyphs: GlyphMode,
    palette: Palette,
) -> Frame {
    let cells = CELLS;
    let per_cell = glyphs.dots_per_cell();
    let dots = Size::new(cells.width * per_cell.width, cells.height * per_cell.height);
    let aspect = f64::from(cells.width) / (2.0 * f64::from(cells.height));
    let mut request = request(camera(aspect), dots);
    request.glyphs = glyphs;
    request.palette = palette;
    request.dot_aspect = aspect * f64::from(dots.height) / f64::from(dots.width);
    let frame = studio.draw(&request);
    assert_eq!(frame.cells.as_ref().unwrap().size(), cells);
    frame
}

#[test]
fn as_levels() {
    each_view(|name, studio, camera| {
        let request = request(camera(64.0 / 40.0), Size::new(64, 40));
        let frame = studio.draw(&request);
        insta::assert_snapshot!(
            format!("levels-{name}"),
            written(|out| levels(&frame.levels(request.tone), out))
        );
    });
}

#[test]
fn as_shades() {
    each_view(|name, studio, camera| {
        // Text alone is in the terminal's own ink.
        let frame = in_characters(studio, camera, GlyphMode::Shade, Palette::MONO);
        insta::assert_snapshot!(
            format!("shade-{name}"),
            written(|out| text(frame.cells.as_ref().unwrap(), out))
        );
        let frame = in_characters(studio, camera, GlyphMode::Shade, Palette::DOS);
        insta::assert_snapshot!(
            format!("shade-ansi-{name}"),
            visible(&written(|out| ansi(frame.cells.as_ref().unwrap(), out)))
        );
    });
}

#[test]
fn as_blocks() {
    each_view(|name, studio, camera| {
        // Text alone is in the terminal's own ink.
        let frame = in_characters(studio, camera, GlyphMode::Blocks, Palette::MONO);
        insta::assert_snapshot!(
            format!("blocks-{name}"),
            written(|out| text(frame.cells.as_ref().unwrap(), out))
        );
        let frame = in_characters(studio, camera, GlyphMode::Blocks, Palette::DOS);
        insta::assert_snapshot!(
            format!("blocks-ansi-{name}"),
            visible(&written(|out| ansi(frame.cells.as_ref().unwrap(), out)))
        );
    });
}
