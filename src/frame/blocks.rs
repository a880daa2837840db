//! Tracing a picture by tiles, whose rays run side by side.

use crate::math::{DVec3, LANES, Size};
use crate::shade::{Channel, Memory, Shader, TileShading};
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
}

impl<'b, C: Channel> Tracer<C> for Blocks<'_, 'b, C> {
    type Memory = BlocksMemory<'b, C>;

    fn memory(&self) -> BlocksMemory<'b, C> {
        BlocksMemory { alone: self.shader.memory(), shading: TileShading::default() }
    }

    fn tile(
        &self,
        tile: &Tile,
        memory: &mut BlocksMemory<'b, C>,
        dots: &mut TileDots<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        let eye = self.assembly.datum.inward_near(self.lens.eye);
        let BlocksMemory { alone, shading } = memory;
        self.rays(tile, [0.0; 2], eye, shading, meter);
        self.shader.tile(eye, shading, alone, meter);
        for (block, place) in blocks(tile) {
            place.rows(tile, |row, dots_of_row| {
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
            self.rays(tile, [inside(a), inside(b)], eye, shading, meter);
            self.shader.tile(eye, shading, alone, meter);
            for (block, place) in blocks(tile) {
                place.rows(tile, |row, dots_of_row| {
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

/// Copies as many as there is place for: mostly all.
#[inline]
fn copy_row<C: Channel>(row: [C; LANES], to: &mut [C]) {
    match <&mut [C; LANES]>::try_from(&mut *to) {
        Ok(to) => *to = row,
        Err(_) => to.copy_from_slice(&row[..to.len()]),
    }
}

/// The blocks of a tile in scan order, numbered; their corners are those in the tile.
fn blocks(tile: &Tile) -> impl Iterator<Item = (usize, Block)> {
    let Size { width, height } = tile.size;
    let corners = (0..height)
        .step_by(BLOCK as usize)
        .flat_map(move |j| (0..width).step_by(BLOCK as usize).map(move |i| [i, j]));
    let block = move |[i, j]: [u32; 2]| {
        let size = Size::new(BLOCK.min(width - i), BLOCK.min(height - j));
        Block { corner: [i, j], size }
    };
    corners.map(block).enumerate()
}

impl<C: Channel> Blocks<'_, '_, C> {
    /// Sets the rays through a point of each dot of a tile, `off` from its middle.
    fn rays(
        &self,
        tile: &Tile,
        off: [f64; 2],
        eye: DVec3,
        shading: &mut TileShading<C>,
        meter: &mut Meter<impl Probe>,
    ) {
        meter.at(Stage::Ray);
        shading.start(blocks(tile).count());
        let [left, top] = tile.corner;
        for (number, Block { corner: [i, j], size }) in blocks(tile) {
            let block = Block { corner: [left + i, top + j], size };
            let (rays, way) = shading.sight(number);
            block.rays(self.lens, off, eye, self.way, self.engine.level(), rays);
            self.engine.approach(rays, way);
        }
    }
}
