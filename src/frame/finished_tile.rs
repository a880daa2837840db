//! The dots of one tile when all is known of them: a value that can be kept, or sent to where the picture is
//! put together.

use crate::integrate::History;
use crate::math::DVec3;
use crate::shade::{Channel, PrimaryHit};
use crate::solid::Assembly;
use crate::stage::{Counts, StageTimes};
use crate::view::Tile;

use super::Wants;

/// A tile with its dots in scan order, a value for each; what nobody wants is absent. Whoever renders many
/// takes the memory of one again.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FinishedTile<C> {
    pub tile: Tile,
    pub light: Vec<C>,
    /// In the scene's unit; infinite where nothing is seen.
    pub depth: Option<Vec<f64>>,
    /// 0 where nothing is seen.
    pub normal: Option<Vec<DVec3>>,
    /// From 1 in file order; 0 where nothing is seen.
    pub object: Option<Vec<u32>>,
    /// What the rays through the middles met.
    pub history: Option<Vec<History>>,
    /// What was counted while it was rendered.
    pub counts: Counts,
    /// What its stages took; 0 where they were not timed.
    pub times: StageTimes,
}

impl<C: Channel> FinishedTile<C> {
    /// No dots yet.
    pub fn new(wants: Wants) -> Self {
        Self {
            tile: Tile::NONE,
            light: Vec::new(),
            depth: wants.depth.then(Vec::new),
            normal: wants.normal.then(Vec::new),
            object: wants.object.then(Vec::new),
            history: None,
            counts: Counts::default(),
            times: StageTimes::default(),
        }
    }

    /// The same with histories, or without.
    pub fn with_histories(self, kept: bool) -> Self {
        Self { history: kept.then(Vec::new), ..self }
    }

    /// Whether anyone wants to know what dots see, beside light.
    pub fn sees(&self) -> bool {
        self.depth.is_some() || self.normal.is_some() || self.object.is_some()
    }

    /// Sets what a dot sees, as far as anyone wants it.
    #[inline]
    pub fn see(&mut self, dot: usize, seen: Option<PrimaryHit>, assembly: &Assembly) {
        if let Some(depth) = &mut self.depth {
            // A distance, however large: only nothing is infinitely far away.
            let distance = |seen: PrimaryHit| (seen.t * assembly.scene_frame.unit).min(f64::MAX);
            depth[dot] = seen.map_or(f64::INFINITY, distance);
        }
        if let Some(normal) = &mut self.normal {
            normal[dot] = seen.map_or(DVec3::ZERO, |seen| seen.normal);
        }
        if let Some(object) = &mut self.object {
            object[dot] = seen.map_or(0, |seen| assembly.objects[seen.object as usize].number + 1);
        }
    }

    /// Becomes another tile, with as many dots as that has. What stands in them is left over.
    pub fn start(&mut self, tile: &Tile) {
        self.tile = *tile;
        let area = tile.size.area();
        self.light.resize(area, C::DARK);
        if let Some(depth) = &mut self.depth {
            depth.resize(area, f64::INFINITY);
        }
        if let Some(normal) = &mut self.normal {
            normal.resize(area, DVec3::ZERO);
        }
        if let Some(object) = &mut self.object {
            object.resize(area, 0);
        }
        if let Some(history) = &mut self.history {
            history.resize(area, History::MISS);
        }
    }
}
