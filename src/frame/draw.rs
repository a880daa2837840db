//! One picture, through all stages: prepared, rendered tile by tile, and assembled.

use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::glyph::{self, Cell};
use crate::integrate::TileIntegrator;
use crate::math::{DVec3, Grid};
use crate::plan::{Channels, Options};
use crate::shade::Channel;
use crate::stage::{Counts, GiveUp, Progress, Stage, StageTimes, Stopwatch, Task};
use crate::view::{TILE, Tile, TileShare, tiles};

use super::accuracy::Accuracy;
use super::assemble::PictureDots;
use super::frame_cache::Hits;
use super::prepare::{Prepared, Work};
use super::refine::{FirstRays, open_dots, refine};
use super::render::TileRenderer;
use super::reuse::Reused;
use super::workers::{Worker, Workers};
use super::{Frame, NothingInView, Request, Space, Studio, Wants};

/// One tile in this many is timed stage by stage: reading the clock at every change of stage costs about as
/// much as the stage.
const TIMED: u32 = 13;

/// How many columns farther left the timed tiles of the next row stand: whatever the width of a picture, they
/// are as many in each column, and no two are near each other.
const TIMED_SHIFT: u32 = 5;

/// Whether a tile is timed. The first is.
fn is_timed(tile: &Tile) -> bool {
    let [column, row] = tile.corner.map(|corner| corner / TILE);
    (column + TIMED_SHIFT * row).is_multiple_of(TIMED)
}

impl Studio {
    /// Draws one picture. The same request gives the same dots and cells, on any number of threads.
    ///
    /// The studio keeps the last picture, and shares its grids with the frame that it gave. Where a request
    /// differs from it in nothing that dots depend on, no ray is traced: only characters are made anew, and
    /// these only where glyphs, palette or tone have changed. Such a frame counts nothing and gives no time
    /// to the stages it left out.
    ///
    /// Where requests differ in light and not in view, which is camera, dots and their aspect, the second
    /// picture keeps what its rays through the middles of dots met, and those after it take that over. Such a
    /// frame counts of these only the few rays from the eye that are traced again, where surfaces lie in one
    /// place and their materials decide. What is kept takes 21 bytes a dot of the blocks of 8 × 8 that see
    /// anything, and is forgotten with the view. The exact engine traces all rays.
    pub fn draw(&self, request: &Request) -> Frame {
        self.finished(request, self.start(request), &GiveUp::never())
    }

    /// The same, unless it is given up before all of it is drawn, which is asked for each tile, each of a
    /// dot's rays and each round of refinement. Then nothing comes of it, and the studio keeps no picture.
    /// What is built once, as the boxes, is built all the same.
    pub fn draw_unless(&self, request: &Request, give_up: &GiveUp) -> Option<Frame> {
        whole(self.finished(request, self.start(request), give_up), give_up)
    }

    /// The picture with all rays traced, whatever was drawn before: to measure it.
    pub fn draw_anew(&self, request: &Request) -> Frame {
        self.finished(request, Start::anew(), &GiveUp::never())
    }

    /// The same, unless it is given up, as [`Studio::draw_unless`] has it.
    pub fn draw_anew_unless(&self, request: &Request, give_up: &GiveUp) -> Option<Frame> {
        whole(self.finished(request, Start::anew(), give_up), give_up)
    }

    /// The same with other samples of each dot than the first squares of
    /// [`Options::samples`](crate::plan::Options): those of these numbers
    /// ([`sample_point`](crate::view::sample_point)), of which there is one at least. Two pictures of samples
    /// that none shares show how far each is off. These are all that a dot gets, also where the options ask
    /// for as many as it needs. Nothing of it is kept.
    pub fn draw_samples(&self, request: &Request, samples: Range<u32>) -> Frame {
        self.sampled(request, samples, &GiveUp::never())
    }

    /// The same, unless it is given up, as [`Studio::draw_unless`] has it.
    pub fn draw_samples_unless(
        &self,
        request: &Request,
        samples: Range<u32>,
        give_up: &GiveUp,
    ) -> Option<Frame> {
        whole(self.sampled(request, samples, give_up), give_up)
    }

    /// One share of a picture, which other machines draw the rest of: the dots of its tiles are those of the
    /// whole picture, and what stands in the others is of no use. Where dots get as many rays as they need,
    /// the first ray of each dot is traced for every share, since what is beside a dot says how many that is;
    /// so long as these are the smaller part, the rest is what is shared. There are no characters, and
    /// nothing of it is kept.
    pub fn draw_share(&self, request: &Request, share: TileShare) -> Frame {
        let start = Instant::now();
        let workers = self.workers(request.options.threads);
        let part = Portion { share, ..Portion::ALL };
        let frame = by(workers.as_deref(), || self.traced(request, None, part, &GiveUp::never()));
        // What others see is not known here.
        Frame { nothing: None, total: start.elapsed(), ..frame }
    }

    /// With what serves of the last picture.
    fn start(&self, request: &Request) -> Start {
        Start { at: Instant::now(), reused: self.reused(request) }
    }

    fn sampled(&self, request: &Request, samples: Range<u32>, give_up: &GiveUp) -> Frame {
        let start = Instant::now();
        let workers = self.workers(request.options.threads);
        // Refinement would go on from the first of the samples, and past the last.
        let options = Options { adaptive: None, ..request.options };
        let request = &Request { options, ..request.clone() };
        let frame = by(workers.as_deref(), || {
            let portion = Portion { samples: Some(samples), ..Portion::ALL };
            with_cells(self.traced(request, None, portion, give_up), request)
        });
        Frame { total: start.elapsed(), ..frame }
    }

    /// A picture of which some of the grids may be there already. One that was given up is not kept.
    fn finished(&self, request: &Request, start: Start, give_up: &GiveUp) -> Frame {
        let Start { reused: Reused { frame, hits }, at: start } = start;
        let workers = match &frame {
            Some(frame) if !frame.lacks_cells(request) => None,
            _ => self.workers(request.options.threads),
        };
        let mut frame = by(workers.as_deref(), || {
            let frame = frame.unwrap_or_else(|| self.traced(request, hits.as_ref(), Portion::ALL, give_up));
            if give_up.was_due() { frame } else { with_cells(frame, request) }
        });
        frame.total = start.elapsed();
        if !give_up.was_due() {
            self.keep(request, &frame, hits);
        }
        frame.only(request)
    }

    /// The dots of a picture, without characters: prepared, rendered tile by tile, and assembled. Where it is
    /// given up, some of them are any.
    fn traced(&self, request: &Request, hits: Option<&Hits>, portion: Portion, give_up: &GiveUp) -> Frame {
        let mut prepared = self.prepare(request, hits, give_up);
        if let Some(samples) = portion.samples {
            prepared.samples = samples;
        }
        let tracing = Instant::now();
        let mut dots = PictureDots::new(request, self.given_up());
        let accuracy = (prepared.plan.adaptive).map(|error| {
            let color = request.wants_color();
            Accuracy { error, tone: request.tone, color }
        });
        let Portion { share, .. } = portion;
        let work =
            Shared { dots: &mut dots, wants: request.wants, share, accuracy, progress: &self.progress };
        let (counts, sampled) = match prepared.plan.channels {
            Channels::Gray => prepared.work::<f64, _>(work),
            Channels::Three => prepared.work::<DVec3, _>(work),
        };
        let trace = tracing.elapsed();
        let Prepared { plan, pinhole, structure, over_budget, times: prepared, .. } = prepared;
        let mut times = shared_out(&sampled, trace);
        for stage in [Stage::Lattice, Stage::View] {
            times[stage] = prepared[stage];
        }
        Frame {
            light: Arc::new(dots.light),
            color: dots.color.map(Arc::new),
            depth: dots.depth.map(Arc::new),
            normal: dots.normal.map(Arc::new),
            object: dots.object.map(Arc::new),
            cells: None,
            nothing: (counts.primary_hits == 0).then(|| NothingInView::cause(&self.assembly, &pinhole)),
            counts,
            times,
            objects: self.assembly.objects.len(),
            primitives: self.assembly.primitives.len(),
            space: Space::of(&structure),
            engine: plan.engine,
            precision: plan.precision,
            over_budget,
            field: pinhole.field(),
            threads: rayon::current_num_threads(),
            trace,
            total: Duration::ZERO,
        }
    }
}

/// What a picture begins with.
struct Start {
    at: Instant,
    reused: Reused,
}

impl Start {
    /// With nothing.
    fn anew() -> Self {
        Self { at: Instant::now(), reused: Reused::default() }
    }
}

/// A picture, if all of it is drawn.
fn whole(frame: Frame, give_up: &GiveUp) -> Option<Frame> {
    (!give_up.was_due()).then_some(frame)
}

/// What is drawn of a picture.
struct Portion {
    /// The numbers of the samples of each dot, where these are not those of the plan.
    samples: Option<Range<u32>>,
    share: TileShare,
}

impl Portion {
    const ALL: Self = Self { samples: None, share: TileShare::ALL };
}

/// The dots of a picture, of which one share is drawn.
struct Shared<'a> {
    dots: &'a mut PictureDots,
    wants: Wants,
    share: TileShare,
    /// How exact dots are to be, where they get as many rays as that needs.
    accuracy: Option<Accuracy>,
    progress: &'a Progress,
}

impl<C: Channel> Work<C> for Shared<'_> {
    /// What was counted, and the times of the tiles that were timed.
    type Done = (Counts, StageTimes);

    fn by<I: TileIntegrator<C>>(self, renderer: &TileRenderer<I>) -> Self::Done {
        let Self { dots, wants, share, accuracy, progress } = self;
        if accuracy.is_some() {
            dots.keep_histories();
        }
        let picture = dots.assembly();
        let workers = Workers::new(wants, accuracy.is_some());
        let own = share.tiles(picture.size());
        let all = accuracy.map(|_| tiles(picture.size()));
        // Which dots need more rays, those around them say.
        let drawn = all.as_ref().unwrap_or(&own);
        progress.begin(Task::Tracing, drawn.len() as u64);
        let drawn = drawn.par_iter().map(|tile| {
            let watch = if is_timed(tile) { Stopwatch::start(Stage::Ray) } else { Stopwatch::still() };
            workers.with(renderer, |Worker { memory, finished, .. }| {
                if !renderer.render(tile, watch, memory, finished) {
                    return Self::Done::default();
                }
                picture.take(finished);
                progress.advance(1);
                (finished.counts, finished.times)
            })
        });
        let mut all = drawn.reduce(Default::default, |mut all: Self::Done, one| {
            all.0 += one.0;
            all.1 += one.1;
            all
        });
        let accuracy = accuracy.filter(|_| !renderer.give_up.is_due());
        if let (Some(accuracy), Some(first)) = (accuracy, FirstRays::of(dots, renderer)) {
            let open = open_dots(&first, accuracy, &own);
            let (refined, counts) = refine(&first, open, accuracy, renderer, &workers);
            all.0 += counts;
            dots.set(&refined);
        }
        workers.give_back(renderer);
        all
    }
}

/// Has work done by workers, or else by the caller's thread.
fn by<T: Send>(workers: Option<&rayon::ThreadPool>, work: impl FnOnce() -> T + Send) -> T {
    match workers {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// A picture with its characters, if they are wanted.
fn with_cells(mut frame: Frame, request: &Request) -> Frame {
    if frame.lacks_cells(request) {
        let dithering = Instant::now();
        frame.cells = Some(Arc::new(composed(&frame.light, frame.color.as_deref(), request)));
        frame.times[Stage::Dither] = dithering.elapsed();
    }
    frame
}

/// The characters of a picture.
pub(super) fn composed(light: &Grid<f64>, color: Option<&Grid<DVec3>>, request: &Request) -> Grid<Cell> {
    glyph::compose_dots(light, color, request.glyphs, request.palette, request.tone)
}

/// Shares the time of tracing out among the stages as the timed tiles spent theirs.
pub(super) fn shared_out(sampled: &StageTimes, trace: Duration) -> StageTimes {
    let mut times = StageTimes::default();
    let all = sampled.total().as_secs_f64();
    if all > 0.0 {
        for stage in Stage::ALL {
            times[stage] = trace.mul_f64(sampled[stage].as_secs_f64() / all);
        }
    }
    times
}
