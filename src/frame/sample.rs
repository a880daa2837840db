//! A small part of a picture, traced to see what the whole will cost.
//!
//! What a ray costs differs by a factor of a thousand from scene to scene, and no count of objects foretells
//! it. So tiles that are spread over the picture are traced and timed, by the engine that will draw it, on
//! the machine that will draw it: a few milliseconds of the very work that is asked about. They are those of
//! the picture itself: a smaller block would pay alone for what a tile does once for all of its dots, such as
//! cutting a solid into slices.

use std::time::{Duration, Instant};

use crate::integrate::TileIntegrator;
use crate::math::{DVec3, Grid, Size};
use crate::plan::{Channels, Sample};
use crate::shade::Channel;
use crate::stage::{Stage, Stopwatch};
use crate::view::{PLASTIC, TILE, Tile, tiles};

use super::Request;
use super::draw::{composed, shared_out};
use super::finished_tile::FinishedTile;
use super::prepare::{Prepared, Work};
use super::render::TileRenderer;

/// One tile in this many is traced, as long as there are more than `FEW` of them, and at most `MOST`. A
/// picture of 80 × 25 cells of two dots by four has 20 tiles: all are traced, which takes as long as the
/// picture does on one thread.
const ONE_IN: usize = 3;
const FEW: usize = 20;
const MOST: usize = 32;

/// No further tile is begun after so many rays of all kinds: where many are sent on, each dot is much work.
/// Counted, not timed, so that the same picture has the same sample on every machine. It is what `FEW` tiles
/// of dots come to with three rays each: a third of it was four times off on `glass`, whose few glass dots
/// are most of the work.
const RAYS: u64 = FEW as u64 * 3 * (TILE * TILE) as u64;

/// Nor is one after so much time of the tiles alone: of a plate with a thousand holes a single ray takes 90
/// µs. Scenes that people draw by hand are far from it.
const ENOUGH: Duration = Duration::from_millis(100);

/// So many tiles are traced all the same: two for each quarter of the picture.
const LEAST: usize = 8;

/// After its stages have been timed, each tile is timed so often without them, since to read the clock takes
/// as long as a short stage. The least time is taken: whatever else a machine does only adds to it. One that
/// takes `LONG` at least is timed once more: twice in a row the machine is seldom busy elsewhere for much
/// longer than that.
const TIMES: usize = 3;
const LONG: Duration = Duration::from_micros(500);

/// Cells that are composed by one thread: fewer than rayon would share out.
const CELLS: usize = 512;

impl Prepared<'_> {
    /// Traces a sample of the picture that `request` asks for.
    pub(super) fn sample(&self, request: &Request) -> Sample {
        match self.plan.channels {
            Channels::Gray => self.work::<f64, _>(Sampling(request)),
            Channels::Three => self.work::<DVec3, _>(Sampling(request)),
        }
    }
}

/// The sample of a request.
struct Sampling<'a>(&'a Request);

impl<C: Channel> Work<C> for Sampling<'_> {
    type Done = Sample;

    fn by<I: TileIntegrator<C>>(self, renderer: &TileRenderer<I>) -> Sample {
        let Self(request) = self;
        let mut memory = renderer.memory();
        let mut dots = FinishedTile::new(request.wants);
        let mut light = Vec::new();
        let mut sample = Sample::default();
        for (number, tile) in some_tiles(request.dots).into_iter().enumerate() {
            let counts = &sample.counts;
            let rays = counts.rays();
            if number >= LEAST && (rays >= RAYS || sample.times.total() > ENOUGH) {
                break;
            }
            renderer.render(&tile, Stopwatch::start(Stage::Ray), &mut memory, &mut dots);
            let shares = dots.times;
            sample.counts += dots.counts;
            let mut least = shares.total();
            for again in 0..TIMES {
                if again > 0 && least > LONG {
                    break;
                }
                let start = Instant::now();
                renderer.render(&tile, Stopwatch::still(), &mut memory, &mut dots);
                least = least.min(start.elapsed());
            }
            sample.times += shared_out(&shares, least);
            sample.dots += tile.size.area();
            if tile.size == Size::new(TILE, TILE) {
                light.extend_from_slice(&dots.light);
            }
        }
        renderer.give_back(memory);
        sample.composing = request.wants.cells.then(|| composing(&light, request));
        sample
    }
}

/// What a dot of the sample takes to become characters, in nanoseconds.
fn composing<C: Channel>(light: &[C], request: &Request) -> f64 {
    let per_cell = request.glyphs.dots_per_cell().area();
    let side = TILE as usize;
    let rows = light.len().min(CELLS * per_cell) / (side * side) * side;
    if rows == 0 {
        return 0.0;
    }
    let size = Size::new(TILE, rows as u32);
    let light = &light[..size.area()];
    let gray = Grid::from_values(size, light.iter().map(|light| light.gray()).collect());
    let color = request
        .wants_color()
        .then(|| Grid::from_values(size, light.iter().map(|light| light.rgb()).collect::<Vec<DVec3>>()));
    let once = || {
        let start = Instant::now();
        std::hint::black_box(composed(&gray, color.as_ref(), request));
        start.elapsed()
    };
    let least = (0..TIMES).map(|_| once()).min().unwrap_or_default();
    least.as_secs_f64() * 1e9 / size.area() as f64
}

/// Tiles of a picture, spread over it so evenly that any first few of them are, too: by the fractional parts
/// of multiples of [`PLASTIC`]. None comes twice.
fn some_tiles(dots: Size) -> Vec<Tile> {
    let all = tiles(dots);
    let [columns, rows] = [dots.width, dots.height].map(|side| side.div_ceil(TILE) as usize);
    let place = |k: usize, step: f64, of: usize| {
        let along = (0.5 + k as f64 * step).fract();
        ((along * of as f64) as usize).min(of - 1)
    };
    let some = (all.len() / ONE_IN).clamp(FEW.min(all.len()), MOST);
    let mut taken = vec![false; all.len()];
    let spread = (0..).map(|k| place(k, PLASTIC[1], rows) * columns + place(k, PLASTIC[0], columns));
    let once = spread.filter(|&number| !std::mem::replace(&mut taken[number], true));
    once.take(some).map(|number| all[number]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each quarter of the picture has its share of the sample, and of its first half, as far as few tiles
    /// can be shared out: half of it at least, and a little more than twice it at most.
    #[test]
    fn tiles_are_spread_over_the_picture() {
        for dots in [Size::new(400, 180), Size::new(641, 399), Size::new(1920, 1080), Size::new(3000, 100)] {
            let tiles = some_tiles(dots);
            assert!((FEW..=MOST).contains(&tiles.len()));
            for some in [&tiles[..], &tiles[..tiles.len() / 2]] {
                let mut quarters = [0; 4];
                for tile in some {
                    let middle = |corner: u32, side: u32| corner + side / 2;
                    let x = middle(tile.corner[0], tile.size.width);
                    let y = middle(tile.corner[1], tile.size.height);
                    assert!(x < dots.width && y < dots.height && tile.size.area() > 0);
                    quarters[usize::from(2 * x >= dots.width) + 2 * usize::from(2 * y >= dots.height)] += 1;
                }
                let fair = some.len() / 4;
                assert!(
                    quarters.iter().all(|&n| 2 * n >= fair && n <= 2 * fair + 2),
                    "{dots:?} {quarters:?}"
                );
            }
        }
    }

    #[test]
    fn small_pictures_are_sampled_whole() {
        for dots in [Size::new(33, 20), Size::new(160, 100), Size::new(1, 1)] {
            assert_eq!(some_tiles(dots).iter().map(|tile| tile.size.area()).sum::<usize>(), dots.area());
        }
    }
}
