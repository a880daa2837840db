//! The eleven stages of the flow chart, and what each of them counted and how long it took.
//!
//! The order and the names are those of `docs/flow-chart.md`; a test compares the two.

mod give_up;
mod probe;
mod progress;
mod ray_event;
mod recorder;
mod stopwatch;

use std::ops::{Add, AddAssign, Index, IndexMut};
use std::time::Duration;

pub use give_up::GiveUp;
pub use probe::{Meter, Probe, Silent};
pub use progress::{Progress, Task, WorkStep};
pub use ray_event::{RayEvent, RayKind};
pub use recorder::Recorder;
pub use stopwatch::Stopwatch;

/// One stage of the flow chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Stage {
    /// Read the solids: kind, place, size, surface.
    Objects,
    /// World limit, lattice and sub-lattice lists.
    Lattice,
    /// Viewpoint, direction, field.
    View,
    /// The next ray of the picture.
    Ray,
    /// Outcodes of a viewpoint outside the world; rays that miss it end here.
    Clip,
    /// The walk from cell to cell.
    Cell,
    /// Ray against primitives: intervals.
    Solid,
    /// Union, intersection, difference of intervals: the hit.
    Csg,
    /// The illumination equations.
    Shade,
    /// 13 levels.
    Dither,
    /// Characters.
    Display,
}

impl Stage {
    /// All stages in the order of the chart.
    pub const ALL: [Self; 11] = [
        Self::Objects,
        Self::Lattice,
        Self::View,
        Self::Ray,
        Self::Clip,
        Self::Cell,
        Self::Solid,
        Self::Csg,
        Self::Shade,
        Self::Dither,
        Self::Display,
    ];

    /// The number in the chart, 1 to 11.
    pub const fn number(self) -> usize {
        self as usize + 1
    }

    /// The name in the chart.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Objects => "OBJECTS",
            Self::Lattice => "LATTICE",
            Self::View => "VIEW",
            Self::Ray => "RAY",
            Self::Clip => "CLIP",
            Self::Cell => "CELL",
            Self::Solid => "SOLID",
            Self::Csg => "CSG",
            Self::Shade => "SHADE",
            Self::Dither => "DITHER",
            Self::Display => "DISPLAY",
        }
    }
}

/// What a picture needed, counted. Adding two adds every count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays from the eye that were traced.
    pub primary_rays: u64,
    /// Rays from the eye that met something, be it that an earlier picture found out.
    pub primary_hits: u64,
    /// Rays sent towards a light.
    pub shadow_rays: u64,
    /// Rays towards a light that met something first.
    pub shadow_hits: u64,
    /// Mirror and Snell rays.
    pub secondary_rays: u64,
    /// Mirror and Snell rays that met something.
    pub secondary_hits: u64,
    /// Rays of any kind that missed the world's box, and so never walked.
    pub clipped_rays: u64,
    /// Cells of the lattice, and of sub-lattices, that rays stepped through.
    pub cells_visited: u64,
    /// Ray against primitive tests.
    pub primitive_tests: u64,
    /// CSG expressions evaluated along a ray.
    pub csg_evaluations: u64,
    /// Rays not followed for their small weight or their depth.
    pub truncated_rays: u64,
}

impl Counts {
    /// Rays of all kinds.
    pub fn rays(&self) -> u64 {
        self.primary_rays + self.shadow_rays + self.secondary_rays
    }
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.primary_rays += other.primary_rays;
        self.primary_hits += other.primary_hits;
        self.shadow_rays += other.shadow_rays;
        self.shadow_hits += other.shadow_hits;
        self.secondary_rays += other.secondary_rays;
        self.secondary_hits += other.secondary_hits;
        self.clipped_rays += other.clipped_rays;
        self.cells_visited += other.cells_visited;
        self.primitive_tests += other.primitive_tests;
        self.csg_evaluations += other.csg_evaluations;
        self.truncated_rays += other.truncated_rays;
    }
}

impl Add for Counts {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

/// The time spent in each stage, indexed by [`Stage`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes([Duration; 11]);

impl Index<Stage> for StageTimes {
    type Output = Duration;
    fn index(&self, stage: Stage) -> &Duration {
        &self.0[stage as usize]
    }
}

impl IndexMut<Stage> for StageTimes {
    fn index_mut(&mut self, stage: Stage) -> &mut Duration {
        &mut self.0[stage as usize]
    }
}

impl AddAssign for StageTimes {
    fn add_assign(&mut self, other: Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}

impl StageTimes {
    /// The sum over all stages.
    pub fn total(&self) -> Duration {
        self.0.iter().sum()
    }
}
