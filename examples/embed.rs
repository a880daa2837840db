//! A solid in a ratatui program of your own: `cargo run --example embed`.
//!
//! It draws once, on a terminal in memory, and prints that. On a real one `ratatui::init()` takes its place,
//! and the picture is drawn again whenever the camera has moved.

use std::error::Error;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::layout::Rect;
use ratatui::widgets::Block;
use ray13::frame::{Request, Studio, Wants};
use ray13::glyph::{GlyphMode, Palette};
use ray13::math::Size;
use ray13::plan::Options;
use ray13::scene::{self, ReadOptions};
use ray13::tone::Tone;
use ray13::widget::PictureWidget;

/// Width of a character cell divided by its height; a program that can ask its terminal does better.
const CELL_ASPECT: f64 = 0.5;

/// The scene's first view, or the whole scene where it has none, for the cells of an area.
fn request(studio: &Studio, area: Rect) -> Request {
    let glyphs = GlyphMode::Blocks;
    let per_cell = glyphs.dots_per_cell();
    let dots = Size::new(u32::from(area.width) * per_cell.width, u32::from(area.height) * per_cell.height);
    Request {
        camera: studio.camera(0, CELL_ASPECT * f64::from(area.width) / f64::from(area.height)),
        dots,
        dot_aspect: CELL_ASPECT * f64::from(per_cell.height) / f64::from(per_cell.width),
        options: Options::default(),
        wants: Wants::CELLS,
        glyphs,
        palette: Palette::MONO, // `Palette::DOS` where there are colours
        tone: Tone::default(),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let text = b"difference() { cube(2, center = true); sphere(1.3); }";
    let studio = Studio::new(scene::read("part.csg", text, &ReadOptions::default())?)?;

    let mut terminal = Terminal::new(TestBackend::new(60, 20))?;
    terminal.draw(|screen| {
        let block = Block::bordered().title(" part.csg ");
        let inside = block.inner(screen.area());
        screen.render_widget(block, screen.area());
        if inside.area() > 0 {
            let frame = studio.draw(&request(&studio, inside));
            if let Some(cells) = &frame.cells {
                screen.render_widget(PictureWidget(cells), inside);
            }
        }
    })?;
    print!("{}", terminal.backend());
    Ok(())
}
