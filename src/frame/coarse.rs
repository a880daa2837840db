//! Pictures of fewer and larger dots: for an eye that moves, where a ray for each dot takes too long.

use std::sync::Arc;
use std::time::Instant;

use crate::math::{Grid, Size};
use crate::scene::{Camera, FieldSpan};
use crate::stage::Stage;
use crate::view::{Picture, PinholeCamera};

use super::draw::composed;
use super::{Frame, Request, Wants};

impl Request {
    /// The request of a picture of the same view whose dots are `factor` times as wide and as high, 1 or
    /// more. Where these do not come out even, they reach as far beyond each edge as beyond the opposite
    /// one, and the middle of the picture stays where it is: nothing jumps when the finer picture follows.
    #[must_use]
    pub fn coarser(&self, factor: u32) -> Self {
        let dots = fewer(self.dots, factor);
        let pinhole = self.pinhole();
        let wider = |fewer: u32, dots: u32| f64::from(fewer) * f64::from(factor) / f64::from(dots.max(1));
        let angle = |tangent: f64| 2.0 * libm::atan(tangent).to_degrees();
        let field = [
            angle(pinhole.tangents[0] * wider(dots.width, self.dots.width)),
            angle(pinhole.tangents[1] * wider(dots.height, self.dots.height)),
        ];
        let camera = Camera { field, span: FieldSpan::Edges, zoom: 1.0, ..self.camera.clone() };
        Self { camera, dots, wants: Wants::LIGHT, ..self.clone() }
    }

    fn pinhole(&self) -> PinholeCamera {
        PinholeCamera::new(&self.camera, &Picture { dots: self.dots, dot_aspect: self.dot_aspect })
    }
}

impl Frame {
    /// The picture of [`Request::coarser`] as one of the dots of `request`, each with the light of the larger
    /// dot that its middle lies in, and with its characters, if they are wanted.
    #[must_use]
    pub fn enlarged(self, request: &Request, factor: u32) -> Self {
        let begin = Instant::now();
        let light = enlarged(&self.light, request.dots, factor);
        let color = self.color.map(|color| enlarged(&color, request.dots, factor));
        let cells = request.wants.cells.then(|| Arc::new(composed(&light, color.as_ref(), request)));
        let mut times = self.times;
        times[Stage::Dither] = begin.elapsed();
        Self {
            light: Arc::new(light),
            color: color.map(Arc::new),
            depth: None,
            normal: None,
            object: None,
            cells,
            times,
            field: request.pinhole().field(),
            total: self.total + begin.elapsed(),
            ..self
        }
    }
}

/// Enough dots of `factor` times the size to cover all.
fn fewer(dots: Size, factor: u32) -> Size {
    Size::new(dots.width.div_ceil(factor), dots.height.div_ceil(factor))
}

fn enlarged<T: Copy + Send + Sync>(coarse: &Grid<T>, dots: Size, factor: u32) -> Grid<T> {
    let of = |place: u32, coarse: u32, dots: u32| {
        // In halves of a dot, from the edge of the coarse picture.
        let beyond = u64::from(coarse) * u64::from(factor) - u64::from(dots);
        ((2 * u64::from(place) + 1 + beyond) / (2 * u64::from(factor))) as u32
    };
    let few = coarse.size();
    Grid::from_fn_in_parallel(dots, |x, y| {
        coarse[(of(x, few.width, dots.width), of(y, few.height, dots.height))]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Studio;
    use crate::glyph::{GlyphMode, Palette};
    use crate::plan::Options;
    use crate::scene::{self, ReadOptions};
    use crate::tone::Tone;

    fn request(studio: &Studio, dots: Size) -> Request {
        Request {
            camera: studio.camera(0, 1.5),
            dots,
            dot_aspect: 0.8,
            options: Options { threads: 1, ..Options::default() },
            wants: Wants::CELLS,
            glyphs: GlyphMode::Blocks,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        }
    }

    #[test]
    fn a_larger_dot_is_as_large_as_those_that_it_stands_for() {
        let studio =
            Studio::new(scene::read("ball", b"sphere(1);", &ReadOptions::default()).unwrap()).unwrap();
        // Even, and with a rest of each kind.
        for dots in [Size::new(24, 12), Size::new(23, 13), Size::new(22, 14), Size::new(1, 1)] {
            let request = request(&studio, dots);
            let pinhole = request.pinhole();
            for factor in 1..=8 {
                let coarse = request.coarser(factor);
                let larger = coarse.pinhole();
                assert!(
                    coarse.dots.width * factor >= dots.width && coarse.dots.height * factor >= dots.height
                );
                // A dot is as wide and as high as `factor` others: tangents are rounded a few times.
                let [few, many] = [coarse.dots, dots].map(|dots| [dots.width, dots.height].map(f64::from));
                for axis in 0..2 {
                    let [one, other] =
                        [larger.tangents[axis] / few[axis], pinhole.tangents[axis] / many[axis]];
                    let other = f64::from(factor) * other;
                    assert!((one - other).abs() < 1e-14 * other, "{dots:?} / {factor}: {one} {other}");
                }
                assert_eq!([larger.forward, larger.right], [pinhole.forward, pinhole.right]);
            }
        }
    }

    #[test]
    fn larger_dots_lie_evenly_about_the_middle() {
        let coarse = Grid::from_values(Size::new(3, 1), vec![0, 1, 2]);
        assert_eq!(enlarged(&coarse, Size::new(6, 2), 2).values(), [[0, 0, 1, 1, 2, 2]; 2].concat());
        // Three of four make twelve, one more at each end than ten.
        assert_eq!(enlarged(&coarse, Size::new(10, 1), 4).values(), [0, 0, 0, 1, 1, 1, 1, 2, 2, 2]);
        assert_eq!(enlarged(&coarse, Size::new(11, 1), 4).values().len(), 11);
    }

    #[test]
    fn an_enlarged_picture_has_all_that_is_shown() {
        let studio =
            Studio::new(scene::read("ball", b"sphere(1);", &ReadOptions::default()).unwrap()).unwrap();
        let request = request(&studio, Size::new(24, 16));
        let frame = studio.draw(&request.coarser(4)).enlarged(&request, 4);
        assert_eq!(frame.light.size(), request.dots);
        assert_eq!(frame.cells.as_ref().unwrap().size(), Size::new(12, 4));
        assert_eq!(frame.counts.primary_rays, 24);
        assert_eq!(frame.field, studio.draw(&request).field);
        // By 1 it is the picture.
        let same = studio.draw(&request.coarser(1)).enlarged(&request, 1);
        assert_eq!(same.cells.unwrap(), studio.draw(&request).cells.unwrap());
    }
}
