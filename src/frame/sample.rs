//! A small part of a picture, traced to see what the whole will cost.
//!
//! What a ray costs differs by a factor of a thousand from scene to scene, and no count of objects foretells it. So blocks of
//! dots that are spread over the picture are traced and timed, by the engine that will draw it, on the machine that will draw
//! it: a few milliseconds of the very work that is asked about.

use std::time::{Duration, Instant};

use crate::lattice::Structure;
use crate::math::{DVec3, Grid, Size};
use crate::plan::{Channels, Plan, Sample};
use crate::shade::Channel;
use crate::stage::{Meter, Silent, Stage, Stopwatch};
use crate::view::{Lens, Tile};

use super::draw::{Viewed, Work, composed, shared_out};
use super::gather::TileDots;
use super::points::Tracer;
use super::{Request, Studio, Wants};

/// Dots along each side of a block: those of one packet of rays, so that as many different places as can be are seen.
const SIDE: u32 = 8;

/// One block in this many is traced, as long as there are more than `FEW` of them, and at most `MOST`.
const ONE_IN: usize = 8;
const FEW: usize = 24;
const MOST: usize = 64;

/// No further block is begun after so many rays of all kinds: where many are sent on, each dot is much work. Counted, not
/// timed, so that the same picture has the same sample on every machine. A third of it was four times off on `glass`, whose few
/// glass dots are most of the work.
const RAYS: u64 = 24_576;

/// Nor is one after so much time of the blocks alone: of a plate with a thousand holes a single ray takes 90 µs. Scenes that
/// people draw by hand are far from it.
const ENOUGH: Duration = Duration::from_millis(30);

/// So many blocks are traced all the same.
const LEAST: usize = 12;

/// After its stages have been timed, each block is timed so often without them, since to read the clock takes as long as a
/// short stage. The least time is taken: whatever else a machine does only adds to it. One that takes `LONG` at least is timed
/// once more: twice in a row the machine is seldom busy elsewhere for much longer than that.
const TIMES: usize = 3;
const LONG: Duration = Duration::from_micros(200);

/// Cells that are composed by one thread: fewer than rayon would share out.
const CELLS: usize = 512;

impl Studio {
    /// Traces a sample of a picture that was planned.
    pub(super) fn sample(
        &self,
        request: &Request,
        (lens, plan): (&Lens, &Plan),
        structure: Structure,
    ) -> Sample {
        let view = Viewed { studio: self, plan, lens, hits: None };
        match plan.channels {
            Channels::Gray => view.work::<f64, _>(structure, Sampling(request)),
            Channels::Three => view.work::<DVec3, _>(structure, Sampling(request)),
        }
    }
}

/// The sample of a request.
struct Sampling<'a>(&'a Request);

impl<C: Channel> Work<C> for Sampling<'_> {
    type Done = Sample;

    fn by<T: Tracer<C>>(self, tracer: &T) -> Sample {
        let Self(request) = self;
        let mut memory = tracer.memory();
        let mut dots = TileDots::new(Wants::LIGHT);
        let mut light = Vec::new();
        let mut sample = Sample::default();
        for (number, block) in blocks(request.dots).into_iter().enumerate() {
            let counts = &sample.counts;
            let rays = counts.rays();
            if number >= LEAST && (rays >= RAYS || sample.times.total() > ENOUGH) {
                break;
            }
            dots.fit(&block);
            let mut meter = Meter::new(Stopwatch::start(Stage::Ray));
            tracer.tile(&block, &mut memory, &mut dots, &mut meter);
            let shares = meter.probe.stop();
            sample.counts += meter.counts;
            let mut least = shares.total();
            for again in 0..TIMES {
                if again > 0 && least > LONG {
                    break;
                }
                let start = Instant::now();
                tracer.tile(&block, &mut memory, &mut dots, &mut Meter::new(Silent));
                least = least.min(start.elapsed());
            }
            sample.times += shared_out(&shares, least);
            sample.dots += block.size.area();
            if block.size == Size::new(SIDE, SIDE) {
                light.extend_from_slice(&dots.light);
            }
        }
        tracer.give_back(memory);
        sample.composing = request.wants.cells.then(|| composing(&light, request));
        sample
    }
}

/// What a dot of the sample takes to become characters, in nanoseconds.
fn composing<C: Channel>(light: &[C], request: &Request) -> f64 {
    let per_cell = request.glyphs.dots_per_cell().area();
    let rows =
        (light.len() / SIDE as usize).min(CELLS * per_cell / SIDE as usize) / SIDE as usize * SIDE as usize;
    if rows == 0 {
        return 0.0;
    }
    let size = Size::new(SIDE, rows as u32);
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

/// Blocks of a picture, spread over it so evenly that any first few of them are, too: by the fractional parts of multiples of
/// the plastic number's powers (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
fn blocks(dots: Size) -> Vec<Tile> {
    const STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];
    let (columns, rows) = (dots.width.div_ceil(SIDE), dots.height.div_ceil(SIDE));
    let all = columns as usize * rows as usize;
    let block = |column: u32, row: u32| {
        let corner = [column * SIDE, row * SIDE];
        let size = Size::new(SIDE.min(dots.width - corner[0]), SIDE.min(dots.height - corner[1]));
        Tile { number: 0, corner, size }
    };
    if all <= FEW {
        return (0..rows).flat_map(|row| (0..columns).map(move |column| block(column, row))).collect();
    }
    let place = |k: usize, step: f64, of: u32| {
        let along = (0.5 + k as f64 * step).fract();
        ((along * f64::from(of)) as u32).min(of - 1)
    };
    let some = (all / ONE_IN).clamp(FEW, MOST);
    (0..some).map(|k| block(place(k, STEP[0], columns), place(k, STEP[1], rows))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each quarter of the picture has its share of the sample, and of its first half.
    #[test]
    fn blocks_are_spread_over_the_picture() {
        for dots in [Size::new(160, 100), Size::new(400, 180), Size::new(641, 399), Size::new(3000, 40)] {
            let blocks = blocks(dots);
            assert!((FEW..=MOST).contains(&blocks.len()));
            for some in [&blocks[..], &blocks[..blocks.len() / 2]] {
                let mut quarters = [0; 4];
                for block in some {
                    let [x, y] = block.corner;
                    assert!(x < dots.width && y < dots.height && block.size.area() > 0);
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
        let dots = Size::new(33, 20);
        assert_eq!(blocks(dots).iter().map(|block| block.size.area()).sum::<usize>(), dots.area());
    }
}
