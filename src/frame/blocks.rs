//! Tracing a picture by tiles, whose rays run side by side.

use crate::math::Size;
use crate::shade::{Channel, Memory, Shader, Sight, TileShading};
use crate::solid::Assembly;
use crate::stage::{Meter, Probe, Stage};
use crate::trace::Fast;
use crate::view::{BLOCK, Block, Lens, Tile};

use super::gather::TileDots;
use super::points::Tracer;

/// Traces tile by tile, with the fast engine.
pub(super) struct Blocks<'a, 'b, C> {
    pub assembly: &'a Assembly,
    pub engine: &'a Fast<'b>,
    pub shader: &'a Shader<'b, Fast<'b>, C>,
    pub lens: &'a Lens,
    /// To the farthest point of the world, in the assembly's unit.
    pub way: f64,
    pub samples: u32,
}

/// What a worker of [`Blocks`] needs.
pub(super) struct BlocksMemory<'b, C> {
    alone: Memory<Fast<'b>>,
    shading: TileShading<C>,
    sight: Sight,
}

impl<'b, C: Channel> Tracer<C> for Blocks<'_, 'b, C> {
    type Memory = BlocksMemory<'b, C>;

    fn memory(&self) -> BlocksMemory<'b, C> {
        let (shading, sight) = (TileShading::default(), Sight::default());
        BlocksMemory { alone: self.shader.memory(), shading, sight }
    }

    fn tile(
        &self,
        tile: &Tile,
        memory: &mut BlocksMemory<'b, C>,
        dots: &mut TileDots<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let assembly = self.assembly;
        self.rays(tile, [0.0; 2], &mut memory.sight, meter);
        let width = tile.size.width;
        let across = width.div_ceil(BLOCK);
        let place = |block: usize, lane: usize| {
            let (block, lane) = (block as u32, lane as u32);
            let i = block % across * BLOCK + lane % BLOCK;
            let j = block / across * BLOCK + lane / BLOCK;
            (j * width + i) as usize
        };
        let eye = assembly.datum.inward_near(self.lens.eye);
        let BlocksMemory { alone, shading, sight } = memory;
        self.shader.tile(eye, sight, shading, alone, meter, |block, lane, view| {
            let place = place(block, lane);
            dots.light[place] = view.light;
            dots.see(place, view.seen, assembly);
        });
        if self.samples == 1 {
            return;
        }
        dots.light.fill(C::DARK);
        let step = 1.0 / f64::from(self.samples);
        let inside = |k: u32| (f64::from(k) + 0.5) * step - 0.5;
        for (a, b) in (0..self.samples).flat_map(|b| (0..self.samples).map(move |a| (a, b))) {
            self.rays(tile, [inside(a), inside(b)], sight, meter);
            self.shader.tile(eye, sight, shading, alone, meter, |block, lane, view| {
                let place = place(block, lane);
                dots.light[place] = dots.light[place] + view.light;
            });
        }
        for light in &mut dots.light {
            *light = *light * (step * step);
        }
    }
}

impl<C: Channel> Blocks<'_, '_, C> {
    /// The rays through a point of each dot of a tile, `off` from its middle.
    fn rays(&self, tile: &Tile, off: [f64; 2], sight: &mut Sight, meter: &mut Meter<impl Probe>) {
        meter.at(Stage::Ray);
        let eye = self.assembly.datum.inward_near(self.lens.eye);
        sight.clear();
        let [left, top] = tile.corner;
        for j in (0..tile.size.height).step_by(BLOCK as usize) {
            for i in (0..tile.size.width).step_by(BLOCK as usize) {
                let size = Size::new(BLOCK.min(tile.size.width - i), BLOCK.min(tile.size.height - j));
                let block = Block { corner: [left + i, top + j], size };
                let mut rays = block.rays(self.lens, off, eye, self.way, self.engine.level());
                let way = self.engine.approach(&mut rays);
                sight.push(rays, way);
            }
        }
    }
}
