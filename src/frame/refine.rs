//! Anti-aliasing by need: after one ray through the middle of each dot, those whose level is not decided get
//! more, until it is (Whitted 1980, section 4; Mitchell: Generating antialiased images at low sampling
//! densities, 1987; the paper's own future work).
//!
//! What one ray leaves open is guessed from the dots around: where rays of other histories pass, an edge may
//! run through the dot, and its light may be off by what the two sides differ by, times what the rays so far
//! err on edges ([`edge_error`]). Where all histories are the same, light is smooth, and off by what it
//! bends.

use std::ops::Range;

use rayon::prelude::*;

use crate::integrate::{History, TileIntegrator};
use crate::lattice::FRUSTA;
use crate::math::{DVec3, Grid, PACKET};
use crate::shade::Channel;
use crate::stage::{Counts, Meter, Stopwatch};
use crate::tone::{Level, Tone};
use crate::view::{PointPacket, Tile, edge_error, missed_edge_error, sample_point, tiles};

use super::assemble::{PictureDots, RefinedDot};
use super::render::TileRenderer;
use super::small::small_solids;
use super::workers::{PointScratch, Worker, Workers};

/// Rays of a dot after each round: twice as many each, so that a dot which is decided has had half as many at
/// least as it needed.
const ROUNDS: [u32; 7] = [4, 8, 16, 32, 64, 128, 256];

/// So many standard deviations its mean is taken to be off at most. With 1.5 a dot that is called decided has
/// another level in one case of fifteen at the border; of 1, 1.5 and 2 it takes the fewest rays for as many
/// wrong levels as 16 rays for each dot leave (`benches/antialiasing.rs`, on hanyang, temple, glass and SPD
/// tree).
const DEVIATIONS: f64 = 1.5;

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

/// When a dot is decided.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accuracy {
    /// The error that is small enough, as a share of a level, above 0.
    pub error: f64,
    pub tone: Tone,
    /// Whether the three primaries count, and not only the luminance.
    pub color: bool,
}

/// A dot whose level is not decided by one ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenDot<C> {
    column: u32,
    row: u32,
    /// The light of its rays so far.
    sum: C,
    rays: u32,
    /// What its rays have seen.
    own: LightRange,
    /// What its rays and those of the dots around it have seen, as far as it may be in the dot.
    around: LightRange,
}

/// The least and the most light that may be in a dot, by part.
#[derive(Clone, Copy, Debug)]
struct LightRange {
    least: [f64; 3],
    most: [f64; 3],
}

impl Accuracy {
    /// The numbers of a light that count: those past the last are 0.
    fn parts<C: Channel>(self, light: C) -> [f64; 3] {
        if self.color && C::PARTS > 1 { light.rgb().to_array() } else { [light.gray(), 0.0, 0.0] }
    }

    /// Whether the light of a dot, somewhere between these, stays in one level, or so near that it does not
    /// matter.
    fn decides(self, between: &LightRange) -> bool {
        between.least.into_iter().zip(between.most).all(|(least, most)| {
            let [least, most] = [least, most].map(|light| self.tone.shown(light));
            Level::nearest(least) == Level::nearest(most)
                || Level::position(most) - Level::position(least) <= 2.0 * self.error
        })
    }
}

impl LightRange {
    #[inline]
    fn of(parts: [f64; 3]) -> Self {
        Self { least: parts, most: parts }
    }

    #[inline]
    fn add(&mut self, parts: [f64; 3]) {
        for part in 0..3 {
            self.least[part] = self.least[part].min(parts[part]);
            self.most[part] = self.most[part].max(parts[part]);
        }
    }

    /// From each end half of the way to a light between them.
    fn halfway_to(&self, light: [f64; 3]) -> Self {
        let half = |end: [f64; 3]| std::array::from_fn(|part| f64::midpoint(end[part], light[part]));
        Self { least: half(self.least), most: half(self.most) }
    }

    /// How far it is from the least to the most.
    fn width(&self, part: usize) -> f64 {
        self.most[part] - self.least[part]
    }
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
        let dot = OpenDot { column, row, sum: own, rays: 1, own: LightRange::of(parts), around };
        (self.small[(column, row)] || !accuracy.decides(&possible)).then_some(dot)
    }
}

impl<C: Channel> OpenDot<C> {
    fn mean(&self) -> C {
        self.sum * (1.0 / f64::from(self.rays))
    }

    /// Adds the light of further rays.
    fn add(&mut self, lights: &[C], accuracy: Accuracy) {
        for light in lights {
            self.sum = self.sum + *light;
            self.own.add(accuracy.parts(*light));
        }
        self.rays += lights.len() as u32;
    }

    fn is_decided(&self, accuracy: Accuracy) -> bool {
        let mean = accuracy.parts(self.mean());
        let [seen, missed] =
            [edge_error(self.rays), missed_edge_error(self.rays)].map(|error| DEVIATIONS * error);
        let off: [f64; 3] =
            std::array::from_fn(|part| (self.own.width(part) * seen).max(self.around.width(part) * missed));
        let mut possible = self.around;
        possible.add(self.own.least);
        possible.add(self.own.most);
        let between = |sign: f64| {
            let end = |part: usize| mean[part] + sign * off[part];
            std::array::from_fn(|part| end(part).clamp(possible.least[part], possible.most[part]))
        };
        accuracy.decides(&LightRange { least: between(-1.0), most: between(1.0) })
    }
}

/// The dots of a picture that one ray does not decide, those that are near each other one after the other.
pub(super) fn open_dots<C: Channel>(first: &FirstRays, accuracy: Accuracy) -> Vec<OpenDot<C>> {
    let tiles = tiles(first.light.size());
    let of_tile = |tile: Tile| {
        let dots = tile.dots_by_nearness();
        dots.filter_map(|(column, row)| first.open_dot(column, row, accuracy)).collect::<Vec<_>>()
    };
    tiles.into_par_iter().flat_map_iter(of_tile).collect()
}

/// Traces more rays through some dots until all are decided. `workers` has one trace with memory of its own.
pub(super) fn refine<C: Channel, I: TileIntegrator<C>>(
    mut open: Vec<OpenDot<C>>,
    accuracy: Accuracy,
    renderer: &TileRenderer<I>,
    workers: &Workers<I::Memory, C>,
) -> (Vec<RefinedDot<C>>, Counts) {
    let mut refined = Vec::new();
    let mut counts = Counts::default();
    let mut had = 1;
    for rays in ROUNDS {
        // As many dots at a time as have their rays in the packets of one walk, but for what is left over.
        let at_once = (FRUSTA * PACKET).div_ceil((rays - had) as usize);
        let chunks = open.par_chunks_mut(at_once);
        let counted = chunks.map(|some| {
            workers.with(renderer, |worker| {
                let mut meter = Meter::new(Stopwatch::still());
                add_samples(some, had..rays, accuracy, renderer, worker, &mut meter);
                meter.counts
            })
        });
        counts += counted.reduce(Counts::default, |a, b| a + b);
        had = rays;
        let is_last = rays == ROUNDS[ROUNDS.len() - 1];
        open.retain(|dot| {
            let is_done = is_last || dot.is_decided(accuracy);
            if is_done {
                refined.push(RefinedDot { column: dot.column, row: dot.row, light: dot.mean() });
            }
            !is_done
        });
    }
    (refined, counts)
}

/// Adds the samples of these numbers to some dots.
fn add_samples<C: Channel, I: TileIntegrator<C>>(
    dots: &mut [OpenDot<C>],
    numbers: Range<u32>,
    accuracy: Accuracy,
    renderer: &TileRenderer<I>,
    worker: &mut Worker<I::Memory, C>,
    meter: &mut Meter<Stopwatch>,
) {
    let Worker { memory, refining: PointScratch { points, packets, light }, .. } = worker;
    let samples: Vec<_> = numbers.map(sample_point).collect();
    points.clear();
    for dot in &*dots {
        let (x, y) = (f64::from(dot.column) + 0.5, f64::from(dot.row) + 0.5);
        points.extend(samples.iter().map(|[across, down]| [x + across, y + down]));
    }
    light.clear();
    light.resize(points.len(), C::DARK);
    for (points, light) in points.chunks(FRUSTA * PACKET).zip(light.chunks_mut(FRUSTA * PACKET)) {
        packets.clear();
        packets.extend(points.chunks(PACKET).map(PointPacket::new));
        renderer.shade_points(packets, memory, light, meter);
    }
    for (dot, lights) in dots.iter_mut().zip(light.chunks(samples.len())) {
        dot.add(lights, accuracy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Size;

    const ACCURACY: Accuracy = Accuracy { error: 1.0 / 16.0, tone: Tone::Lightness, color: false };

    fn between(least: f64, most: f64) -> LightRange {
        LightRange { least: [least, 0.0, 0.0], most: [most, 0.0, 0.0] }
    }

    #[test]
    fn a_level_is_decided_between_its_borders_and_nearly_on_them() {
        let level = Level::new(8).unwrap().light();
        assert!(ACCURACY.decides(&between(level - 0.03, level + 0.03)));
        // Its border with level 9 is at 0.4728.
        assert!(!ACCURACY.decides(&between(level, 0.49)));
        assert!(ACCURACY.decides(&between(0.4725, 0.4731)));
        // White may be as bright as it likes.
        assert!(ACCURACY.decides(&between(0.95, 1e300)));
    }

    /// Rays of two histories with an edge between columns 3 and 4.
    fn first_rays(light: &Grid<f64>, history: &Grid<History>) -> Vec<(u32, u32)> {
        let small = Grid::filled(light.size(), false);
        let first = FirstRays { light, color: None, history, small };
        open_dots::<f64>(&first, ACCURACY).into_iter().map(|dot| (dot.column, dot.row)).collect()
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
