//! The first step of a picture: what it requires, from where it is seen, and how its space is cut.

use std::ops::Range;
use std::sync::OnceLock;
use std::time::Instant;

use crate::integrate::{RayIntegrator, TileHits, TileIntegrator, WavefrontIntegrator};
use crate::lattice::{OverBudget, Structure};
use crate::math::{Bounds, DVec3};
use crate::plan::{EngineChoice, Plan, Precision};
use crate::shade::Channel;
use crate::stage::{GiveUp, Stage, StageTimes};
use crate::trace::{Exact, Fast};
use crate::view::{Picture, PinholeCamera, tiles};

use super::frame_cache::Hits;
use super::render::TileRenderer;
use super::{Request, Studio};

/// A picture that is ready to be rendered, tile by tile.
pub(super) struct Prepared<'a> {
    studio: &'a Studio,
    pub plan: Plan,
    pub pinhole: PinholeCamera,
    pub structure: Structure<'a>,
    /// Why that is a tree, where a lattice was asked for.
    pub over_budget: Option<OverBudget>,
    /// What VIEW took, and LATTICE where this picture was the first to want its structure.
    pub times: StageTimes,
    /// By tile: what rays through the middles of dots meet, where that is kept.
    hits: Option<&'a [OnceLock<TileHits>]>,
    /// The numbers of the samples of each dot.
    pub samples: Range<u32>,
    give_up: &'a GiveUp<'a>,
}

/// What is done with a picture's tiles, by whatever integrator its plan has.
pub(super) trait Work<C: Channel> {
    /// What comes of it.
    type Done;

    /// Does it.
    fn by<I: TileIntegrator<C>>(self, renderer: &TileRenderer<I>) -> Self::Done;
}

impl Studio {
    /// Prepares a picture; `hits` are those of a picture of the same view, or room for them.
    pub(super) fn prepare<'a>(
        &'a self,
        request: &Request,
        hits: Option<&'a Hits>,
        give_up: &'a GiveUp<'a>,
    ) -> Prepared<'a> {
        let start = Instant::now();
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let pinhole = PinholeCamera::new(&request.camera, &picture);
        let plan = Plan::new(self.scene(), &self.assembly, &pinhole, &request.planned());
        let hits = hits.map(|hits| hits.of(plan.precision, tiles(request.dots).len()));
        let mut times = StageTimes::default();
        times[Stage::View] = start.elapsed();
        let cut_before = self.built().cutting;
        let (structure, over_budget) = self.structure(plan.structure);
        times[Stage::Lattice] = self.built().cutting.saturating_sub(cut_before);
        let samples = 0..plan.samples.pow(2);
        Prepared { studio: self, plan, pinhole, structure, over_budget, times, hits, samples, give_up }
    }
}

impl Prepared<'_> {
    /// Has work done by the plan's integrator.
    pub fn work<C: Channel + 'static, W: Work<C>>(&self, work: W) -> W::Done {
        let (studio, plan) = (self.studio, &self.plan);
        let (scene, assembly) = (studio.scene(), &studio.assembly);
        if let (EngineChoice::Fast, Structure::Boxes(boxes, subs)) = (plan.engine, self.structure) {
            let engine = Fast::new(assembly, boxes, subs)
                .at_level(studio.level())
                .in_singles(plan.precision == Precision::Single);
            work.by(&self.renderer(&WavefrontIntegrator::<C>::new(scene, assembly, plan, &engine)))
        } else {
            let engine = Exact::new(assembly, self.structure);
            work.by(&self.renderer(&RayIntegrator::<_, C>::new(scene, assembly, plan, &engine)))
        }
    }

    /// Where rays start, in the assembly's coordinates.
    fn eye(&self) -> DVec3 {
        self.studio.assembly.scene_frame.inward_near(self.pinhole.eye)
    }

    /// From there to the farthest point of the world, in the assembly's unit.
    pub fn longest_path(&self) -> f64 {
        farthest(self.eye(), &self.studio.assembly.limit)
    }

    fn renderer<'r, I>(&'r self, integrator: &'r I) -> TileRenderer<'r, I> {
        TileRenderer {
            integrator,
            assembly: &self.studio.assembly,
            pinhole: &self.pinhole,
            eye: self.eye(),
            longest_path: self.longest_path(),
            samples: self.samples.clone(),
            hits: self.hits,
            spare: &self.studio.spare,
            give_up: self.give_up,
        }
    }
}

/// The distance from a point to the farthest point of a box.
fn farthest(p: DVec3, b: &Bounds) -> f64 {
    (p - b.lo).abs().max((p - b.hi).abs()).length()
}
