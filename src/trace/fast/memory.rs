//! Memory of one worker.

use fearless_simd::Simd;

use crate::lattice::{Beam, FAN, Fan};
use crate::math::{Bundle, Digits};
use crate::solid::{BundleScratch, Found, Pruning, Remains, Sheared};
use crate::stage::Counts;

use super::company::Company;
use super::nearest::Nearest;
use super::outset::Outset;
use super::stream::Apart;
use super::thin::Thin;
use super::walk::Waits;

/// What tracing a tile needs, used again for every tile.
#[derive(Debug)]
pub struct TileMemory {
    /// By bundle: its own frustum, if it asks, and how far its rays have still to look.
    pub(super) beams: Vec<Option<Beam>>,
    pub(super) far: Vec<f64>,
    /// Their rays in half the digits, for as many as a fan has.
    pub(super) thin: Vec<Thin>,
    pub(super) fan: Fan,
    pub(super) company: Company,
    pub(super) apart: Apart,
    /// By bundle: the planes across its rays, where they were asked for.
    pub(super) sheared: Vec<Sheared>,
    /// Nodes to be walked.
    pub(super) stack: Vec<Waits>,
    pub(super) numbers: Numbers<f64>,
    pub(super) singles: Numbers<f32>,
    /// What rays meet of one object.
    pub(super) met: Box<Nearest>,
    pub(super) pruning: Pruning,
    /// Pruned expressions that are not in use.
    pub(super) remains: Vec<Remains>,
    pub(super) counts: Counts,
}

/// Memory for what is asked of a bundle, in numbers of so many digits.
#[derive(Debug)]
pub(super) struct Numbers<T> {
    pub scratch: BundleScratch<T>,
    pub found: Box<Found<T>>,
    /// By bundle: its rays, and what they met, where those of the tile are others.
    pub rays: Vec<Bundle<T>>,
    pub nearest: Vec<Nearest<T>>,
}

impl<T: Digits> Default for Numbers<T> {
    fn default() -> Self {
        Self {
            scratch: BundleScratch::default(),
            found: Box::new(Found::NONE),
            rays: Vec::new(),
            nearest: Vec::new(),
        }
    }
}

/// Digits in which rays are asked.
pub(super) trait Asks: Digits {
    /// Their part of the memory.
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self>;

    /// Makes a bundle known in these digits, where they are not its own.
    fn take<S: Simd>(simd: S, full: &Bundle, own: &mut [Bundle<Self>], k: usize);

    /// A bundle that was made known.
    fn outset<'a>(full: Outset<'a>, own: &'a [Bundle<Self>], k: usize) -> Outset<'a, Self>;
}

impl Asks for f64 {
    #[inline(always)]
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self> {
        &mut memory.numbers
    }

    #[inline(always)]
    fn take<S: Simd>(_: S, _: &Bundle, _: &mut [Bundle], _: usize) {}

    #[inline(always)]
    fn outset<'a>(full: Outset<'a>, _: &'a [Bundle], _: usize) -> Outset<'a> {
        full
    }
}

impl Asks for f32 {
    #[inline(always)]
    fn numbers(memory: &mut TileMemory) -> &mut Numbers<Self> {
        &mut memory.singles
    }

    #[inline(always)]
    fn take<S: Simd>(simd: S, full: &Bundle, own: &mut [Bundle<Self>], k: usize) {
        simd.vectorize(
            #[inline(always)]
            || own[k].set_nearest(full),
        );
    }

    #[inline(always)]
    fn outset<'a>(full: Outset<'a>, own: &'a [Bundle<Self>], k: usize) -> Outset<'a, Self> {
        // Only rays from the eye are asked so, which leave nothing.
        Outset { rays: &own[k], departures: None, full_rays: full.rays, full_departures: full.departures }
    }
}

impl TileMemory {
    /// What was counted since it was last taken.
    pub fn counts_mut(&mut self) -> &mut Counts {
        &mut self.counts
    }

    /// Forgets the planes across the rays of the last tile.
    pub(super) fn forget_sheared(&mut self) {
        self.sheared.iter_mut().for_each(Sheared::forget);
    }
}

impl Default for TileMemory {
    fn default() -> Self {
        Self {
            beams: Vec::new(),
            far: Vec::new(),
            thin: vec![Thin::EMPTY; FAN],
            fan: Fan::default(),
            company: Company::default(),
            apart: Apart::default(),
            sheared: vec![Sheared::UNKNOWN; FAN],
            stack: Vec::new(),
            numbers: Numbers::default(),
            singles: Numbers::default(),
            met: Box::default(),
            pruning: Pruning::default(),
            remains: Vec::new(),
            counts: Counts::default(),
        }
    }
}
