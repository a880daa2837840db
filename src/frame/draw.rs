//! One picture, through all stages.

use std::time::Instant;

use rayon::prelude::*;

use crate::glyph::{self, Palette};
use crate::lattice::Structure;
use crate::math::{Bounds, DVec3, Grid, Ray, Size};
use crate::plan::{Channels, Options, Plan};
use crate::shade::{Channel, Memory, Shader, Sight, TileShading, View};
use crate::stage::{Counts, Meter, Probe, Silent, Stage, StageTimes, Stopwatch};
use crate::trace::{Exact, Fast};
use crate::view::{BLOCK, Block, Lens, Picture, TILE, Tile, settled, tiles};

use super::{Frame, Request, Space, Studio};

/// One tile in this many is timed stage by stage: reading the clock at every change of stage costs about as much
/// as the stage. A prime, so that the timed tiles do not stand in columns.
const TIMED: u32 = 13;

impl Studio {
    /// Draws one picture. The same request gives the same dots and cells, on any number of threads.
    pub fn draw(&self, request: &Request) -> Frame {
        let start = Instant::now();
        let (lens, plan) = self.plan(request);
        let viewed = Instant::now();
        let cut_before = self.built().cutting;
        let workers = self.workers(request.options.threads);
        let cut = || self.structure(plan.structure);
        let (structure, over_budget) = workers.as_ref().map_or_else(cut, |pool| pool.install(cut));
        let tracing = Instant::now();
        let work = || {
            if let Structure::Boxes(boxes, subs) = structure {
                let engine = Fast::new(&self.assembly, boxes, subs);
                return match plan.channels {
                    Channels::Gray => self.trace_tiles::<f64>(&engine, &plan, &lens, request.dots),
                    Channels::Three => self.trace_tiles::<DVec3>(&engine, &plan, &lens, request.dots),
                };
            }
            let engine = Exact::new(&self.assembly, structure);
            match plan.channels {
                Channels::Gray => self.trace::<f64>(&engine, &plan, &lens, request.dots),
                Channels::Three => self.trace::<DVec3>(&engine, &plan, &lens, request.dots),
            }
        };
        let traced = workers.as_ref().map_or_else(work, |pool| pool.install(work));
        let trace = tracing.elapsed();

        let Traced { light, color, depth, normal, object, counts, times } = traced;
        let color = Some(color).filter(|_| request.wants_color());
        let dithering = Instant::now();
        let cells = match (&color, request.palette) {
            (Some(color), Palette::Color(depth)) => {
                glyph::compose_color(color, request.glyphs, depth, request.tone)
            }
            _ => glyph::compose(&light, request.glyphs, request.palette, request.tone),
        };
        let mut times = shared_out(&times, trace);
        times[Stage::Lattice] = self.built().cutting.saturating_sub(cut_before);
        times[Stage::View] = viewed - start;
        times[Stage::Dither] = dithering.elapsed();
        Frame {
            light,
            color,
            depth,
            normal,
            object,
            cells,
            counts,
            times,
            objects: self.assembly.objects.len(),
            primitives: self.assembly.primitives.len(),
            space: Space::of(&structure),
            over_budget,
            field: lens.field(),
            threads: workers.map_or(1, |pool| pool.current_num_threads()),
            trace,
            total: start.elapsed(),
        }
    }

    /// From where a picture is seen, and what it requires.
    pub(super) fn plan(&self, request: &Request) -> (Lens, Plan) {
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let lens = Lens::new(&request.camera, &picture);
        let options = Options { color: request.wants_color(), ..request.options };
        let plan = Plan::new(self.scene(), &self.assembly, &lens, &options);
        (lens, plan)
    }

    fn trace<C: Channel>(&self, engine: &Exact, plan: &Plan, lens: &Lens, dots: Size) -> Traced {
        let shader = Shader::<_, C>::new(self.scene(), &self.assembly, plan, engine);
        let way = farthest(self.assembly.datum.inward_near(lens.eye), &self.assembly.limit);
        let sampler = Sampler { studio: self, shader: &shader, lens, way, samples: plan.samples };
        let tiles = tiles(dots);
        let drawn: Vec<Drawn> = tiles
            .par_iter()
            .map_init(
                || shader.memory(),
                |memory, tile| {
                    if tile.number % TIMED == 0 {
                        let mut meter = Meter::new(Stopwatch::start(Stage::Ray));
                        let dots = sampler.tile(tile, memory, &mut meter);
                        Drawn { dots, counts: meter.counts, times: Some(meter.probe.stop()) }
                    } else {
                        let mut meter = Meter::new(Silent);
                        let dots = sampler.tile(tile, memory, &mut meter);
                        Drawn { dots, counts: meter.counts, times: None }
                    }
                },
            )
            .collect();
        Traced::gathered(dots, &tiles, &drawn)
    }
}

impl Studio {
    fn trace_tiles<C: Channel>(&self, engine: &Fast, plan: &Plan, lens: &Lens, dots: Size) -> Traced {
        let shader = Shader::<_, C>::new(self.scene(), &self.assembly, plan, engine);
        let way = farthest(self.assembly.datum.inward_near(lens.eye), &self.assembly.limit);
        let sampler = TileSampler { studio: self, engine, shader: &shader, lens, way, samples: plan.samples };
        let tiles = tiles(dots);
        let drawn: Vec<Drawn> = tiles
            .par_iter()
            .map_init(
                || (shader.memory(), TileShading::default(), Sight::default()),
                |memory, tile| {
                    if tile.number % TIMED == 0 {
                        let mut meter = Meter::new(Stopwatch::start(Stage::Ray));
                        let dots = sampler.tile(tile, memory, &mut meter);
                        Drawn { dots, counts: meter.counts, times: Some(meter.probe.stop()) }
                    } else {
                        let mut meter = Meter::new(Silent);
                        let dots = sampler.tile(tile, memory, &mut meter);
                        Drawn { dots, counts: meter.counts, times: None }
                    }
                },
            )
            .collect();
        Traced::gathered(dots, &tiles, &drawn)
    }
}

struct TileSampler<'a, 'b, C> {
    studio: &'a Studio,
    engine: &'a Fast<'b>,
    shader: &'a Shader<'b, Fast<'b>, C>,
    lens: &'a Lens,
    way: f64,
    samples: u32,
}

impl<'b, C: Channel> TileSampler<'_, 'b, C> {
    fn tile(
        &self,
        tile: &Tile,
        (memory, shading, sight): &mut (Memory<Fast<'b>>, TileShading, Sight),
        meter: &mut Meter<impl Probe>,
    ) -> Vec<Dot> {
        let assembly = &self.studio.assembly;
        let size = tile.size;
        let nothing =
            Dot { light: 0.0, color: DVec3::ZERO, depth: f64::INFINITY, normal: DVec3::ZERO, object: 0 };
        let mut dots = vec![nothing; size.area()];
        let across = size.width.div_ceil(BLOCK);
        let blocks = across * size.height.div_ceil(BLOCK);
        let mut sums = vec![C::DARK; if self.samples > 1 { size.area() } else { 0 }];
        let step = 1.0 / f64::from(self.samples);
        let inside = |k: u32| (f64::from(k) + 0.5) * step - 0.5;
        let offsets = (0..self.samples).flat_map(|b| (0..self.samples).map(move |a| (a, b)));
        let offsets = offsets.map(|(a, b)| Some((inside(a), inside(b)))).filter(|_| self.samples > 1);
        for offset in std::iter::once(None).chain(offsets) {
            meter.at(Stage::Ray);
            sight.clear();
            let off = offset.unwrap_or((0.0, 0.0)).into();
            let eye = assembly.datum.inward_near(self.lens.eye);
            for number in 0..blocks {
                let (i, j) = (number % across * BLOCK, number / across * BLOCK);
                let size = Size::new(BLOCK.min(size.width - i), BLOCK.min(size.height - j));
                let block = Block { corner: [tile.corner[0] + i, tile.corner[1] + j], size };
                let mut rays = block.rays(self.lens, off, eye, self.way, self.engine.level());
                let way = self.engine.approach(&mut rays);
                sight.push(rays, way);
            }
            self.shader.tile(eye, sight, shading, memory, meter, |block, lane, view| {
                let (i, j) = (
                    block as u32 % across * BLOCK + lane as u32 % BLOCK,
                    block as u32 / across * BLOCK + lane as u32 / BLOCK,
                );
                let place = (j * size.width + i) as usize;
                if offset.is_some() {
                    sums[place] = sums[place] + view.light;
                    return;
                }
                let (light, color) = (view.light.gray(), view.light.rgb());
                dots[place] = view.seen.map_or(Dot { light, color, ..nothing }, |seen| Dot {
                    light,
                    color,
                    depth: (seen.t * assembly.datum.unit).min(f64::MAX),
                    normal: seen.normal,
                    object: assembly.objects[seen.object as usize].number + 1,
                });
            });
        }
        for (dot, sum) in dots.iter_mut().zip(sums) {
            let light = sum * (step * step);
            (dot.light, dot.color) = (light.gray(), light.rgb());
        }
        dots
    }
}

/// The distance from a point to the farthest point of a box.
fn farthest(p: DVec3, b: &Bounds) -> f64 {
    (p - b.lo).abs().max((p - b.hi).abs()).length()
}

/// Shares the time of tracing out among the stages as the timed tiles spent theirs.
fn shared_out(sampled: &StageTimes, trace: std::time::Duration) -> StageTimes {
    let mut times = StageTimes::default();
    let all = sampled.total().as_secs_f64();
    if all > 0.0 {
        for stage in Stage::ALL {
            times[stage] = trace.mul_f64(sampled[stage].as_secs_f64() / all);
        }
    }
    times
}

/// What one dot saw.
#[derive(Clone, Copy, Debug)]
struct Dot {
    light: f64,
    color: DVec3,
    depth: f64,
    normal: DVec3,
    object: u32,
}

/// A finished tile.
struct Drawn {
    dots: Vec<Dot>,
    counts: Counts,
    times: Option<StageTimes>,
}

struct Sampler<'a, 'b, C> {
    studio: &'a Studio,
    shader: &'a Shader<'b, Exact<'b>, C>,
    lens: &'a Lens,
    /// To the farthest point of the world, in the assembly's unit.
    way: f64,
    samples: u32,
}

impl<'b, C: Channel> Sampler<'_, 'b, C> {
    fn tile(&self, tile: &Tile, memory: &mut Memory<Exact<'b>>, meter: &mut Meter<impl Probe>) -> Vec<Dot> {
        let mut dots = Vec::with_capacity((TILE * TILE) as usize);
        for (i, j) in tile.dots() {
            let (x, y) = (f64::from(i) + 0.5, f64::from(j) + 0.5);
            let middle = self.sample(x, y, memory, meter);
            let light = if self.samples == 1 {
                middle.light
            } else {
                let step = 1.0 / f64::from(self.samples);
                let mut sum = C::DARK;
                for (a, b) in (0..self.samples).flat_map(|b| (0..self.samples).map(move |a| (a, b))) {
                    let inside = |k: u32| (f64::from(k) + 0.5) * step - 0.5;
                    sum = sum + self.sample(x + inside(a), y + inside(b), memory, meter).light;
                }
                sum * (step * step)
            };
            let assembly = &self.studio.assembly;
            let (light, color) = (light.gray(), light.rgb());
            dots.push(middle.seen.map_or(
                Dot { light, color, depth: f64::INFINITY, normal: DVec3::ZERO, object: 0 },
                |seen| Dot {
                    light,
                    color,
                    // A distance, however large: only nothing is infinitely far away.
                    depth: (seen.t * assembly.datum.unit).min(f64::MAX),
                    normal: seen.normal,
                    object: assembly.objects[seen.object as usize].number + 1,
                },
            ));
        }
        dots
    }

    fn sample(
        &self,
        x: f64,
        y: f64,
        memory: &mut Memory<Exact<'b>>,
        meter: &mut Meter<impl Probe>,
    ) -> View<C> {
        meter.at(Stage::Ray);
        let ray = self.studio.assembly.ray(&self.lens.ray(x, y));
        let ray = Ray::new(ray.o, settled(ray.d, self.way));
        let view = self.shader.view(&ray, memory, meter);
        meter.at(Stage::Ray);
        view
    }
}

/// The dots of all tiles.
struct Traced {
    light: Grid<f64>,
    color: Grid<DVec3>,
    depth: Grid<f64>,
    normal: Grid<DVec3>,
    object: Grid<u32>,
    counts: Counts,
    /// Of the timed tiles.
    times: StageTimes,
}

impl Traced {
    fn gathered(size: Size, tiles: &[Tile], drawn: &[Drawn]) -> Self {
        let mut all = Self {
            light: Grid::filled(size, 0.0),
            color: Grid::filled(size, DVec3::ZERO),
            depth: Grid::filled(size, f64::INFINITY),
            normal: Grid::filled(size, DVec3::ZERO),
            object: Grid::filled(size, 0),
            counts: Counts::default(),
            times: StageTimes::default(),
        };
        for (tile, done) in tiles.iter().zip(drawn) {
            all.counts += done.counts;
            if let Some(times) = done.times {
                all.times += times;
            }
            for (place, dot) in tile.dots().zip(&done.dots) {
                all.light[place] = dot.light;
                all.color[place] = dot.color;
                all.depth[place] = dot.depth;
                all.normal[place] = dot.normal;
                all.object[place] = dot.object;
            }
        }
        all
    }
}
