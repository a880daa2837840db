//! One picture, through all stages.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::glyph::{self, Cell, Palette};
use crate::lattice::Structure;
use crate::math::{Bounds, DVec3, Grid};
use crate::plan::{Channels, EngineChoice, Plan, Precision};
use crate::shade::{Channel, Shader, TileHits};
use crate::stage::{Counts, Meter, Silent, Stage, StageTimes, Stopwatch, Task};
use crate::trace::{Exact, Fast};
use crate::view::{Lens, Picture, TILE, Tile, tiles};

use super::blocks::Blocks;
use super::gather::{PictureDots, TileDots};
use super::kept::{Hits, Reused};
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
                frame.cells = Some(Arc::new(composed(&frame, request)));
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
        let (lens, plan) = self.plan(request);
        let hits = hits.map(|hits| hits.of(plan.precision, tiles(request.dots).len()));
        let viewed = Instant::now();
        let cut_before = self.built().cutting;
        let (structure, over_budget) = self.structure(plan.structure);
        let tracing = Instant::now();
        let mut dots = PictureDots::new(request, self.given_up());
        let view = Viewed { studio: self, plan: &plan, lens: &lens, wants: request.wants, hits };
        let (counts, sampled) = match plan.channels {
            Channels::Gray => view.trace::<f64>(structure, &mut dots),
            Channels::Three => view.trace::<DVec3>(structure, &mut dots),
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
            nothing: (counts.primary_hits == 0).then(|| NothingInView::cause(&self.assembly, &lens)),
            counts,
            times,
            objects: self.assembly.objects.len(),
            primitives: self.assembly.primitives.len(),
            space: Space::of(&structure),
            engine: plan.engine,
            precision: plan.precision,
            over_budget,
            field: lens.field(),
            threads: rayon::current_num_threads(),
            trace,
            total: Duration::ZERO,
        }
    }

    /// From where a picture is seen, and what it requires.
    pub(super) fn plan(&self, request: &Request) -> (Lens, Plan) {
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let lens = Lens::new(&request.camera, &picture);
        let plan = Plan::new(self.scene(), &self.assembly, &lens, &request.planned());
        (lens, plan)
    }
}

/// A picture that is to be traced.
struct Viewed<'a> {
    studio: &'a Studio,
    plan: &'a Plan,
    lens: &'a Lens,
    wants: Wants,
    /// By tile, where they are kept.
    hits: Option<&'a [OnceLock<TileHits>]>,
}

impl Viewed<'_> {
    /// Traces all dots, by the plan's engine. Gives what was counted, and the times of the tiles that were
    /// timed.
    fn trace<C: Channel + 'static>(
        &self,
        structure: Structure,
        dots: &mut PictureDots,
    ) -> (Counts, StageTimes) {
        let Self { studio, plan, lens, .. } = *self;
        let (scene, assembly) = (studio.scene(), &studio.assembly);
        let way = farthest(assembly.datum.inward_near(lens.eye), &assembly.limit);
        if let (EngineChoice::Fast, Structure::Boxes(boxes, subs)) = (plan.engine, structure) {
            let engine = Fast::new(assembly, boxes, subs)
                .at_level(studio.level())
                .in_singles(plan.precision == Precision::Single);
            let shader = &Shader::<_, C>::new(scene, assembly, plan, &engine);
            let (samples, spare) = (plan.samples, &studio.spare);
            let sampler = Blocks { assembly, shader, lens, way, samples, hits: self.hits, spare };
            self.trace_by(&sampler, dots)
        } else {
            let engine = Exact::new(assembly, structure);
            let shader = &Shader::<_, C>::new(scene, assembly, plan, &engine);
            self.trace_by(&Points { assembly, shader, lens, way, samples: plan.samples }, dots)
        }
    }

    fn trace_by<C: Channel, T: Tracer<C>>(&self, tracer: &T, dots: &mut PictureDots) -> (Counts, StageTimes) {
        let size = dots.light.size();
        let bands = dots.bands();
        // Of workers that have no tile in hand. Taken anew for each tile, since rayon would make more memories
        // than it has threads.
        let workers = Mutex::new(Vec::new());
        let progress = &self.studio.progress;
        let tiles = tiles(size);
        progress.begin(Task::Tracing, tiles.len() as u64);
        let idle = || workers.lock().unwrap_or_else(PoisonError::into_inner);
        let drawn = tiles.into_par_iter().map(|tile| {
            let taken = idle().pop();
            // Behind a pointer: it is large, and handed on with every tile.
            let mut worker = taken.unwrap_or_else(|| Box::new((tracer.memory(), TileDots::new(self.wants))));
            let (memory, dots) = &mut *worker;
            dots.fit(&tile);
            let measured = if is_timed(&tile) {
                let mut meter = Meter::new(Stopwatch::start(Stage::Ray));
                tracer.tile(&tile, memory, dots, &mut meter);
                (meter.counts, meter.probe.stop())
            } else {
                let mut meter = Meter::new(Silent);
                tracer.tile(&tile, memory, dots, &mut meter);
                (meter.counts, StageTimes::default())
            };
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
fn composed(frame: &Frame, request: &Request) -> Grid<Cell> {
    match (&frame.color, request.palette) {
        (Some(color), Palette::Color(depth)) => {
            glyph::compose_color(color, request.glyphs, depth, request.tone)
        }
        _ => glyph::compose(&frame.light, request.glyphs, request.palette, request.tone),
    }
}

/// The distance from a point to the farthest point of a box.
fn farthest(p: DVec3, b: &Bounds) -> f64 {
    (p - b.lo).abs().max((p - b.hi).abs()).length()
}

/// Shares the time of tracing out among the stages as the timed tiles spent theirs.
fn shared_out(sampled: &StageTimes, trace: Duration) -> StageTimes {
    let mut times = StageTimes::default();
    let all = sampled.total().as_secs_f64();
    if all > 0.0 {
        for stage in Stage::ALL {
            times[stage] = trace.mul_f64(sampled[stage].as_secs_f64() / all);
        }
    }
    times
}
