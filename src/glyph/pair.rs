//! Best fit where ink and paper may have any colour, or any of the 13 grays: which parting of the dots in
//! two, and which two colours.
//!
//! The measure is that of [`fit`](super::fit): an error e over the dots is seen with the squared strength
//! `eᵀ K e`, in each axis of L*a*b* alike. With the dots m in ink and n in paper, e = l − a m − b n, and the
//! best a and b of a parting are those of least squares: `mᵀKm a + mᵀKn b = mᵀKl` and
//! `mᵀKn a + nᵀKn b = nᵀKl`. Where there are levels, each of the two is then shown by the nearest: the pair
//! that is nearest as a whole would weave two levels over every surface that lies between them.

use super::cell::Cell;
use super::eye::{Dots, overlaps};
use super::grays::FourGrays;
use super::paint::Paint;
use super::range::{LevelRange, dots_of, levels_around};
use super::shape::{DOT_COUNT, DOTS, GlyphShape, HALVES};
use crate::math::{DVec3, Grid, Size};
use crate::tone::{Level, Tone, color_of_lab, labs_of_colors, lightness, lightnesses, srgb_of_light};

/// One way to part the dots.
#[derive(Clone, Copy, Debug)]
struct Parting {
    shape: GlyphShape,
    /// K m and K n.
    ink: Dots,
    paper: Dots,
    /// mᵀKm, mᵀKn and nᵀKn.
    inks: f64,
    mixed: f64,
    papers: f64,
}

/// The partings of one set of shapes.
pub struct PairFit {
    partings: Vec<Parting>,
}

impl Parting {
    fn new(shape: GlyphShape, overlaps: &[Dots; DOT_COUNT]) -> Self {
        let (m, n) = (shape.dots(1.0, 0.0), shape.dots(0.0, 1.0));
        let seen = |dots: Dots| overlaps.map(|row| dot(&row, &dots));
        let (ink, paper) = (seen(m), seen(n));
        Self { shape, ink, paper, inks: dot(&m, &ink), mixed: dot(&m, &paper), papers: dot(&n, &paper) }
    }

    /// mᵀKl and nᵀKl.
    fn pulls(&self, l: &Dots) -> [f64; 2] {
        [dot(&self.ink, l), dot(&self.paper, l)]
    }

    /// The best ink and paper where any value will do.
    fn best(&self, [p, q]: [f64; 2]) -> [f64; 2] {
        // K is positive definite and m and n share no dot, so this is above 0.
        let determinant = self.inks * self.papers - self.mixed * self.mixed;
        [(p * self.papers - q * self.mixed) / determinant, (q * self.inks - p * self.mixed) / determinant]
    }

    /// The error, less `lᵀKl`, which is the same for all.
    fn cost(&self, [a, b]: [f64; 2], [p, q]: [f64; 2]) -> f64 {
        a * (a * self.inks + 2.0 * (b * self.mixed - p)) + b * (b * self.papers - 2.0 * q)
    }
}

fn dot(a: &Dots, b: &Dots) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl PairFit {
    /// For these shapes; one of each two that are each other's complement will do.
    pub fn new(shapes: &[GlyphShape]) -> Self {
        let overlaps = overlaps();
        let mut partings: Vec<Parting> = Vec::new();
        for &shape in shapes {
            if partings.iter().all(|other| other.shape.mask != !shape.mask) {
                partings.push(Parting::new(shape, &overlaps));
            }
        }
        Self { partings }
    }

    /// The cells of two grays out of `grays` nearest to `light`, of [`DOTS`] to a cell.
    pub fn compose_grays(&self, light: &Grid<f64>, grays: &Grays, tone: Tone) -> Grid<Cell> {
        // NaN counts as no light.
        let shown = |light: f64| tone.shown(light).max(0.0);
        cells(light, |column, row| {
            let around = || levels_around(light, column, row, tone);
            self.two_grays(&dots_of(light, column, row).map(shown), grays, around)
        })
    }

    /// The cells of two colours nearest to `color`, of [`DOTS`] to a cell.
    pub fn compose_colors(&self, color: &Grid<DVec3>, tone: Tone) -> Grid<Cell> {
        let shown = |color: DVec3| tone.shown_color(color).max(DVec3::ZERO);
        cells(color, |column, row| self.two_colors(&dots_of(color, column, row).map(shown)))
    }

    fn two_grays(&self, dots: &Dots, grays: &Grays, around: impl FnOnce() -> LevelRange) -> Cell {
        if dots.iter().all(|dot| *dot == dots[0]) {
            return Cell::flat(grays.of_light(dots[0]));
        }
        let (shape, [[ink, paper]]) = self.best([lightnesses(*dots)]);
        // Least squares may reach beyond the dots, to make up for what the shape can not have.
        let within = around().lightness_to_a_level();
        let [ink, paper] = [ink, paper].map(|l| grays.nearest(l.clamp(within[0], within[1])));
        Cell::pair(shape, ink, paper)
    }

    fn two_colors(&self, dots: &[DVec3; DOT_COUNT]) -> Cell {
        if dots.iter().all(|dot| *dot == dots[0]) {
            return Cell::flat(paint(dots[0]));
        }
        let labs = labs_of_colors(*dots);
        let (shape, best) = self.best(labs);
        let least = labs.map(|axis| axis.into_iter().fold(f64::INFINITY, f64::min));
        let most = labs.map(|axis| axis.into_iter().fold(f64::NEG_INFINITY, f64::max));
        let [ink, paper] = [0, 1].map(|side| {
            // There are no levels here to go beyond the dots by.
            paint(color_of_lab(std::array::from_fn(|k| best[k][side].clamp(least[k], most[k]))))
        });
        Cell::pair(shape, ink, paper)
    }

    /// The parting of least error, with its ink and paper in each axis.
    fn best<const AXES: usize>(&self, axes: [Dots; AXES]) -> (GlyphShape, [[f64; 2]; AXES]) {
        let mut least = (f64::INFINITY, HALVES[0], [[0.0; 2]; AXES]);
        for parting in &self.partings {
            let pulls = axes.map(|axis| parting.pulls(&axis));
            let best = pulls.map(|pulls| parting.best(pulls));
            let cost = best.iter().zip(pulls).map(|(&best, pulls)| parting.cost(best, pulls)).sum();
            if cost < least.0 {
                least = (cost, parting.shape, best);
            }
        }
        (least.1, least.2)
    }
}

/// The colour as bytes.
pub fn paint(color: DVec3) -> Paint {
    Paint::Rgb(color.to_array().map(srgb_of_light))
}

/// A cell for each [`DOTS`] of a picture.
fn cells<T: Sync>(dots: &Grid<T>, cell: impl Fn(u32, u32) -> Cell + Sync) -> Grid<Cell> {
    let size = Size::new(dots.size().width / DOTS.width, dots.size().height / DOTS.height);
    Grid::from_fn_in_parallel(size, cell)
}

/// The grays that a pair may have, with their L*, from the darkest.
pub struct Grays(Vec<(f64, Paint)>);

impl Grays {
    /// The 13 levels.
    pub fn levels() -> Self {
        Self(Level::all().map(|level| (lightness(level.light()), Paint::of_level(level))).collect())
    }

    /// Those of a palette of four.
    pub fn four(grays: FourGrays) -> Self {
        Self(grays.lightnesses().into_iter().zip(grays.paints()).collect())
    }

    /// That of even light. Where there are all levels it is the light's level by definition, not by rounded
    /// lightness.
    fn of_light(&self, light: f64) -> Paint {
        let level = usize::from(Level::nearest(light).get());
        let all = self.0.len() > usize::from(Level::MAX.get());
        if all { self.0[level].1 } else { self.nearest(lightness(light)) }
    }

    /// The nearest to an L*.
    fn nearest(&self, lightness: f64) -> Paint {
        let above = self.0.partition_point(|gray| gray.0 < lightness).clamp(1, self.0.len() - 1);
        let (dark, bright) = (self.0[above - 1], self.0[above]);
        if lightness - dark.0 < bright.0 - lightness { dark.1 } else { bright.1 }
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::{BLOCKS, QUADRANTS, block_of};
    use super::*;
    use crate::tone::light_of_lightness;
    use proptest::prelude::*;

    /// Dots all around of every light.
    const ANY: LevelRange = LevelRange { darkest: Level::MIN, lightest: Level::MAX };

    #[test]
    fn complements_are_there_once() {
        for (shapes, count) in [(BLOCKS, 9), (HALVES, 2), (QUADRANTS, 7)] {
            assert_eq!(PairFit::new(shapes).partings.len(), count);
        }
    }

    #[test]
    fn two_grays_along_a_shape_are_that_shape() {
        let fit = PairFit::new(BLOCKS);
        let grays = Grays::levels();
        for shape in BLOCKS {
            for (dark, bright) in [(0, 1), (3, 7), (0, 12), (11, 12)] {
                let [dark, bright] = [dark, bright].map(|k: usize| grays.0[k]);
                let cell =
                    fit.two_grays(&shape.dots(bright.0, dark.0).map(light_of_lightness), &grays, || ANY);
                let inked = if cell.ink == bright.1 { shape.mask } else { !shape.mask };
                assert_eq!(block_of(inked), Some(cell.glyph), "{shape:?}");
            }
        }
    }

    #[test]
    fn two_colors_along_a_shape_are_that_shape() {
        let (red, blue) = (DVec3::new(0.8, 0.1, 0.1), DVec3::new(0.1, 0.1, 0.6));
        let cell = PairFit::new(BLOCKS).two_colors(&BLOCKS[0].dots(red, blue));
        assert_eq!(cell, Cell { glyph: '▀', ink: paint(red), paper: paint(blue) });
    }

    proptest! {
        /// The closed form against small changes of every parting's colours.
        #[test]
        fn no_other_pair_is_nearer(dots in prop::array::uniform8(0.0..=100.0)) {
            let fit = PairFit::new(BLOCKS);
            let overlaps = overlaps();
            let cost = |shown: &Dots| {
                let error: Dots = std::array::from_fn(|d| dots[d] - shown[d]);
                dot(&overlaps.map(|row| dot(&row, &error)), &error)
            };
            let (shape, [[ink, paper]]) = fit.best([dots]);
            let found = cost(&shape.dots(ink, paper));
            for parting in &fit.partings {
                let [ink, paper] = parting.best(parting.pulls(&dots));
                for (a, b) in [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, -1.0)] {
                    prop_assert!(found <= cost(&parting.shape.dots(ink + a, paper + b)) + 1e-6);
                }
            }
        }

        /// Two levels stand in a cell only where its dots lie on both sides of a border between levels.
        #[test]
        fn what_lies_within_a_level_is_flat(level in 1_usize..12, dots in prop::array::uniform8(-1.0..=1.0)) {
            let grays = Grays::levels();
            let here = grays.0[level].0;
            let reach = (here - grays.0[level - 1].0).min(grays.0[level + 1].0 - here);
            // Least squares may reach a little beyond the dots.
            let dots = dots.map(|away: f64| light_of_lightness(here + away * reach / 8.0));
            prop_assert_eq!(PairFit::new(BLOCKS).two_grays(&dots, &grays, || ANY), Cell::flat(grays.0[level].1));
        }

        #[test]
        fn gray_colors_are_as_light_as_their_dots(dots in prop::array::uniform8(20.0..=80.0)) {
            let colors = dots.map(|l: f64| DVec3::splat(light_of_lightness(l)));
            let cell = PairFit::new(BLOCKS).two_colors(&colors);
            for light in [cell.ink, cell.paper].map(|paint| paint.light().unwrap_or(f64::NAN)) {
                prop_assert!((0.0..=1.0).contains(&light));
            }
            let Paint::Rgb([r, g, b]) = cell.ink else { panic!("a colour") };
            prop_assert!(r == g && g == b);
        }
    }
}
