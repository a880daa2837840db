//! Memory of one worker.

use crate::lattice::{Beam, FAN, Fan};
use crate::solid::{BundleScratch, Found, Pruning, Remains, Sheared};
use crate::stage::Counts;

use super::company::Company;
use super::nearest::Nearest;
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
    pub(super) scratch: BundleScratch,
    pub(super) found: Box<Found>,
    /// What rays meet of one object.
    pub(super) met: Box<Nearest>,
    pub(super) pruning: Pruning,
    /// Pruned expressions that are not in use.
    pub(super) remains: Vec<Remains>,
    pub(super) counts: Counts,
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
            scratch: BundleScratch::default(),
            found: Box::new(Found::NONE),
            met: Box::default(),
            pruning: Pruning::default(),
            remains: Vec::new(),
            counts: Counts::default(),
        }
    }
}
