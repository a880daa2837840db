//! A picture that is not all there yet: its first dots, row by row.

use std::sync::Arc;

use crate::math::{DVec3, Grid};

use super::draw::composed;
use super::{Frame, Request};

impl Frame {
    /// The picture of `request` as it is when so many of its dots have been drawn, from the left of the first
    /// row on; the others have no light.
    #[must_use]
    pub fn scanned(&self, request: &Request, dots: usize) -> Self {
        let light = begun(&self.light, dots, 0.0);
        let color = self.color.as_ref().map(|color| begun(color, dots, DVec3::ZERO));
        let cells = request.wants.cells.then(|| Arc::new(composed(&light, color.as_ref(), request)));
        Self { light: Arc::new(light), color: color.map(Arc::new), cells, ..self.clone() }
    }
}

fn begun<T: Copy + Send + Sync>(whole: &Grid<T>, dots: usize, dark: T) -> Grid<T> {
    let width = whole.size().width as usize;
    Grid::from_fn(
        whole.size(),
        |x, y| {
            if y as usize * width + (x as usize) < dots { whole[(x, y)] } else { dark }
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Studio, pcat};
    use crate::math::Size;
    use crate::scene::Scene;

    #[test]
    fn dots_come_row_by_row() {
        let studio = Studio::new(Scene::default()).unwrap();
        let request =
            Request { dots: Size::new(8, 8), dot_aspect: 1.0, ..pcat::request(studio.camera(0, 1.0)) };
        let white = Frame { light: Arc::new(Grid::filled(request.dots, 1.0)), ..studio.draw(&request) };
        for dots in [0, 1, 8, 13, 64, 99] {
            let scanned = white.scanned(&request, dots);
            let lit: Vec<bool> = scanned.light.values().iter().map(|&light| light > 0.0).collect();
            assert!(lit[..dots.min(64)].iter().all(|&lit| lit) && !lit[dots.min(64)..].contains(&true));
        }
        let cells = white.scanned(&request, 64).cells.unwrap();
        assert_eq!(*cells, glyph_of(&white, &request));
    }

    fn glyph_of(frame: &Frame, request: &Request) -> Grid<crate::glyph::Cell> {
        composed(&frame.light, None, request)
    }
}
