//! Tracing a picture by tiles, whose rays run side by side.

use std::sync::OnceLock;

use crate::math::LANES;
use crate::shade::{Channel, Memory, Shader, TileHits, TileShading};
use crate::solid::Assembly;
use crate::stage::{Meter, Probe};
use crate::trace::Fast;
use crate::view::{PinholeCamera, Tile, TileCamera};

use super::gather::TileDots;
use super::points::Tracer;
use super::scratch_pool::ScratchPool;

/// Traces tile by tile, with the fast engine.
pub(super) struct Blocks<'a, 'b, C> {
    pub assembly: &'a Assembly,
    pub shader: &'a Shader<'b, Fast<'b>, C>,
    pub pinhole: &'a PinholeCamera,
    /// To the farthest point of the world, in the assembly's unit.
    pub way: f64,
    pub samples: u32,
    /// By tile: what the rays through the middles of its dots meet, where that is kept.
    pub hits: Option<&'a [OnceLock<TileHits>]>,
    pub spare: &'a ScratchPool,
}

/// What a worker of [`Blocks`] needs.
pub(super) struct BlocksMemory<'b, C> {
    alone: Memory<Fast<'b>>,
    shading: TileShading<C>,
}

impl<'b, C: Channel + 'static> Tracer<C> for Blocks<'_, 'b, C> {
    type Memory = BlocksMemory<'b, C>;

    fn memory(&self) -> BlocksMemory<'b, C> {
        BlocksMemory { alone: self.shader.memory(), shading: self.spare.take() }
    }

    fn give_back(&self, memory: BlocksMemory<'b, C>) {
        self.spare.give_back(memory.shading);
    }

    fn tile(
        &self,
        tile: &Tile,
        memory: &mut BlocksMemory<'b, C>,
        dots: &mut TileDots<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let eye = self.assembly.scene_frame.inward_near(self.pinhole.eye);
        let BlocksMemory { alone, shading } = memory;
        let sight = TileCamera { pinhole: self.pinhole, tile: *tile, off: [0.0; 2], eye, path: self.way };
        let kept = self.hits.map(|tiles| &tiles[tile.number as usize]);
        self.shader.tile(&sight, kept, shading, alone, meter);
        for block in 0..sight.blocks() {
            sight.block(block).rows(tile, |row, dots_of_row| {
                copy_row(shading.light(block, row), &mut dots.light[dots_of_row.clone()]);
                if dots.sees() {
                    for (lane, dot) in dots_of_row.enumerate() {
                        dots.see(dot, shading.seen(block, row * LANES + lane), self.assembly);
                    }
                }
            });
        }
        if self.samples == 1 {
            return;
        }
        dots.light.fill(C::DARK);
        let step = 1.0 / f64::from(self.samples);
        let inside = |k: u32| (f64::from(k) + 0.5) * step - 0.5;
        for (a, b) in (0..self.samples).flat_map(|b| (0..self.samples).map(move |a| (a, b))) {
            let sight = TileCamera { off: [inside(a), inside(b)], ..sight };
            self.shader.tile(&sight, None, shading, alone, meter);
            for block in 0..sight.blocks() {
                sight.block(block).rows(tile, |row, dots_of_row| {
                    for (dot, light) in dots.light[dots_of_row].iter_mut().zip(shading.light(block, row)) {
                        *dot = *dot + light;
                    }
                });
            }
        }
        for light in &mut dots.light {
            *light = *light * (step * step);
        }
    }
}

/// Copies as many as there is place for: mostly all, of which the compiler then knows the number.
#[inline(always)]
fn copy_row<C: Channel>(row: [C; LANES], to: &mut [C]) {
    match <&mut [C; LANES]>::try_from(&mut *to) {
        Ok(to) => *to = row,
        Err(_) => to.iter_mut().zip(row).for_each(|(to, light)| *to = light),
    }
}
