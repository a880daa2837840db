//! What the workers of one picture use again from one piece of work to the next.

use std::sync::{Mutex, PoisonError};

use crate::integrate::TileIntegrator;
use crate::shade::Channel;
use crate::view::PointPacket;

use super::Wants;
use super::finished_tile::FinishedTile;
use super::render::{RenderMemory, TileRenderer};

/// Memory of a worker.
pub(super) struct Worker<M, C> {
    pub memory: RenderMemory<M, C>,
    pub finished: FinishedTile<C>,
    pub refining: PointScratch,
}

/// Points of which rays are traced.
#[derive(Debug, Default)]
pub(super) struct PointScratch {
    /// In dots from the picture's upper left corner.
    pub points: Vec<[f64; 2]>,
    /// The same, as many as a packet has rays.
    pub packets: Vec<PointPacket>,
}

/// Memory of workers that have nothing in hand. Taken anew for each piece of work, since rayon would make
/// more memories than it has threads.
pub(super) struct Workers<M, C> {
    wants: Wants,
    keeps_histories: bool,
    // Behind pointers: they are large, and handed on with every piece.
    idle: Mutex<Vec<Box<Worker<M, C>>>>,
}

impl<M, C: Channel> Workers<M, C> {
    /// None yet.
    pub fn new(wants: Wants, keeps_histories: bool) -> Self {
        Self { wants, keeps_histories, idle: Mutex::new(Vec::new()) }
    }

    /// Has work done by one of them.
    pub fn with<I, T>(&self, renderer: &TileRenderer<I>, work: impl FnOnce(&mut Worker<M, C>) -> T) -> T
    where
        I: TileIntegrator<C, Memory = M>,
    {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = idle().pop();
        let mut worker = taken.unwrap_or_else(|| {
            let finished = FinishedTile::new(self.wants).with_histories(self.keeps_histories);
            Box::new(Worker { memory: renderer.memory(), finished, refining: PointScratch::default() })
        });
        let done = work(&mut worker);
        idle().push(worker);
        done
    }

    /// Leaves what serves the next picture.
    pub fn give_back<I>(self, renderer: &TileRenderer<I>)
    where
        I: TileIntegrator<C, Memory = M>,
    {
        for worker in self.idle.into_inner().unwrap_or_else(PoisonError::into_inner) {
            renderer.give_back(worker.memory);
        }
    }
}
