//! A tile of the picture as seen from the eye: its packets of rays, which are made only where they may meet
//! something, and the corners between which they run.

use fearless_simd::{Level, Simd, SimdBase, f64x8};

use std::ops::Range;

use crate::math::{DVec3, LANES, LaneVector, Lanes, PACKET, REGISTERS, RayPacket, Size, dispatch};

use super::block::{BLOCK, Block};
use super::direction::all_settled;
use super::pinhole::PinholeCamera;
use super::point_packet::PointPacket;
use super::tile::Tile;

/// The corners between which the rays of a packet run.
const CORNERS: usize = 4;

/// Where in a tile its rays pass.
#[derive(Clone, Copy, Debug)]
pub enum TileRays<'a> {
    /// One through each dot, so far from its middle, in dots. A packet is a block of 8 × 8 dots.
    EachDot([f64; 2]),
    /// Through points of its dots, in packets of which all but the last are full: 16 at most.
    Points(&'a [PointPacket]),
}

/// The rays from the eye through one tile.
#[derive(Clone, Copy, Debug)]
pub struct TileCamera<'a> {
    /// The pinhole camera that they pass.
    pub pinhole: &'a PinholeCamera,
    /// The dots.
    pub tile: Tile,
    /// Where the rays pass.
    pub rays: TileRays<'a>,
    /// Where they start, in the assembly's coordinates.
    pub eye: DVec3,
    /// How far they go at most, in the assembly's unit ([`super::settled`]).
    pub longest_path: f64,
}

impl TileCamera<'_> {
    /// How many packets its rays make, at most 16.
    pub fn packets(&self) -> usize {
        match self.rays {
            TileRays::EachDot(_) => {
                let Size { width, height } = self.tile.size;
                (width.div_ceil(BLOCK) * height.div_ceil(BLOCK)) as usize
            }
            TileRays::Points(packets) => packets.len(),
        }
    }

    /// How many rays there are.
    pub fn count(&self) -> usize {
        match self.rays {
            TileRays::EachDot(_) => self.tile.size.area(),
            TileRays::Points(packets) => packets.iter().map(PointPacket::count).sum(),
        }
    }

    /// Which rays of a packet are there, a bit for each. `number` is below [`TileCamera::packets`], here and
    /// in what follows.
    pub fn live(&self, number: usize) -> u64 {
        match self.rays {
            TileRays::EachDot(_) => self.block(number).live(),
            TileRays::Points(packets) => packets[number].live(),
        }
    }

    /// Calls `each` with every row of eight rays of a packet and their places in the order of all rays, which
    /// is the scan order of dots where each dot has one.
    #[inline]
    pub fn rows(&self, number: usize, mut each: impl FnMut(usize, Range<usize>)) {
        match self.rays {
            TileRays::EachDot(_) => self.block(number).rows(&self.tile, each),
            TileRays::Points(packets) => {
                let first = number * PACKET;
                let end = first + packets[number].count();
                for (row, start) in (first..end).step_by(LANES).enumerate() {
                    each(row, start..(start + LANES).min(end));
                }
            }
        }
    }

    /// The points through which its rays pass, in the order of all rays, in dots from the picture's corner.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        let (dots, packets) = match self.rays {
            TileRays::EachDot(offset) => (Some(offset), &[][..]),
            TileRays::Points(packets) => (None, packets),
        };
        let of_dots = dots.into_iter().flat_map(|[across, down]| {
            let point = move |(i, j)| [f64::from(i) + 0.5 + across, f64::from(j) + 0.5 + down];
            self.tile.dots().map(point)
        });
        of_dots.chain(packets.iter().flat_map(PointPacket::points))
    }

    /// One of the blocks of a tile with a ray for each dot, with its corner counted in the tile.
    fn block(&self, number: usize) -> Block {
        let Size { width, height } = self.tile.size;
        let [i, j] = self.place(number);
        Block { corner: [i, j], size: Size::new(BLOCK.min(width - i), BLOCK.min(height - j)) }
    }

    /// Sets a packet's rays.
    pub fn rays(&self, number: usize, level: Level, packet: &mut RayPacket) {
        match self.rays {
            TileRays::EachDot(offset) => {
                let [left, top] = self.tile.corner;
                let Block { corner: [i, j], size } = self.block(number);
                let block = Block { corner: [left + i, top + j], size };
                block.rays(self.pinhole, offset, self.eye, self.longest_path, level, packet);
            }
            TileRays::Points(packets) => {
                let points = &packets[number];
                packet.live = points.live();
                dispatch!(level, simd => self.fill(simd, points, packet));
            }
        }
    }

    #[inline(always)]
    fn fill<S: Simd>(&self, simd: S, points: &PointPacket, packet: &mut RayPacket) {
        for row in 0..REGISTERS {
            let d = self.pinhole.directions(points.x.load(simd, row), points.y.load(simd, row));
            packet.o.store(row, d.same(self.eye));
            packet.d.store(row, all_settled(d, self.longest_path));
        }
        packet.close(simd);
    }

    /// The directions at the corners of a rectangle around all rays: the first two are neighbours.
    pub fn ends(&self) -> [DVec3; CORNERS] {
        let [left, top, right, bottom] = match self.rays {
            TileRays::EachDot([across, down]) => {
                let Size { width, height } = self.tile.size;
                let last = |dots: u32| f64::from(dots.next_multiple_of(BLOCK) - 1);
                let [left, top] = self.tile.corner.map(|corner| f64::from(corner) + 0.5);
                let (left, top) = (left + across, top + down);
                [left, top, left + last(width), top + last(height)]
            }
            TileRays::Points(packets) => {
                let nothing = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
                packets.iter().fold(nothing, |all, packet| {
                    let [left, top, right, bottom] = packet.bounds;
                    [all[0].min(left), all[1].min(top), all[2].max(right), all[3].max(bottom)]
                })
            }
        };
        [[left, top], [right, top], [left, bottom], [right, bottom]].map(|[x, y]| {
            let d = all_settled(self.pinhole.directions(x, y), self.longest_path);
            DVec3::new(d.x, d.y, d.z)
        })
    }

    /// The directions at the corners of a rectangle around the rays of each packet, which may lie beyond the
    /// picture, in the order of [`TileCamera::ends`]: by packet four numbers of each column.
    pub fn corners(&self, level: Level, corners: &mut [Lanes; 3]) {
        dispatch!(level, simd => self.all_corners(simd, corners));
    }

    #[inline(always)]
    fn all_corners<S: Simd>(&self, simd: S, corners: &mut [Lanes; 3]) {
        let rows = REGISTERS.min(self.packets().div_ceil(2));
        match self.rays {
            TileRays::EachDot([across, down]) => {
                let last = f64::from(BLOCK - 1);
                let right = f64x8::load_array(simd, [0.0, last, 0.0, last, 0.0, last, 0.0, last]);
                let below = f64x8::load_array(simd, [0.0, 0.0, last, last, 0.0, 0.0, last, last]);
                let [left, top] = self.tile.corner.map(|corner| f64::from(corner) + 0.5);
                for row in 0..rows {
                    let [[i, j], [k, l]] =
                        [self.place(2 * row), self.place(2 * row + 1)].map(|p| p.map(f64::from));
                    let x = f64x8::load_array(simd, [i, i, i, i, k, k, k, k]) + right;
                    let y = f64x8::load_array(simd, [j, j, j, j, l, l, l, l]) + below;
                    let d = self.pinhole.directions(x + left + across, y + top + down);
                    corners.store(row, all_settled(d, self.longest_path));
                }
            }
            TileRays::Points(packets) => {
                for row in 0..rows {
                    let [left, top, right, bottom] = packets[2 * row].bounds;
                    // Of the last, if it has no other beside it, the same twice.
                    let [west, north, east, south] = packets[(2 * row + 1).min(packets.len() - 1)].bounds;
                    let x = f64x8::load_array(simd, [left, right, left, right, west, east, west, east]);
                    let y = f64x8::load_array(simd, [top, top, bottom, bottom, north, north, south, south]);
                    let d = self.pinhole.directions(x, y);
                    corners.store(row, all_settled(d, self.longest_path));
                }
            }
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
    use crate::view::{Picture, PinholeCamera, tiles};

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
            let sight = TileCamera {
                pinhole: &pinhole,
                tile,
                rays: TileRays::EachDot([0.2, -0.3]),
                eye: camera.eye,
                longest_path: 10.0,
            };
            let mut corners = [Lanes::filled(0.0); 3];
            sight.corners(Level::new(), &mut corners);
            let mut packet = RayPacket::EMPTY;
            let mut seen = vec![0; tile.size.area()];
            let on_screen = |d: DVec3| {
                let depth = d.dot(pinhole.forward);
                [d.dot(pinhole.right) / depth, -d.dot(pinhole.up) / depth]
            };
            let ends = sight.ends().map(on_screen);
            for k in 0..sight.packets() {
                sight.rows(k, |_, dots| dots.for_each(|dot| seen[dot] += 1));
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
