//! The mean light of many rays a dot, which the exact engine answers for.

use std::ops::Range;
use std::sync::Arc;

use crate::frame::{Frame, Request, Studio};
use crate::glyph::{self, Cell};
use crate::math::{DVec3, Grid};
use crate::plan::EngineChoice;
use crate::stage::GiveUp;

/// So many rays a dot are traced by the exact engine in any case, beside the fast one in double precision,
/// which is to find the same bits. Where it does, it traces the rest; where it does not, the exact one does.
pub(super) const CHECKED_RAYS: u32 = 4;

/// The number of its first ray in the sampling sequence: past all that a setting may take, 64 × 64, so that
/// no picture is held against rays of its own.
const FIRST_RAY: u32 = 4096;

/// The mean light of some rays through each dot.
#[derive(Clone, Debug)]
pub(super) struct MeanLight {
    /// Linear, a gray.
    pub light: Arc<Grid<f64>>,
    color: Option<Arc<Grid<DVec3>>>,
}

impl MeanLight {
    fn of(frame: Frame) -> Self {
        Self { light: frame.light, color: frame.color }
    }

    /// The mean of both, which are of as many rays.
    pub fn with(&self, other: &Self) -> Self {
        let light = means(self.light.values(), other.light.values(), f64::midpoint);
        let color = self.color.as_ref().zip(other.color.as_ref());
        Self {
            light: Arc::new(Grid::from_values(self.light.size(), light)),
            color: color.map(|(own, other)| {
                let color = means(own.values(), other.values(), |a, b| 0.5 * (a + b));
                Arc::new(Grid::from_values(own.size(), color))
            }),
        }
    }

    /// Its characters, as a request wants them.
    pub fn composed(&self, request: &Request) -> Grid<Cell> {
        let color = self.color.as_deref();
        glyph::compose_dots(&self.light, color, request.glyphs, request.palette, request.tone)
    }
}

fn means<T: Copy>(own: &[T], other: &[T], mean: impl Fn(T, T) -> T) -> Vec<T> {
    own.iter().zip(other).map(|(own, other)| mean(*own, *other)).collect()
}

/// The rays of the sampling sequence through each dot of a picture, one after the other.
pub(super) struct ManyRays<'a> {
    studio: &'a Studio,
    /// By the exact engine.
    request: Request,
    /// Whether the fast engine found the same bits until now.
    agrees: bool,
    /// Whether that is known already, and no ray need be traced by both.
    is_checked: bool,
}

impl<'a> ManyRays<'a> {
    /// Of a picture that the exact engine draws.
    pub const fn new(studio: &'a Studio, request: Request) -> Self {
        Self { studio, request, agrees: true, is_checked: false }
    }

    /// The same rays from another viewpoint or direction, by the engine that was found good.
    pub const fn of(&self, request: Request) -> Self {
        Self { studio: self.studio, request, agrees: self.agrees, is_checked: true }
    }

    /// Whether the fast engine found the bits of the exact one in all rays that both traced.
    pub const fn agrees(&self) -> bool {
        self.agrees
    }

    /// The mean of some of them, by their numbers from 0; `None` where that is given up.
    pub fn mean(&mut self, rays: Range<u32>, give_up: &GiveUp) -> Option<MeanLight> {
        let samples = FIRST_RAY + rays.start..FIRST_RAY + rays.end;
        let mut fast = self.request.clone();
        fast.options.engine = EngineChoice::Fast;
        if self.agrees && (self.is_checked || rays.start >= CHECKED_RAYS) {
            return self.studio.draw_samples_unless(&fast, samples, give_up).map(MeanLight::of);
        }
        let exact = self.studio.draw_samples_unless(&self.request, samples.clone(), give_up)?;
        if self.agrees && rays.end <= CHECKED_RAYS {
            let fast = self.studio.draw_samples_unless(&fast, samples, give_up)?;
            let differ = |(a, b): (&f64, &f64)| a.to_bits() != b.to_bits();
            self.agrees = !exact.light.values().iter().zip(fast.light.values()).any(differ);
        }
        Some(MeanLight::of(exact))
    }
}
