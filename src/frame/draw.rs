//! One picture, through all stages.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::glyph::{self, Cell, Palette};
use crate::lattice::Structure;
use crate::math::{Bounds, DVec3, Grid};
use crate::plan::{Channels, EngineChoice, Plan, Precision};
use crate::shade::{Channel, Shader, TileHits};
use crate::stage::{Counts, Meter, Progress, Stage, StageTimes, Task, Watch};
use crate::trace::{Exact, Fast};
use crate::view::{Picture, PinholeCamera, TILE, Tile, tiles};

use super::blocks::Blocks;
use super::frame_cache::{Hits, Reused};
use super::gather::{PictureDots, TileDots};
use super::points::{Points, Tracer};
use super::{Frame, NothingInView, Request, Space, Studio, Wants};

/// One tile in this many is timed stage by stage: reading the clock at every change of stage costs about as much
/// as the stage.
const TIMED: u32 = 13;

/// How many columns farther left the timed tiles of the next row stand: whatever the width of a picture, they are as many in
/// each column, and no two are near each other.
const TIMED_SHIFT: u32 = 5;

/// Whether a tile is timed. The first is.
fn is_timed(tile: &Tile) -> bool {
    let [column, row] = tile.corner.map(|corner| corner / TILE);
    (column + TIMED_SHIFT * row).is_multiple_of(TIMED)
}

impl Studio {
    /// Draws one picture. The same request gives the same dots and cells, on any number of threads.
    ///
    /// The studio keeps the last picture, and shares its grids with the frame that it gave. Where a request differs
    /// from it in nothing that dots depend on, no ray is traced: only characters are made anew, and these only where
    /// glyphs, palette or tone have changed. Such a frame counts nothing and gives no time to the stages it left out.
    ///
    /// Where requests differ in light and not in view, which is camera, dots and their aspect, the second picture keeps what
    /// its rays from the eye met, and those after it take that over; with several samples a dot, for the one in its middle. Such
    /// a frame counts only the few rays from the eye that are traced again, where surfaces lie in one place and their
    /// materials decide. What is kept takes 21 bytes a dot of the blocks of 8 × 8 that see anything, and is forgotten with the
    /// view. The exact engine traces all rays.
    pub fn draw(&self, request: &Request) -> Frame {
        let start = Instant::now();
        self.finished(request, self.reused(request), start)
    }

    /// The same with all rays traced, whatever was drawn before: to measure it.
    pub fn draw_anew(&self, request: &Request) -> Frame {
        self.finished(request, Reused::default(), Instant::now())
    }

    /// A picture of which some of the grids may be there already.
    fn finished(&self, request: &Request, Reused { frame, hits }: Reused, start: Instant) -> Frame {
        let cells_lack = |frame: &Frame| request.wants.cells && frame.cells.is_none();
        let workers = match &frame {
            Some(frame) if !cells_lack(frame) => None,
            _ => self.workers(request.options.threads),
        };
        let work = || {
            let mut frame = frame.unwrap_or_else(|| self.traced(request, hits.as_ref()));
            if cells_lack(&frame) {
                let dithering = Instant::now();
                frame.cells = Some(Arc::new(composed(&frame.light, frame.color.as_deref(), request)));
                frame.times[Stage::Dither] = dithering.elapsed();
            }
            frame
        };
        let mut frame = match workers {
            Some(pool) => pool.install(work),
            None => work(),
        };
        frame.total = start.elapsed();
        self.keep(request, &frame, hits);
        frame.only(request)
    }

    /// The dots of a picture, without characters.
    fn traced(&self, request: &Request, hits: Option<&Hits>) -> Frame {
        let start = Instant::now();
        let (pinhole, plan) = self.plan(request);
        let hits = hits.map(|hits| hits.of(plan.precision, tiles(request.dots).len()));
        let viewed = Instant::now();
        let cut_before = self.built().cutting;
        let (structure, over_budget) = self.structure(plan.structure);
        let tracing = Instant::now();
        let mut dots = PictureDots::new(request, self.given_up());
        let view = Viewed { studio: self, plan: &plan, pinhole: &pinhole, hits };
        let whole = Whole { dots: &mut dots, wants: request.wants, progress: &self.progress };
        let (counts, sampled) = match plan.channels {
            Channels::Gray => view.work::<f64, _>(structure, whole),
            Channels::Three => view.work::<DVec3, _>(structure, whole),
        };
        let trace = tracing.elapsed();
        let mut times = shared_out(&sampled, trace);
        times[Stage::Lattice] = self.built().cutting.saturating_sub(cut_before);
        times[Stage::View] = viewed - start;
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

    /// From where a picture is seen, and what it requires.
    pub(super) fn plan(&self, request: &Request) -> (PinholeCamera, Plan) {
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let pinhole = PinholeCamera::new(&request.camera, &picture);
        let plan = Plan::new(self.scene(), &self.assembly, &pinhole, &request.planned());
        (pinhole, plan)
    }
}

/// A picture that is to be traced.
pub(super) struct Viewed<'a> {
    pub studio: &'a Studio,
    pub plan: &'a Plan,
    pub pinhole: &'a PinholeCamera,
    /// By tile, where they are kept.
    pub hits: Option<&'a [OnceLock<TileHits>]>,
}

/// What is done by the plan's engine, whichever that is.
pub(super) trait Work<C: Channel> {
    /// What comes of it.
    type Done;

    /// Does it.
    fn by<T: Tracer<C>>(self, tracer: &T) -> Self::Done;
}

impl Viewed<'_> {
    /// Has work done by the plan's engine.
    pub fn work<C: Channel + 'static, W: Work<C>>(&self, structure: Structure, work: W) -> W::Done {
        let Self { studio, plan, pinhole, .. } = *self;
        let (scene, assembly) = (studio.scene(), &studio.assembly);
        let way = farthest(assembly.scene_frame.inward_near(pinhole.eye), &assembly.limit);
        if let (EngineChoice::Fast, Structure::Boxes(boxes, subs)) = (plan.engine, structure) {
            let engine = Fast::new(assembly, boxes, subs)
                .at_level(studio.level())
                .in_singles(plan.precision == Precision::Single);
            let shader = &Shader::<_, C>::new(scene, assembly, plan, &engine);
            let (samples, spare) = (plan.samples, &studio.spare);
            work.by(&Blocks { assembly, shader, pinhole, way, samples, hits: self.hits, spare })
        } else {
            let engine = Exact::new(assembly, structure);
            let shader = &Shader::<_, C>::new(scene, assembly, plan, &engine);
            work.by(&Points { assembly, shader, pinhole, way, samples: plan.samples })
        }
    }
}

/// All dots of a picture.
struct Whole<'a> {
    dots: &'a mut PictureDots,
    wants: Wants,
    progress: &'a Progress,
}

impl<C: Channel> Work<C> for Whole<'_> {
    /// What was counted, and the times of the tiles that were timed.
    type Done = (Counts, StageTimes);

    fn by<T: Tracer<C>>(self, tracer: &T) -> Self::Done {
        let Self { dots, wants, progress } = self;
        let size = dots.light.size();
        let bands = dots.bands();
        // Of workers that have no tile in hand. Taken anew for each tile, since rayon would make more memories
        // than it has threads.
        let workers = Mutex::new(Vec::new());
        let tiles = tiles(size);
        progress.begin(Task::Tracing, tiles.len() as u64);
        let idle = || workers.lock().unwrap_or_else(PoisonError::into_inner);
        let drawn = tiles.into_par_iter().map(|tile| {
            let taken = idle().pop();
            // Behind a pointer: it is large, and handed on with every tile.
            let mut worker = taken.unwrap_or_else(|| Box::new((tracer.memory(), TileDots::new(wants))));
            let (memory, dots) = &mut *worker;
            dots.fit(&tile);
            let watch = if is_timed(&tile) { Watch::timed(Stage::Ray) } else { Watch::Silent };
            let mut meter = Meter::new(watch);
            tracer.tile(&tile, memory, dots, &mut meter);
            let measured = (meter.counts, meter.probe.stop());
            bands[(tile.corner[1] / TILE) as usize].take(size.width, &tile, dots);
            idle().push(worker);
            progress.advance(1);
            measured
        });
        let all = drawn.reduce(Default::default, |mut all, one| {
            all.0 += one.0;
            all.1 += one.1;
            all
        });
        for worker in idle().drain(..) {
            tracer.give_back(worker.0);
        }
        all
    }
}

/// The characters of a picture.
pub(super) fn composed(light: &Grid<f64>, color: Option<&Grid<DVec3>>, request: &Request) -> Grid<Cell> {
    match (color, request.palette) {
        (Some(color), Palette::Color(depth)) => {
            glyph::compose_color(color, request.glyphs, depth, request.tone)
        }
        _ => glyph::compose(light, request.glyphs, request.palette, request.tone),
    }
}

/// The distance from a point to the farthest point of a box.
fn farthest(p: DVec3, b: &Bounds) -> f64 {
    (p - b.lo).abs().max((p - b.hi).abs()).length()
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
