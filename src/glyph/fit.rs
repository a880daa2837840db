//! Best fit: of all a cell can show, what the eye can tell least from the light of its dots.
//!
//! The eye is a Gaussian filter, so an error e over the dots of a cell, in L*, is seen with the squared
//! strength `eᵀ K e`, where K is the overlap of the filters of each two dots. That one form weighs
//! everything: K's largest eigenvector is the cell's mean, the next are its slopes, and fine detail, which
//! the filter hides, counts least. No other weight is needed; `docs/13-grays.md` has what was tried.
//!
//! What a cell can show is a fixed table of candidates c, so `eᵀ K e = lᵀ K l − 2 (K c)ᵀ l + cᵀ K c` costs
//! one product of eight dots for each: `lᵀ K l` is the same for all, and the rest is known beforehand.

use super::cell::Cell;
use super::choice::Palette;
use super::eye::{Dots, overlaps};
use super::paint::Paint;
use super::range::{LevelRange, dots_of, levels_around};
use super::shade::{Papers, Shades};
use super::shape::{DOT_COUNT, DOTS, GlyphShape};
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

/// A candidate.
struct Candidate {
    show: Show,
    /// The light of each dot.
    dots: Dots,
    needs: Needs,
}

/// Between which levels the dots in and around a cell have to reach for a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Needs {
    /// Its lightest part stands for this level at least.
    lightest: u8,
    /// Its darkest part stands for this level at most.
    darkest: u8,
}

/// Costs of [`LANES`] candidates, less the part that all share: `own − Σ pull · l`.
struct Lanes {
    own: [f32; LANES],
    pull: [[f32; LANES]; DOT_COUNT],
    /// Their [`Needs`], of the type of the costs, for one width of the machine's vectors.
    lightest: [f32; LANES],
    darkest: [f32; LANES],
}

/// The candidates of one set of shapes and colours.
pub struct BestFit {
    shades: Shades,
    shows: Vec<Show>,
    lanes: Vec<Lanes>,
}

impl BestFit {
    /// The 13 levels, and each of `shapes` in each two of the palette's colors, as far as there are papers.
    /// Of candidates that look the same the first stays: a level, then the first paper, ink and shape.
    pub fn new(shapes: &[GlyphShape], papers: Papers, palette: Palette) -> Self {
        let shades = Shades::new(palette, papers);
        let mut table: Vec<Candidate> = Vec::new();
        for level in Level::all() {
            let dots = [shades.light(level); DOT_COUNT];
            match table.iter_mut().find(|other| other.dots == dots) {
                // Levels grow: what stands for a lower one too is there for both.
                Some(other) => other.needs.darkest = level.get(),
                None => table.push(Candidate {
                    show: Show::Level(level),
                    dots,
                    needs: Needs { lightest: level.get(), darkest: level.get() },
                }),
            }
        }
        let inks = palette.inks();
        let has_paper = |paper: &&Paint| papers == Papers::All || !paper.is_bright();
        for &paper in inks.iter().filter(has_paper) {
            for &ink in &inks {
                for shape in shapes {
                    let cell = Cell { glyph: shape.glyph, ink, paper };
                    let lights = [palette.ink_light(cell), palette.paper_light(cell)];
                    let dots = shape.dots(lights[0], lights[1]);
                    if table.iter().all(|other| other.dots != dots) {
                        table.push(Candidate { show: Show::Edge(cell), dots, needs: needs(lights, &shades) });
                    }
                }
            }
        }
        assert!(table.len() <= BLOCKS_OF_LANES * LANES, "the sets of shapes and grays are fixed");
        let overlaps = overlaps();
        let lanes = table.chunks(LANES).map(|some| Lanes::new(some, &overlaps)).collect();
        Self { shades, shows: table.into_iter().map(|candidate| candidate.show).collect(), lanes }
    }

    /// The cells nearest to `light`, of [`DOTS`] to a cell.
    pub fn compose(&self, light: &Grid<f64>, tone: Tone) -> Grid<Cell> {
        let cells = Size::new(light.size().width / DOTS.width, light.size().height / DOTS.height);
        Grid::from_fn_in_parallel(cells, |column, row| {
            let mut dots = dots_of(light, column, row);
            for dot in &mut dots {
                // NaN counts as no light.
                *dot = tone.shown(*dot).max(0.0);
            }
            match self.nearest(&dots, || levels_around(light, column, row, tone)) {
                Show::Level(level) => self.shades.cell(level, column, row),
                Show::Edge(cell) => cell,
            }
        })
    }

    #[inline]
    fn nearest(&self, dots: &Dots, around: impl FnOnce() -> LevelRange) -> Show {
        // Even light is its level by definition, not by the least of rounded costs.
        if dots.iter().all(|dot| *dot == dots[0]) {
            return Show::Level(Level::nearest(dots[0]));
        }
        let around = around();
        let dots = lightness_in_single(*dots);
        let mut least = [f32::INFINITY; LANES];
        let mut costs = [[f32::INFINITY; LANES]; BLOCKS_OF_LANES];
        for (block, lanes) in self.lanes.iter().enumerate() {
            costs[block] = lanes.costs(&dots, around);
            for lane in 0..LANES {
                let cost = costs[block][lane];
                least[lane] = if cost < least[lane] { cost } else { least[lane] };
            }
        }
        let least = least.into_iter().fold(f32::INFINITY, f32::min);
        // Of equals the first. The levels of the dots themselves are always open, so the least is finite.
        let best = costs.as_flattened().iter().position(|&cost| cost == least).unwrap_or(0);
        self.shows.get(best).copied().unwrap_or(self.shows[0])
    }
}

/// For two grays side by side: each stands for the level nearest to it, and for those whose fields hold whole
/// cells of it.
fn needs(lights: [f64; 2], shades: &Shades) -> Needs {
    let stands_for = lights.map(|light| {
        let nearest = Level::nearest(light).get();
        let whole = Level::all().filter(|&level| shades.holds_whole(level, light)).map(Level::get);
        whole.fold((nearest, nearest), |(low, high), level| (low.min(level), high.max(level)))
    });
    Needs { lightest: stands_for[0].0.max(stands_for[1].0), darkest: stands_for[0].1.min(stands_for[1].1) }
}

impl Lanes {
    fn new(candidates: &[Candidate], overlaps: &[Dots; DOT_COUNT]) -> Self {
        // Lanes beyond the last candidate are never the least.
        let mut lanes = Self {
            own: [f32::INFINITY; LANES],
            pull: [[0.0; LANES]; DOT_COUNT],
            lightest: [0.0; LANES],
            darkest: [0.0; LANES],
        };
        for (lane, candidate) in candidates.iter().enumerate() {
            let dots = candidate.dots.map(lightness);
            let seen = overlaps.map(|row| row.iter().zip(dots).map(|(k, l)| k * l).sum::<f64>());
            lanes.own[lane] = seen.iter().zip(dots).map(|(s, l)| s * l).sum::<f64>() as f32;
            for (pull, seen) in lanes.pull.iter_mut().zip(seen) {
                pull[lane] = 2.0 * seen as f32;
            }
            lanes.lightest[lane] = f32::from(candidate.needs.lightest);
            lanes.darkest[lane] = f32::from(candidate.needs.darkest);
        }
        lanes
    }

    /// Infinite for candidates that reach beyond the dots by more than a level.
    #[inline]
    fn costs(&self, lightness: &[f32; DOT_COUNT], around: LevelRange) -> [f32; LANES] {
        let mut costs = self.own;
        for dot in 0..DOT_COUNT {
            for lane in 0..LANES {
                costs[lane] -= self.pull[dot][lane] * lightness[dot];
            }
        }
        let (darkest, lightest) = (f32::from(around.darkest.get()), f32::from(around.lightest.get()));
        for lane in 0..LANES {
            let within = self.lightest[lane] <= lightest + 1.0 && self.darkest[lane] >= darkest - 1.0;
            costs[lane] = if within { costs[lane] } else { f32::INFINITY };
        }
        costs
    }
}

#[cfg(test)]
#[path = "fit_tests.rs"]
mod tests;
