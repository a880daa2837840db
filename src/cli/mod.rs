//! (to be written)

use std::process::ExitCode;

use crate::app::{self, Painter, Settings};
use crate::frame::{Frame, Request, Studio};
use crate::glyph::{Cell, Paint};
use crate::math::{Grid, Size};
use crate::scene::{Camera, Scene};
use crate::view::{Lens, Picture};

/// Runs the command line.
pub fn run() -> ExitCode {
    let settings = Settings { title: "empty.scene".to_owned(), ..Settings::default() };
    match app::run(Fake(Studio::new(Scene::default())), settings) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("ray13: {error}");
            ExitCode::FAILURE
        }
    }
}

struct Fake(Studio);

impl Painter for Fake {
    fn scene(&self) -> &Scene {
        self.0.scene()
    }
    fn camera(&self, index: usize, aspect: f64) -> Camera {
        self.0.camera(index, aspect)
    }
    fn draw(&self, request: &Request) -> Frame {
        let lens = Lens::new(&request.camera, &Picture { dots: request.dots, dot_aspect: request.dot_aspect });
        let per = request.glyphs.dots_per_cell();
        let cells = Size::new(request.dots.width / per.width, request.dots.height / per.height);
        let cells = Grid::from_fn(cells, |i, j| {
            let ray = lens.ray(f64::from(i * per.width), f64::from(j * per.height));
            let level = ((ray.d.x + 2.0 * ray.d.z + 3.0 * ray.d.y) * 6.0).rem_euclid(5.0) as usize;
            Cell { glyph: [' ', '░', '▒', '▓', '█'][level], ink: Paint::LightGray, paper: Paint::Black }
        });
        Frame { cells, ..self.0.draw(request) }
    }
}
