//! A picture of fewer rays than dots: where the rays at the corners of a square of dots have the same history,
//! light is smooth in between and is interpolated; elsewhere the dots between are traced, square within square
//! (Akimoto, Mase, Suenaga: Pixel-selected ray tracing, IEEE CG&A 1991).

use rayon::prelude::*;

use crate::integrate::{History, TileIntegrator};
use crate::lattice::FRUSTA;
use crate::math::{Grid, PACKET, Size};
use crate::shade::Channel;
use crate::stage::{Counts, Meter, Silent};
use crate::tone::{Level, Tone};
use crate::view::{PointPacket, Tile, tiles};

use super::render::TileRenderer;
use super::workers::{Worker, Workers};

/// The sides of squares in dots, each half of the one before: a smooth square of 16 dots takes one ray.
const SIDES: [u32; 2] = [4, 2];

/// So many levels the lights at the corners of a square may be apart at most: between the middle and an end
/// of twice as much a line and the arc of a highlight are still within half a level of each other.
const SMOOTH: f64 = 1.0;

/// A dot that has been traced.
#[derive(Clone, Copy, Debug)]
struct TracedDot<C> {
    light: C,
    history: History,
}

/// The dots of a picture, as far as they are traced.
struct TracedDots<C>(Grid<Option<TracedDot<C>>>);

/// A square between four dots, cut off at the rim of the picture.
#[derive(Clone, Copy, Debug)]
struct Square {
    left: u32,
    top: u32,
    /// The last column and row, at most a side from the first.
    right: u32,
    bottom: u32,
}

impl Square {
    /// The one with this upper left corner; none at the right and lower rim.
    fn at(left: u32, top: u32, side: u32, size: Size) -> Self {
        Self {
            left,
            top,
            right: (left + side).min(size.width - 1),
            bottom: (top + side).min(size.height - 1),
        }
    }

    fn corners(&self) -> [(u32, u32); 4] {
        let Self { left, top, right, bottom } = *self;
        [(left, top), (right, top), (left, bottom), (right, bottom)]
    }

    /// The corners of its four quarters.
    fn quarters(self, side: u32, size: Size) -> impl Iterator<Item = Square> {
        let half = side / 2;
        let starts = [(0, 0), (half, 0), (0, half), (half, half)];
        let inside = starts.into_iter().map(move |(i, j)| (self.left + i, self.top + j));
        inside
            .filter(move |&(i, j)| i <= self.right && j <= self.bottom)
            .map(move |(i, j)| Square::at(i, j, half, size))
    }

    fn dots(self) -> impl Iterator<Item = (u32, u32)> {
        (self.top..=self.bottom).flat_map(move |j| (self.left..=self.right).map(move |i| (i, j)))
    }
}

impl<C: Channel> TracedDots<C> {
    fn get(&self, at: (u32, u32)) -> TracedDot<C> {
        self.0[at].expect("the corners of a square are traced before it is asked about")
    }

    /// Whether light is smooth within a square, as far as its corners tell.
    fn is_smooth(&self, square: &Square, tone: Tone) -> bool {
        let corners = square.corners().map(|at| self.get(at));
        let position = |dot: TracedDot<C>| Level::position(tone.shown(dot.light.gray()));
        let positions = corners.map(position);
        let most = positions.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let least = positions.into_iter().fold(f64::INFINITY, f64::min);
        corners.iter().all(|dot| dot.history == corners[0].history) && most - least <= SMOOTH
    }

    /// The light of a dot of a smooth square, between those of its corners.
    fn between(&self, square: &Square, (column, row): (u32, u32)) -> C {
        let share = |at: u32, from: u32, to: u32| f64::from(at - from) / f64::from((to - from).max(1));
        let (x, y) = (share(column, square.left, square.right), share(row, square.top, square.bottom));
        let [a, b, c, d] = square.corners().map(|at| self.get(at).light);
        (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y
    }
}

/// The light of all dots, most of it interpolated, and what was counted.
pub(super) fn undersample<C: Channel, I: TileIntegrator<C>>(
    size: Size,
    tone: Tone,
    renderer: &TileRenderer<I>,
    workers: &Workers<I::Memory, C>,
) -> (Grid<C>, Counts) {
    let mut light = Grid::filled(size, C::DARK);
    let mut counts = Counts::default();
    if size.area() == 0 {
        return (light, counts);
    }
    let mut traced = TracedDots(Grid::filled(size, None));
    let mut squares = coarse_squares(size);
    for side in SIDES {
        let missing = corners_to_trace(&squares, &traced);
        counts += trace(&missing, &mut traced, renderer, workers);
        let (smooth, rest): (Vec<_>, Vec<_>) =
            squares.into_iter().partition(|square| traced.is_smooth(square, tone));
        for square in smooth {
            for dot in square.dots() {
                light[dot] = traced.between(&square, dot);
            }
        }
        squares = rest.into_iter().flat_map(|square| square.quarters(side, size)).collect();
    }
    let missing = corners_to_trace(&squares, &traced);
    counts += trace(&missing, &mut traced, renderer, workers);
    for (light, dot) in light.values_mut().iter_mut().zip(traced.0.values()) {
        if let Some(dot) = dot {
            *light = dot.light;
        }
    }
    (light, counts)
}

/// Squares of the largest side that hold every dot, those that are near each other one after the other.
fn coarse_squares(size: Size) -> Vec<Square> {
    let side = SIDES[0];
    let coarse = Size::new(size.width.div_ceil(side), size.height.div_ceil(side));
    let near = tiles(coarse).into_iter().flat_map(|tile: Tile| tile.dots_by_nearness());
    near.map(|(i, j)| Square::at(i * side, j * side, side, size)).collect()
}

/// The corners of squares that are not traced yet, each once.
fn corners_to_trace<C: Channel>(squares: &[Square], traced: &TracedDots<C>) -> Vec<(u32, u32)> {
    let mut asked = Grid::filled(traced.0.size(), false);
    let corners = squares.iter().flat_map(Square::corners);
    corners.filter(|&at| traced.0[at].is_none() && !std::mem::replace(&mut asked[at], true)).collect()
}

/// Traces rays through the middles of some dots.
fn trace<C: Channel, I: TileIntegrator<C>>(
    dots: &[(u32, u32)],
    traced: &mut TracedDots<C>,
    renderer: &TileRenderer<I>,
    workers: &Workers<I::Memory, C>,
) -> Counts {
    let found: Vec<(Counts, Vec<TracedDot<C>>)> = dots
        .par_chunks(FRUSTA * PACKET)
        .map(|some| workers.with(renderer, |worker| trace_some(some, renderer, worker)))
        .collect();
    let mut counts = Counts::default();
    for (some, (counted, dots)) in dots.chunks(FRUSTA * PACKET).zip(found) {
        counts += counted;
        for (&at, dot) in some.iter().zip(dots) {
            traced.0[at] = Some(dot);
        }
    }
    counts
}

fn trace_some<C: Channel, I: TileIntegrator<C>>(
    dots: &[(u32, u32)],
    renderer: &TileRenderer<I>,
    worker: &mut Worker<I::Memory, C>,
) -> (Counts, Vec<TracedDot<C>>) {
    let middles: Vec<_> = dots.iter().map(|&(i, j)| [f64::from(i) + 0.5, f64::from(j) + 0.5]).collect();
    let packets: Vec<_> = middles.chunks(PACKET).map(PointPacket::new).collect();
    let mut meter = Meter::new(Silent);
    let mut light = vec![C::DARK; dots.len()];
    let mut histories = vec![History::MISS; dots.len()];
    renderer.shade_points(&packets, &mut worker.memory, &mut light, Some(&mut histories), &mut meter);
    let both = light.into_iter().zip(histories);
    (meter.counts, both.map(|(light, history)| TracedDot { light, history }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_hold_every_dot_and_their_quarters_too() {
        for size in [Size::new(1, 1), Size::new(4, 4), Size::new(5, 9), Size::new(33, 2), Size::new(70, 41)] {
            let squares = coarse_squares(size);
            let quarters = || squares.iter().flat_map(|square| square.quarters(SIDES[0], size));
            let smallest: Vec<_> = quarters().flat_map(|square| square.quarters(SIDES[1], size)).collect();
            for squares in [squares.clone(), quarters().collect(), smallest] {
                let mut seen = Grid::filled(size, false);
                for square in squares {
                    square.dots().for_each(|dot| seen[dot] = true);
                    square.corners().into_iter().for_each(|dot| assert!(square.dots().any(|own| own == dot)));
                }
                assert!(seen.values().iter().all(|&seen| seen), "{size:?}");
            }
        }
    }
}
