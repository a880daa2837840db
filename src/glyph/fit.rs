//! Best fit: of all a cell can show, what the eye can tell least from the light of its dots.
//!
//! The eye is a Gaussian filter, so an error e over the dots of a cell, in L*, is seen with the squared strength
//! `eᵀ K e`, where K is the overlap of the filters of each two dots. That one form weighs everything: K's largest
//! eigenvector is the cell's mean, the next are its slopes, and fine detail, which the filter hides, counts least.
//! No other weight is needed; `docs/13-grays.md` has what was tried.
//!
//! What a cell can show is a fixed table of candidates c, so `eᵀ K e = lᵀ K l − 2 (K c)ᵀ l + cᵀ K c` costs one
//! product of eight dots for each: `lᵀ K l` is the same for all, and the rest is known beforehand.

use super::cell::Cell;
use super::choice::Palette;
use super::eye::{Dots, overlaps};
use super::paint::Paint;
use super::shade::{shade, shade_light};
use super::shape::{DOT_COUNT, DOTS, Shape};
use crate::math::{Grid, Size};
use crate::tone::{Level, Tone, lightness, lightness_in_single};

/// Candidates whose costs are computed side by side. Sums go along the dots, so that they are the same at any
/// width of the machine's vectors.
const LANES: usize = 8;

/// Room for the candidates of the largest set: 13 levels and 9 partings in 4 × 3 pairs of grays.
const BLOCKS_OF_LANES: usize = 16;

/// What a candidate puts into the cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Show {
    Level(Level),
    Edge(Cell),
}

/// Costs of [`LANES`] candidates, less the part that all share: `own − Σ pull · l`.
struct Lanes {
    own: [f32; LANES],
    pull: [[f32; LANES]; DOT_COUNT],
}

/// The candidates of one set of shapes and colours.
pub struct BestFit {
    palette: Palette,
    shows: Vec<Show>,
    lanes: Vec<Lanes>,
}

impl BestFit {
    /// The 13 levels, and each of `shapes` in each ink of the palette on each of `papers`. Of candidates that look
    /// the same the first stays: a level, then the first paper, ink and shape.
    pub fn new(shapes: &[Shape], papers: &[Paint], palette: Palette) -> Self {
        let mut table: Vec<(Show, Dots)> = Vec::new();
        for level in Level::all() {
            let dots = [shade_light(level, palette); DOT_COUNT];
            if table.iter().all(|(_, other)| *other != dots) {
                table.push((Show::Level(level), dots));
            }
        }
        for &paper in papers {
            for &ink in palette.inks() {
                for shape in shapes {
                    let cell = Cell { glyph: shape.glyph, ink, paper };
                    let dots = shape.dots(cell.ink_light(), cell.paper_light());
                    if table.iter().all(|(_, other)| *other != dots) {
                        table.push((Show::Edge(cell), dots));
                    }
                }
            }
        }
        assert!(table.len() <= BLOCKS_OF_LANES * LANES, "the sets of shapes and grays are fixed");
        let overlaps = overlaps();
        let lanes = table.chunks(LANES).map(|some| Lanes::new(some, &overlaps)).collect();
        Self { palette, shows: table.into_iter().map(|(show, _)| show).collect(), lanes }
    }

    /// The cells nearest to `light`, of [`DOTS`] to a cell.
    pub fn compose(&self, light: &Grid<f64>, tone: Tone) -> Grid<Cell> {
        let cells = Size::new(light.size().width / DOTS.width, light.size().height / DOTS.height);
        Grid::from_fn_in_parallel(cells, |column, row| {
            let dots: Dots = std::array::from_fn(|dot| {
                let (x, y) = (dot as u32 % DOTS.width, dot as u32 / DOTS.width);
                tone.shown(light[(column * DOTS.width + x, row * DOTS.height + y)])
            });
            match self.nearest(&dots) {
                Show::Level(level) => shade(level, self.palette, column, row),
                Show::Edge(cell) => cell,
            }
        })
    }

    fn nearest(&self, dots: &Dots) -> Show {
        // Even light is its level by definition, not by the least of rounded costs.
        if dots.iter().all(|dot| *dot == dots[0]) {
            return Show::Level(Level::nearest(dots[0]));
        }
        let dots = lightness_in_single(*dots);
        let mut least = [f32::INFINITY; LANES];
        let mut costs = [[f32::INFINITY; LANES]; BLOCKS_OF_LANES];
        for (costs, lanes) in costs.iter_mut().zip(&self.lanes) {
            *costs = lanes.costs(&dots);
            for (least, &cost) in least.iter_mut().zip(&*costs) {
                *least = if cost < *least { cost } else { *least };
            }
        }
        let least = least.into_iter().fold(f32::INFINITY, f32::min);
        // Of equals the first. NaN, which no stage gives, is nowhere the least.
        let best = costs.as_flattened().iter().position(|&cost| cost == least).unwrap_or(0);
        self.shows.get(best).copied().unwrap_or(self.shows[0])
    }
}

impl Lanes {
    fn new(candidates: &[(Show, Dots)], overlaps: &[Dots; DOT_COUNT]) -> Self {
        // Lanes beyond the last candidate are never the least.
        let mut lanes = Self { own: [f32::INFINITY; LANES], pull: [[0.0; LANES]; DOT_COUNT] };
        for (lane, (_, dots)) in candidates.iter().enumerate() {
            let dots = dots.map(lightness);
            let seen = overlaps.map(|row| row.iter().zip(dots).map(|(k, l)| k * l).sum::<f64>());
            lanes.own[lane] = seen.iter().zip(dots).map(|(s, l)| s * l).sum::<f64>() as f32;
            for (pull, seen) in lanes.pull.iter_mut().zip(seen) {
                pull[lane] = 2.0 * seen as f32;
            }
        }
        lanes
    }

    fn costs(&self, lightness: &[f32; DOT_COUNT]) -> [f32; LANES] {
        let mut costs = self.own;
        for (pull, lightness) in self.pull.iter().zip(lightness) {
            for (cost, pull) in costs.iter_mut().zip(pull) {
                *cost -= pull * lightness;
            }
        }
        costs
    }
}

#[cfg(test)]
#[path = "fit_tests.rs"]
mod tests;
