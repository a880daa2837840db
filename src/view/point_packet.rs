//! Points anywhere in a tile, as many as a packet has rays.

use crate::math::{Lanes, PACKET};

/// Up to [`PACKET`] points of the picture through which rays pass, in dots from its upper left corner.
#[derive(Clone, Debug)]
pub struct PointPacket {
    /// Those past the last repeat the first.
    pub(super) x: Lanes,
    pub(super) y: Lanes,
    count: usize,
    /// The whole dots between which they lie: left, top, right, bottom.
    pub(super) bounds: [f64; 4],
}

impl PointPacket {
    /// Those of some points, 1 to [`PACKET`].
    pub fn new(points: &[[f64; 2]]) -> Self {
        let [first_x, first_y] = points[0];
        let mut packet = Self {
            x: Lanes::filled(first_x),
            y: Lanes::filled(first_y),
            count: points.len().min(PACKET),
            bounds: [first_x, first_y, first_x, first_y],
        };
        for (lane, [x, y]) in points.iter().take(PACKET).enumerate() {
            (packet.x.0[lane], packet.y.0[lane]) = (*x, *y);
            let [left, top, right, bottom] = packet.bounds;
            packet.bounds = [left.min(*x), top.min(*y), right.max(*x), bottom.max(*y)];
        }
        let [left, top, right, bottom] = packet.bounds;
        // At least a dot wide and high: a frustum between its corners has sides.
        let (left, top) = (left.floor(), top.floor());
        packet.bounds = [left, top, right.ceil().max(left + 1.0), bottom.ceil().max(top + 1.0)];
        packet
    }

    /// How many, 1 to [`PACKET`].
    pub fn count(&self) -> usize {
        self.count
    }

    /// Which rays of its packet are there, the first the lowest bit.
    pub fn live(&self) -> u64 {
        u64::MAX >> (PACKET - self.count)
    }

    /// They, in order.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.x.0.into_iter().zip(self.y.0).map(|(x, y)| [x, y]).take(self.count)
    }
}
