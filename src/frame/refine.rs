//! Anti-aliasing by need: after one ray through the middle of each dot, those whose level is not decided get
//! more, until it is (Whitted 1980, section 4; Mitchell: Generating antialiased images at low sampling
//! densities, 1987; the paper's own future work).
//!
//! What one ray leaves open is guessed from the dots around: where rays of other histories pass, an edge may
//! run through the dot. [`super::edges`] says how much of the dot lies on either side, and how far off that
//! may be. Where all histories are the same, light is smooth, and off by what it bends.

use rayon::prelude::*;

use crate::integrate::{History, TileIntegrator};
use crate::lattice::FRUSTA;
use crate::math::{DVec3, Grid, PACKET};
use crate::shade::Channel;
use crate::stage::{Counts, Meter, Stopwatch};
use crate::tone::Level;
use crate::view::{EdgeModel, PointPacket, TILE, Tile, sample_point, tiles};

use super::accuracy::{Accuracy, LightRange};
use super::assemble::{PictureDots, RefinedDot};
use super::edges::{BESIDE, Expected, Knowledge, OpenDot, SeenByRay};
use super::render::TileRenderer;
use super::small::small_solids;
use super::workers::{PointScratch, Worker, Workers};

/// Rays of a dot after each round: twice as many each, so that a dot which is decided has had half as many at
/// least as it needed. None is decided by one: that an edge runs straight through its middle and past those
/// of the dots around is a guess, by which one dot in two thousand came to be two levels off. With 2 first a
/// few rays less are traced, for a few more wrong levels.
const ROUNDS: [u32; 7] = [4, 8, 16, 32, 64, 128, 256];

// After the first round an open dot is as much use to those beside it as it will ever be.
const _: () = assert!(ROUNDS[0] as usize >= BESIDE);

/// How far the mean of smooth light over a dot is from that of its middle, as a share of how far the middle
/// is off the line between two dots beside it: of a parabola a twenty-fourth of its second difference, from
/// each of two axes.
const BEND: f64 = 2.0 / 24.0;

/// The directions in which two dots lie on opposite sides of one.
const AXES: [[i32; 2]; 4] = [[1, 0], [0, 1], [1, 1], [1, -1]];

/// What is known of a picture after a ray through the middle of each dot.
pub(super) struct FirstRays<'a> {
    light: &'a Grid<f64>,
    color: Option<&'a Grid<DVec3>>,
    history: &'a Grid<History>,
    /// The dots in which there may be something that no ray has met.
    small: Grid<bool>,
}

impl<'a> FirstRays<'a> {
    /// Those of a picture whose histories are kept.
    pub fn of<I>(dots: &'a PictureDots, renderer: &TileRenderer<I>) -> Option<Self> {
        let history = dots.history.as_ref()?;
        let TileRenderer { assembly, pinhole, eye, .. } = renderer;
        let small = small_solids(assembly, pinhole, *eye, dots.light.size());
        Some(Self { light: &dots.light, color: dots.color.as_ref(), history, small })
    }

    /// The light of a dot, as far as it is there: its luminance, or its three primaries.
    fn light<C: Channel>(&self, at: (u32, u32)) -> C {
        C::from_rgb(self.color.map_or_else(|| DVec3::splat(self.light[at]), |color| color[at]))
    }

    /// What the ray through the middle of a dot saw.
    fn seen<C: Channel>(&self, at: (u32, u32)) -> SeenByRay<C> {
        SeenByRay { light: self.light(at), history: self.history[at] }
    }

    /// A dot with what may be in it, as far as the rays around tell; none where that decides it.
    #[inline]
    fn open_dot<C: Channel>(&self, column: u32, row: u32, accuracy: Accuracy) -> Option<OpenDot<C>> {
        let size = self.light.size();
        let [columns, rows] = [(column, size.width), (row, size.height)]
            .map(|(at, end)| at.saturating_sub(1)..(at + 2).min(end));
        let history = self.history[(column, row)];
        let is_smooth = rows.clone().all(|j| columns.clone().all(|i| self.history[(i, j)] == history));
        let own = self.light::<C>((column, row));
        let parts = accuracy.parts(own);
        let mut around = LightRange::of(parts);
        let is_inside = columns.len() == 3 && rows.len() == 3;
        // What the dots on opposite sides of this one see.
        let opposites = AXES.map(|[across, down]| {
            let beside = |sign: i32| {
                let (i, j) = (column.cast_signed() + sign * across, row.cast_signed() + sign * down);
                (i as u32, j as u32)
            };
            [beside(-1), beside(1)]
        });
        let possible = if is_smooth {
            for [before, behind] in opposites.into_iter().filter(|_| is_inside) {
                let [before, behind] = [before, behind].map(|at| accuracy.parts(self.light::<C>(at)));
                let bent = |k: usize| parts[k] + BEND * (before[k] + behind[k] - 2.0 * parts[k]);
                around.add(std::array::from_fn(bent));
            }
            around
        } else {
            for j in rows {
                for i in columns.clone() {
                    around.add(accuracy.parts(self.light::<C>((i, j))));
                }
            }
            // Between two edges it may be nearly all of what is seen on both sides; one takes half of it at
            // most.
            let differs = |at: (u32, u32)| self.history[at] != history;
            let is_between = is_inside && opposites.into_iter().any(|sides| sides.into_iter().all(differs));
            if is_between { around } else { around.halfway_to(parts) }
        };
        (self.small[(column, row)] || !accuracy.decides(&possible)).then(|| {
            // Room for the first round.
            let mut rays = Vec::with_capacity(ROUNDS[0] as usize);
            rays.push(SeenByRay { light: own, history });
            OpenDot { column, row, rays, around, is_own: true }
        })
    }
}

/// The dots of some tiles that one ray does not decide, and those beside them, which help to; those that are
/// near each other stand one after the other.
pub(super) fn open_dots<C: Channel>(first: &FirstRays, accuracy: Accuracy, own: &[Tile]) -> Vec<OpenDot<C>> {
    let size = first.light.size();
    let all = tiles(size);
    let mut is_own_tile = vec![false; all.len()];
    for tile in own {
        is_own_tile[tile.number as usize] = true;
    }
    let tiles_across = size.width.div_ceil(TILE);
    let is_own = |column: u32, row: u32| is_own_tile[(row / TILE * tiles_across + column / TILE) as usize];
    let is_beside_own = |column: u32, row: u32| {
        let [columns, rows] = [(column, size.width), (row, size.height)]
            .map(|(at, end)| [at.saturating_sub(1), (at + 1).min(end - 1)]);
        // Tiles are wider than the three dots: those in the corners are in all tiles that these touch.
        rows.iter().any(|&row| columns.iter().any(|&column| is_own(column, row)))
    };
    let is_gray = !accuracy.color || C::PARTS == 1;
    let level = |&light: &f64| Level::nearest(accuracy.tone.shown(light));
    let levels: Option<Vec<Level>> = is_gray.then(|| first.light.values().iter().map(level).collect());
    // Most dots stand among dots of their level: what their light is expected to be lies between theirs.
    let is_flat = |column: u32, row: u32| {
        let Some(levels) = &levels else { return false };
        let from = column.saturating_sub(1) as usize;
        let to = (column + 2).min(size.width) as usize;
        let own = levels[(row * size.width + column) as usize];
        (row.saturating_sub(1)..(row + 2).min(size.height)).all(|row| {
            let start = row as usize * size.width as usize;
            levels[start + from..start + to].iter().all(|level| *level == own)
        })
    };
    let of_tile = |tile: Tile| {
        let mut open = Vec::new();
        for (column, row) in tile.dots() {
            // Most dots are flat: that is asked first.
            if (first.small[(column, row)] || !is_flat(column, row)) && is_beside_own(column, row) {
                let is_own = is_own(column, row);
                open.extend(first.open_dot(column, row, accuracy).map(|dot| OpenDot { is_own, ..dot }));
            }
        }
        open.sort_unstable_by_key(|dot: &OpenDot<C>| tile.nearness((dot.column, dot.row)));
        open
    };
    all.into_par_iter().flat_map_iter(of_tile).collect()
}

/// Traces more rays through some dots until all are decided. `workers` has one trace with memory of its own.
pub(super) fn refine<C: Channel, I: TileIntegrator<C>>(
    first: &FirstRays,
    mut open: Vec<OpenDot<C>>,
    accuracy: Accuracy,
    renderer: &TileRenderer<I>,
    workers: &Workers<I::Memory, C>,
) -> (Vec<RefinedDot<C>>, Counts) {
    let model = EdgeModel::default();
    let mut numbers = Grid::filled(first.light.size(), 0);
    for (number, dot) in (1..).zip(&open) {
        numbers[(dot.column, dot.row)] = number;
    }
    let seen = |column, row| first.seen((column, row));
    let expected = |open: &[OpenDot<C>], number: u32| {
        let knowledge = Knowledge { model: &model, first: &seen, numbers: &numbers, open };
        knowledge.expected(&open[number as usize], accuracy)
    };
    let mut undecided: Vec<u32> = (0..open.len() as u32).collect();
    let mut refined = vec![None; open.len()];
    let mut counts = Counts::default();
    let mut had = 1;
    for rays in ROUNDS {
        let samples: Vec<_> = (had..rays).map(sample_point).collect();
        had = rays;
        // As many dots at a time as have their rays in the packets of one walk, but for what is left over.
        let at_once = (FRUSTA * PACKET).div_ceil(samples.len());
        let nothing = SeenByRay { light: C::DARK, history: History::MISS };
        let mut seen = vec![nothing; undecided.len() * samples.len()];
        let chunks = undecided.par_chunks(at_once).zip(seen.par_chunks_mut(at_once * samples.len()));
        let counted = chunks.map(|(numbers, seen)| {
            workers.with(renderer, |worker| {
                let dots = numbers.iter().map(|&number| &open[number as usize]);
                let middles = dots.map(|dot| [f64::from(dot.column) + 0.5, f64::from(dot.row) + 0.5]);
                trace_samples(middles, &samples, renderer, worker, seen)
            })
        });
        counts += counted.reduce(Counts::default, |a, b| a + b);
        for (number, seen) in undecided.iter().zip(seen.chunks(samples.len())) {
            open[*number as usize].rays.extend_from_slice(seen);
        }
        let decide = |&number: &u32| {
            let Expected { light, deviation, possible } = expected(&open, number);
            accuracy.is_met_by(accuracy.parts(light), deviation, &possible).then_some(light)
        };
        // Of those beside, no more rays than these count.
        undecided.retain(|&number| open[number as usize].is_own);
        let decided: Vec<Option<C>> = undecided.par_iter().map(decide).collect();
        let mut light = decided.into_iter();
        undecided.retain(|&number| {
            refined[number as usize] = light.next().flatten();
            refined[number as usize].is_none()
        });
    }
    let decided = (0..).zip(&open).zip(refined).filter(|((_, dot), _)| dot.is_own);
    let refined = decided.map(|((number, dot), light)| RefinedDot {
        column: dot.column,
        row: dot.row,
        light: light.unwrap_or_else(|| expected(&open, number).light),
    });
    (refined.collect(), counts)
}

/// Traces samples of some dots, given by their middles: all of each dot, one dot after the other.
fn trace_samples<C: Channel, I: TileIntegrator<C>>(
    middles: impl Iterator<Item = [f64; 2]>,
    samples: &[[f64; 2]],
    renderer: &TileRenderer<I>,
    worker: &mut Worker<I::Memory, C>,
    seen: &mut [SeenByRay<C>],
) -> Counts {
    let Worker { memory, refining: PointScratch { points, packets }, .. } = worker;
    let mut meter = Meter::new(Stopwatch::still());
    points.clear();
    for [x, y] in middles {
        points.extend(samples.iter().map(|[across, down]| [x + across, y + down]));
    }
    for (points, seen) in points.chunks(FRUSTA * PACKET).zip(seen.chunks_mut(FRUSTA * PACKET)) {
        packets.clear();
        packets.extend(points.chunks(PACKET).map(PointPacket::new));
        renderer.shade_points(packets, memory, seen, &mut meter);
    }
    meter.counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Size;
    use crate::tone::Tone;

    const ACCURACY: Accuracy = Accuracy { error: 1.0 / 16.0, tone: Tone::Lightness, color: false };

    /// Rays of two histories with an edge between columns 3 and 4.
    fn first_rays(light: &Grid<f64>, history: &Grid<History>) -> Vec<(u32, u32)> {
        let small = Grid::filled(light.size(), false);
        let first = FirstRays { light, color: None, history, small };
        open_dots::<f64>(&first, ACCURACY, &tiles(light.size()))
            .into_iter()
            .map(|dot| (dot.column, dot.row))
            .collect()
    }

    #[test]
    fn dots_beside_an_edge_are_open_and_no_others() {
        let size = Size::new(8, 3);
        let side = |dark: f64, bright: f64| {
            Grid::from_values(size, (0..24).map(|k| if k % 8 < 4 { dark } else { bright }).collect())
        };
        let face = |k: usize| if k % 8 < 4 { History::MISS } else { History::hit(0, 0, 0) };
        let history = Grid::from_values(size, (0..24).map(face).collect());
        let open = first_rays(&side(0.0, 1.0), &history);
        assert_eq!(open.len(), 6);
        assert!(open.iter().all(|&(column, _)| column == 3 || column == 4));
        // Where both sides are of one level, it makes no difference where the edge is.
        assert_eq!(first_rays(&side(0.4, 0.41), &history), []);
    }

    #[test]
    fn smooth_light_is_open_where_it_bends_near_a_border() {
        let size = Size::new(3, 3);
        let history = Grid::filled(size, History::hit(0, 0, 0));
        let columns = |lights: [f64; 3]| Grid::from_values(size, [lights; 3].concat());
        assert_eq!(first_rays(&columns([0.42, 0.47, 0.52]), &history), []);
        assert_eq!(first_rays(&columns([0.6, 0.47, 0.6]), &history), [(1, 1)]);
    }
}
