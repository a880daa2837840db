//! The rays of a packet as cells are cut out of them, and the way through the cells that is left.

use fearless_simd::Simd;

use crate::lattice::CellLine;
use crate::math::{Bounds, LaneVector, Lanes, Number, RayPacket, Real, Vector};
use crate::solid::PacketRange;

/// What is to be walked: a node, or a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellItem {
    /// How near it is at least.
    pub near: f32,
    /// Among the nodes, or among the cells.
    pub number: u32,
    pub is_cell: bool,
}

/// Rays as cells are cut out of them, and their parts in one.
#[derive(Debug)]
pub(super) struct CellRays<T> {
    inverse: [Lanes<T>; 3],
    is_known: bool,
    pub reach: PacketRange<T>,
}

/// What is cut out of rays: what lies in a box, and not before `start`, and so much before and behind that.
pub(super) struct Clip<'a> {
    pub b: &'a Bounds,
    pub start: f64,
    pub slack: f64,
}

impl<T: Real> Default for CellRays<T> {
    fn default() -> Self {
        Self { inverse: [Lanes::filled(T::ZERO); 3], is_known: false, reach: PacketRange::NONE }
    }
}

impl<T: Real> CellRays<T> {
    /// Other rays follow.
    pub fn start(&mut self) {
        self.is_known = false;
    }

    /// Sets the parts of some rays of a packet; answers which rays have one.
    #[inline(always)]
    pub fn clip<S: Simd>(&mut self, simd: S, packet: &RayPacket<T>, wanted: u64, clip: &Clip) -> u64 {
        let Clip { b, start, slack } = *clip;
        let start = T::all(simd, start);
        if !std::mem::replace(&mut self.is_known, true) {
            for row in 0..T::REGISTERS {
                let line = CellLine::new(&packet.load(simd, row), T::GREATEST);
                self.inverse.store(row, line.inverse);
            }
        }
        let mut within = 0;
        for row in 0..T::REGISTERS {
            if !T::has_any(wanted, row) {
                continue;
            }
            let (o, inverse): (Vector<T::SimdReal<S>>, _) =
                (packet.o.load(simd, row), self.inverse.load(simd, row));
            let (from, to) = CellLine { o, inverse }.range(b);
            let from = from.larger(start);
            within |= T::bits_of(simd, from.is_at_most(to), row);
            self.reach.from.store(row, from - slack);
            self.reach.to.store(row, to + slack);
        }
        within & wanted
    }
}
