//! Figures put together, and what is inside of outlines that cross: by Clipper's sweep, on whole numbers.

use std::collections::HashMap;

use clipper2_rust::{
    ClipType, Clipper64, ClipperOffset, EndType, FillRule, JoinType, Path64, Paths64, Point64, PolyTree64,
    union_subjects_64,
};

use super::figure::{Figure, FigureOperator, Region};
use crate::math::DVec2;

/// Coordinates are whole multiples of a unit, at most this many: products of two of them, with sums of four
/// such, are far from the end of 128 bits, and a quarter of the bits of 64 is left for offsets to grow into.
const MOST_UNITS: i32 = 44;

/// More pairs of sides that are beside each other are not looked at.
const MOST_PAIRS: usize = 60_000_000;

/// More crossings than this an outline may not have.
const MOST_CROSSINGS: usize = 100_000;

/// Outlines cross each other too often, or are too dense, to be sorted out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tangled;

/// How the corners of a figure are joined that was made larger or smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Join {
    /// By an arc, which is cut into sides that are off it by no more than this.
    Round(f64),
    /// By the sides themselves, until they meet.
    Sharp,
    /// By a side across.
    Chamfered,
}

/// How a line ends that is drawn with a width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineEnd {
    /// Where the line does.
    Flat,
    /// Half its width later.
    Square,
    /// In half a circle.
    Round,
}

/// The grid on which a sweep computes, and the places that its points came from.
struct Grid {
    unit: f64,
    places: HashMap<[i64; 2], DVec2>,
}

impl Grid {
    /// A grid for coordinates up to `reach`.
    fn new(reach: f64) -> Self {
        let exponent = if reach > 0.0 { libm::ilogb(reach).clamp(-900, 1022) } else { 0 };
        Self { unit: libm::ldexp(1.0, exponent + 1 - MOST_UNITS), places: HashMap::new() }
    }

    fn of(figures: &[&Figure], margin: f64) -> Self {
        let corners = figures.iter().flat_map(|figure| figure.corners());
        Self::new(corners.map(|p| p.abs().max_element()).fold(0.0, f64::max) + margin)
    }

    fn inward(&mut self, ring: &[DVec2]) -> Path64 {
        let point = |&place: &DVec2| {
            let [x, y] = (place / self.unit).round().to_array().map(|x| x as i64);
            self.places.entry([x, y]).or_insert(place);
            Point64::new(x, y)
        };
        ring.iter().map(point).collect()
    }

    fn paths(&mut self, figure: &Figure) -> Paths64 {
        figure.rings().map(|ring| self.inward(ring)).collect()
    }

    /// A path in its own coordinates; corners that came from there get the very place back.
    fn outward(&self, path: &Path64, error: &mut f64) -> Vec<DVec2> {
        let place = |point: &Point64| {
            self.places.get(&[point.x, point.y]).copied().unwrap_or_else(|| {
                // A crossing is rounded to the grid, and so were the ends of the sides that cross.
                *error = 2.0 * self.unit;
                DVec2::new(point.x as f64, point.y as f64) * self.unit
            })
        };
        path.iter().map(place).collect()
    }

    fn figure(&self, tree: &PolyTree64) -> Figure {
        let mut figure = Figure::default();
        // By node: how deep it is, and the region of an outer one. Parents stand before their children.
        let mut depths = vec![0_usize; tree.nodes.len()];
        let mut regions = vec![usize::MAX; tree.nodes.len()];
        let mut open = vec![0];
        while let Some(index) = open.pop() {
            for &child in tree.nodes[index].children().iter().rev() {
                depths[child] = depths[index] + 1;
                open.push(child);
            }
            let path = tree.nodes[index].polygon();
            if depths[index] % 2 == 1 {
                regions[index] = figure.regions.len();
                let outer = self.outward(path, &mut figure.error);
                figure.regions.push(Region { outer, holes: Vec::new() });
            } else if let Some(parent) = tree.nodes[index].parent() {
                let hole = self.outward(path, &mut figure.error);
                figure.regions[regions[parent]].holes.push(hole);
            }
        }
        figure
    }

    fn clipped(&self, clip_type: ClipType, rule: FillRule, subjects: &Paths64, clips: &Paths64) -> Figure {
        let mut sweep = Clipper64::new();
        sweep.add_subject(subjects);
        sweep.add_clip(clips);
        let mut tree = PolyTree64::new();
        sweep.execute_tree(clip_type, rule, &mut tree, &mut Paths64::new());
        self.figure(&tree)
    }
}

/// What is inside of paths by OpenSCAD's rule: where an odd number of them lie around. `error` is how far
/// their corners may be off their places.
pub fn filled(paths: &[Vec<DVec2>], error: f64) -> Result<Figure, Tangled> {
    inside(paths, FillRule::EvenOdd, error)
}

/// What is inside of paths by the rule of letters: where they go round more often one way than the other.
pub fn wound(paths: &[Vec<DVec2>], error: f64) -> Result<Figure, Tangled> {
    inside(paths, FillRule::NonZero, error)
}

fn inside(paths: &[Vec<DVec2>], rule: FillRule, error: f64) -> Result<Figure, Tangled> {
    if is_tangled(paths.iter()) {
        return Err(Tangled);
    }
    let mut grid = Grid::new(paths.iter().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max));
    let subjects: Paths64 = paths.iter().map(|path| grid.inward(path)).collect();
    let figure = grid.clipped(ClipType::Union, rule, &subjects, &Paths64::new());
    Ok(Figure { error: figure.error + error, ..figure })
}

/// Figures put together.
pub fn combined(operator: FigureOperator, figures: &[Figure]) -> Result<Figure, Tangled> {
    let [first, others @ ..] = figures else { return Ok(Figure::default()) };
    if others.is_empty() {
        return Ok(first.clone());
    }
    if is_tangled(figures.iter().flat_map(Figure::rings)) {
        return Err(Tangled);
    }
    let mut grid = Grid::of(&figures.iter().collect::<Vec<_>>(), 0.0);
    let error = figures.iter().map(|figure| figure.error).fold(0.0, f64::max);
    let mut paths: Vec<Paths64> = figures.iter().map(|figure| grid.paths(figure)).collect();
    let none = Paths64::new();
    let figure = match operator {
        FigureOperator::Union => grid.clipped(ClipType::Union, FillRule::NonZero, &paths.concat(), &none),
        FigureOperator::Difference => {
            let first = paths.remove(0);
            grid.clipped(ClipType::Difference, FillRule::NonZero, &first, &paths.concat())
        }
        FigureOperator::Intersection => {
            let mut figure = grid.clipped(ClipType::Intersection, FillRule::NonZero, &paths[0], &paths[1]);
            for next in &paths[2..] {
                let met = grid.paths(&figure);
                let error = figure.error;
                figure = grid.clipped(ClipType::Intersection, FillRule::NonZero, &met, next);
                figure.error = figure.error.max(error);
            }
            figure
        }
    };
    Ok(Figure { error: figure.error + error, ..figure })
}

/// What is inside of any of some convex outlines that go round either way.
pub fn covered(outlines: &[Vec<DVec2>]) -> Figure {
    let mut grid = Grid::new(outlines.iter().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max));
    let paths: Paths64 = outlines
        .iter()
        .map(|outline| {
            let turned: f64 = (1..outline.len().saturating_sub(1))
                .map(|i| (outline[i] - outline[0]).perp_dot(outline[i + 1] - outline[0]))
                .sum();
            let mut path = grid.inward(outline);
            if turned < 0.0 {
                path.reverse();
            }
            path
        })
        .collect();
    // Few at a time, then the sums of few: a sweep over all at once would meet every crossing of every pair.
    let mut layers: Vec<Paths64> =
        paths.chunks(32).map(|few| union_subjects_64(&few.to_vec(), FillRule::NonZero)).collect();
    while layers.len() > 8 {
        layers = layers.chunks(8).map(|few| union_subjects_64(&few.concat(), FillRule::NonZero)).collect();
    }
    grid.clipped(ClipType::Union, FillRule::NonZero, &layers.concat(), &Paths64::new())
}

/// The figure made larger by `by`, or smaller where that is below 0.
pub fn grown(figure: &Figure, by: f64, join: Join) -> Figure {
    // A sharp corner goes as far as this many times the offset.
    const MITER: f64 = 1e6;
    let reach = match join {
        // Beyond the reach of all corners nothing is kept of a spike; the grid need not be that coarse.
        Join::Sharp => 64.0,
        Join::Round(_) | Join::Chamfered => 2.0,
    };
    let mut grid = Grid::of(&[figure], by.abs() * reach);
    let paths = grid.paths(figure);
    let (kind, tolerance) = match join {
        Join::Round(tolerance) => (JoinType::Round, tolerance / grid.unit),
        Join::Sharp => (JoinType::Miter, 0.0),
        Join::Chamfered => (JoinType::Square, 0.0),
    };
    let mut offset = ClipperOffset::new(MITER, tolerance, false, false);
    offset.add_paths(&paths, kind, EndType::Polygon);
    let mut tree = PolyTree64::new();
    offset.execute_tree(by / grid.unit, &mut tree);
    let grown = grid.figure(&tree);
    Figure { error: grown.error + figure.error, ..grown }
}

/// The outlines of a line as wide as `width`, as OpenSCAD draws those of an SVG file: corners are sharp up to
/// twice half the width.
pub fn stroked(line: &[DVec2], width: f64, end: LineEnd) -> Result<Vec<Vec<DVec2>>, Tangled> {
    // Round ends are off circles by a quarter of OpenSCAD's unit, a ten-thousandth; but a circle has no more
    // than a thousand sides.
    const OFF: f64 = 0.25e-4;
    let line = line.to_vec();
    if is_tangled(std::iter::once(&line)) {
        return Err(Tangled);
    }
    let half = 0.5 * width;
    let off = OFF.max(half * (1.0 - libm::cos(std::f64::consts::PI / 1000.0)));
    let mut grid = Grid::new(line.iter().map(|p| p.abs().max_element()).fold(2.0 * width, f64::max));
    let end = match end {
        LineEnd::Flat => EndType::Butt,
        LineEnd::Square => EndType::Square,
        LineEnd::Round => EndType::Round,
    };
    let mut offset = ClipperOffset::new(2.0, off / grid.unit, false, false);
    offset.add_path(&grid.inward(&line), JoinType::Miter, end);
    let mut tree = PolyTree64::new();
    offset.execute_tree(half / grid.unit, &mut tree);
    Ok(grid.figure(&tree).rings().cloned().collect())
}

/// Whether paths have too many crossings, or too many sides beside each other, for a sweep to look at each.
fn is_tangled<'p>(paths: impl Iterator<Item = &'p Vec<DVec2>>) -> bool {
    let sides: Vec<[DVec2; 2]> =
        paths.flat_map(|path| (0..path.len()).map(|i| [path[i], path[(i + 1) % path.len()]])).collect();
    if sides.len() < 500 {
        return false;
    }
    // The library's sweep goes along y, and keeps the sides that it passes in a list.
    let mut along_y: Vec<[DVec2; 2]> = sides.iter().map(|side| side.map(|p| DVec2::new(p.y, p.x))).collect();
    let mut along_x = sides;
    let (pairs_x, pairs_y) = (count_of_pairs(&mut along_x), count_of_pairs(&mut along_y));
    if pairs_y > MOST_PAIRS || pairs_x.min(pairs_y) > MOST_PAIRS {
        return true;
    }
    crossings(&if pairs_x < pairs_y { along_x } else { along_y }) > MOST_CROSSINGS
}

/// Where a side begins and ends along x.
fn ends([a, b]: &[DVec2; 2]) -> [f64; 2] {
    [a.x.min(b.x), a.x.max(b.x)]
}

/// Puts sides in the order of where they begin along x; gives how many pairs are beside each other there.
fn count_of_pairs(sides: &mut [[DVec2; 2]]) -> usize {
    sides.sort_by(|a, b| ends(a)[0].total_cmp(&ends(b)[0]));
    let mut last: Vec<f64> = sides.iter().map(|side| ends(side)[1]).collect();
    last.sort_by(f64::total_cmp);
    let ended = |x: f64| last.partition_point(|&end| end < x);
    sides.iter().enumerate().map(|(before, side)| before.saturating_sub(ended(ends(side)[0]))).sum()
}

/// How often sides, in the order of where they begin along x, cross; more than [`MOST_CROSSINGS`] are not
/// counted.
fn crossings(sides: &[[DVec2; 2]]) -> usize {
    let cuts =
        |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| (b - a).perp_dot(c - a) * (b - a).perp_dot(d - a) < 0.0;
    let (mut open, mut count) = (Vec::<[DVec2; 2]>::new(), 0);
    for &side in sides {
        open.retain(|other| ends(other)[1] >= ends(&side)[0]);
        count += open.iter().filter(|&&other| cuts(side, other) && cuts(other, side)).count();
        if count > MOST_CROSSINGS {
            break;
        }
        open.push(side);
    }
    count
}
