//! A tile of the picture as seen from the eye: its blocks, whose rays are made only where they may meet
//! something, and the corners between which they run.

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x8};

use crate::math::{DVec3, LaneVector, Lanes, REGISTERS, RayPacket, Size};

use super::block::{BLOCK, Block};
use super::direction::all_settled;
use super::pinhole::PinholeCamera;
use super::tile::Tile;

/// The corners of a block.
const CORNERS: usize = 4;

/// The rays from the eye through the dots of one tile, one for each.
#[derive(Clone, Copy, Debug)]
pub struct TileCamera<'a> {
    /// The pinhole camera that they pass.
    pub pinhole: &'a PinholeCamera,
    /// The dots.
    pub tile: Tile,
    /// How far the rays pass from the middles of their dots, in dots.
    pub off: [f64; 2],
    /// Where they start, in the assembly's coordinates.
    pub eye: DVec3,
    /// How far they go at most, in the assembly's unit ([`super::settled`]).
    pub longest_path: f64,
}

impl TileCamera<'_> {
    /// How many blocks the tile has, in scan order: at most 16.
    pub fn blocks(&self) -> usize {
        let Size { width, height } = self.tile.size;
        (width.div_ceil(BLOCK) * height.div_ceil(BLOCK)) as usize
    }

    /// One of its blocks, `number` below [`TileCamera::blocks`], with its corner counted in the tile.
    pub fn block(&self, number: usize) -> Block {
        let Size { width, height } = self.tile.size;
        let [i, j] = self.place(number);
        Block { corner: [i, j], size: Size::new(BLOCK.min(width - i), BLOCK.min(height - j)) }
    }

    /// Sets a packet's rays to those of a block.
    pub fn rays(&self, number: usize, level: Level, packet: &mut RayPacket) {
        let [left, top] = self.tile.corner;
        let Block { corner: [i, j], size } = self.block(number);
        let block = Block { corner: [left + i, top + j], size };
        block.rays(self.pinhole, self.off, self.eye, self.longest_path, level, packet);
    }

    /// The directions at the corners of the whole tile: the first two are neighbours. All rays lie between
    /// them.
    pub fn ends(&self) -> [DVec3; CORNERS] {
        let Size { width, height } = self.tile.size;
        let last = |dots: u32| dots.next_multiple_of(BLOCK) - 1;
        let (x, y) = (f64::from(last(width)), f64::from(last(height)));
        let [left, top] = self.tile.corner.map(|corner| f64::from(corner) + 0.5);
        [[0.0, 0.0], [x, 0.0], [0.0, y], [x, y]].map(|[i, j]| {
            let d = self.pinhole.directions(left + i + self.off[0], top + j + self.off[1]);
            let d = all_settled(d, self.longest_path);
            DVec3::new(d.x, d.y, d.z)
        })
    }

    /// The directions at the corners of each block, which may lie beyond the picture, in the order of
    /// [`TileCamera::ends`]: by block four numbers of each column.
    pub fn corners(&self, level: Level, corners: &mut [Lanes; 3]) {
        dispatch!(level, simd => self.all_corners(simd, corners));
    }

    #[inline(always)]
    fn all_corners<S: Simd>(&self, simd: S, corners: &mut [Lanes; 3]) {
        let last = f64::from(BLOCK - 1);
        let across = f64x8::load_array(simd, [0.0, last, 0.0, last, 0.0, last, 0.0, last]);
        let down = f64x8::load_array(simd, [0.0, 0.0, last, last, 0.0, 0.0, last, last]);
        let [left, top] = self.tile.corner.map(|corner| f64::from(corner) + 0.5);
        for row in 0..REGISTERS.min(self.blocks().div_ceil(2)) {
            let [[i, j], [k, l]] = [self.place(2 * row), self.place(2 * row + 1)].map(|p| p.map(f64::from));
            let x = f64x8::load_array(simd, [i, i, i, i, k, k, k, k]) + across;
            let y = f64x8::load_array(simd, [j, j, j, j, l, l, l, l]) + down;
            let d = self.pinhole.directions(x + left + self.off[0], y + top + self.off[1]);
            corners.store(row, all_settled(d, self.longest_path));
        }
    }

    /// The corner of a block in the tile.
    fn place(&self, number: usize) -> [u32; 2] {
        let columns = self.tile.size.width.div_ceil(BLOCK);
        let number = number as u32;
        [number % columns * BLOCK, number / columns * BLOCK]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, FieldSpan};
    use crate::view::{Picture, tiles};

    #[test]
    fn blocks_hold_every_dot_of_a_tile_once_and_their_rays_lie_between_the_corners() {
        let camera = Camera {
            name: None,
            eye: DVec3::new(3.0, -5.0, 1.0),
            target: DVec3::ZERO,
            up: DVec3::Z,
            field: [40.0, 25.0],
            span: FieldSpan::Edges,
            zoom: 1.0,
        };
        let dots = Size::new(75, 43);
        let pinhole = PinholeCamera::new(&camera, &Picture { dots, dot_aspect: 1.0 });
        for tile in tiles(dots) {
            let sight =
                TileCamera { pinhole: &pinhole, tile, off: [0.2, -0.3], eye: camera.eye, longest_path: 10.0 };
            let mut corners = [Lanes::filled(0.0); 3];
            sight.corners(Level::new(), &mut corners);
            let mut packet = RayPacket::EMPTY;
            let mut seen = vec![0; tile.size.area()];
            let on_screen = |d: DVec3| {
                let depth = d.dot(pinhole.forward);
                [d.dot(pinhole.right) / depth, -d.dot(pinhole.up) / depth]
            };
            let ends = sight.ends().map(on_screen);
            for k in 0..sight.blocks() {
                sight.block(k).rows(&tile, |_, dots| dots.for_each(|dot| seen[dot] += 1));
                sight.rays(k, Level::new(), &mut packet);
                let own: [_; CORNERS] = std::array::from_fn(|c| on_screen(corners.get(CORNERS * k + c)));
                for lane in crate::math::lanes(packet.live) {
                    let at = on_screen(packet.d.get(lane));
                    for axis in 0..2 {
                        for corners in [&ends, &own] {
                            let (from, to) = (corners[0][axis] - 1e-15, corners[3][axis] + 1e-15);
                            assert!(from <= at[axis] && at[axis] <= to, "{tile:?} {k} {lane}");
                        }
                    }
                }
                if packet.live == u64::MAX {
                    let whole = [0, 7, 56, 63].map(|lane| packet.d.get(lane));
                    let own: [_; CORNERS] = std::array::from_fn(|c| corners.get(CORNERS * k + c));
                    for (a, b) in whole.into_iter().zip(own) {
                        assert!((a - b).length() < 1e-15);
                    }
                }
            }
            assert!(seen.iter().all(|&n| n == 1));
        }
    }
}
