//! What every walk of a tile does.

use fearless_simd::Simd;

use crate::lattice::{Child, FrustumHits, FrustumSoa, Node};
use crate::math::{Bounds, DVec3, Mask, Number, RayPacket, Rays, Real, SimdRegister};
use crate::solid::WorldShape;

use super::packet_culler::{PacketCuller, Slabs};

/// A node that is to be walked.
#[derive(Clone, Copy, Debug)]
pub struct Waits {
    /// How near it is at least.
    pub near: f64,
    /// Its index.
    pub node: u32,
    /// Which frustums may meet it, a bit for each.
    pub frustums: u16,
}

impl Waits {
    /// The root, for these frustums.
    pub fn root(frustums: u16) -> Self {
        Self { near: f64::NEG_INFINITY, node: 0, frustums }
    }
}

/// Puts the nodes among a node's children that were met, and that some of the frustums may meet, on the stack, the nearest
/// last.
#[inline(always)]
pub fn push_nearest_last<S: Simd>(
    simd: S,
    stack: &mut Vec<Waits>,
    node: &Node,
    met: &FrustumHits<S>,
    (frusta, frustums): (&FrustumSoa, u16),
) {
    let first = stack.len();
    let mut left = met.boxes & node.inner();
    while left != 0 {
        let slot = left.trailing_zeros() as usize;
        left &= left - 1;
        let Some(Child::Node(index)) = node.child(slot) else { continue };
        let (lo, hi) = node.corners(slot);
        let frustums = frusta.meets(simd, lo, hi).frustums & frustums;
        if frustums == 0 {
            continue;
        }
        let near = f64::from(met.near[slot]);
        let mut place = stack.len();
        stack.push(Waits { near, node: index, frustums });
        while place > first && stack[place - 1].near < near {
            stack.swap(place - 1, place);
            place -= 1;
        }
    }
}

/// Those of some rays of a packet that may meet a surface, as far as its own form says.
pub fn asking<S: Simd>(
    simd: S,
    thin: &mut PacketCuller,
    packet: &RayPacket,
    form: &WorldShape,
    slack: f64,
    wanted: u64,
) -> u64 {
    let WorldShape::Tube(tube) = form else { return wanted };
    simd.vectorize(
        #[inline(always)]
        || thin.beside(simd, packet, &tube.bar(), slack, wanted),
    )
}

/// Between which distances some rays of a packet pass a box, all of them.
pub fn reach<S: Simd>(simd: S, thin: &PacketCuller, b: &Bounds, slack: f64, passing: u64) -> (f64, f64) {
    simd.vectorize(
        #[inline(always)]
        || thin.reach(simd, &Slabs::around(simd, b.lo, b.hi, slack), passing),
    )
}

/// The box around the way of some rays of a packet between two distances.
pub fn bounds_between<S: Simd, T: Real>(
    simd: S,
    packet: &RayPacket<T>,
    rays: u64,
    from: f64,
    to: f64,
) -> Bounds {
    simd.vectorize(
        #[inline(always)]
        || {
            let infinite = T::all(simd, f64::INFINITY);
            let (mut lo, mut hi) = ([infinite; 3], [-infinite; 3]);
            for row in 0..T::ROWS {
                if !T::has_any(rays, row) {
                    continue;
                }
                let asks = T::row_of(simd, rays, row);
                let Rays { o, d } = packet.load(simd, row);
                for axis in 0..3 {
                    let (o, d) = (o.along(axis), d.along(axis));
                    // The end may be no number, where that is infinitely far and the ray does not move: then it is the start.
                    let (start, end) = (o + d * from, o + d * to);
                    lo[axis] = asks.choose(end.smaller(start).smaller(lo[axis]), lo[axis]);
                    hi[axis] = asks.choose(end.larger(start).larger(hi[axis]), hi[axis]);
                }
            }
            let (lo, hi) = (
                [lo[0].least(), lo[1].least(), lo[2].least()],
                [hi[0].greatest(), hi[1].greatest(), hi[2].greatest()],
            );
            Bounds::new(DVec3::from_array(lo), DVec3::from_array(hi))
        },
    )
}

/// A corner of a box in double precision.
#[inline(always)]
pub fn wide([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), f64::from(z))
}
