//! The rays of a packet in single precision: which of them certainly miss a ball, a box or a bar, sixteen at
//! a time.
//!
//! Most rays of a packet that are tested against a small solid miss it. Single precision sorts these out,
//! with a bound on what it loses, and only the others are intersected in the precision of the packet.

use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16};

use crate::lattice::{BoundingSphere, ROOM};
use crate::math::{DVec3, PACKET, ROW, ROWS, RayPacket, lanes, row_of, splats};
use crate::solid::Bar;

/// Half an ulp of a number near 1.
const HALF_ULP: f64 = 1.0 / 16_777_216.0;

/// What may be lost of the distance between a ray and a point, as a share of the distance from the packet's
/// first ray to that point and of how far the packet's rays start from each other: the start and the point
/// are rounded (2 units of 2⁻²⁴), their difference (1), the dot product and its share of the direction (each
/// three products, two sums and a rounded direction: 2 · 6), the product and the sum that move the start (2),
/// and the square (4) and its root (half of that): 24, rounded up to 32.
const LOST: f64 = 32.0 * HALF_ULP;

/// What may be lost of a ray's distance to a side of a box, where it is taken for the place of that side: of
/// as much as a box and a start can lie from each other, and the box's size, on one axis (2 + 2 and
/// [`WITHIN`]), the start, the middle of the box and half its size are rounded (3), the difference of the
/// first two (1), the direction, its inverse and the products with it (2 · 3), and the sum of the products
/// (1): 11, rounded up to 16.
const LOST_OF_SIDE: f64 = 16.0 * HALF_ULP * (4.0 + WITHIN as f64);

/// What may be lost of the product of two lines, in the same share: of the ray's moment, whose start and
/// direction are rounded (2), the products and their difference (2); of the bar's direction (1), the product
/// of both (1) and three sums (3): 9, and of the other half, with a moment that is rounded, less. Rounded up
/// to 16.
const LOST_OF_PRODUCT: f64 = 16.0 * HALF_ULP;

/// What may be lost of the square of the sine of the angle between two directions: both are rounded (2), each
/// product of the cosine and its sums are (3), its square doubles that and is rounded (11), and the
/// difference (1): 12, rounded up to 16.
const LOST_OF_SINE: f64 = 16.0 * HALF_ULP;

/// On its whole path through the world, which is no longer than 2⁴, a ray that is slower than this along an
/// axis does not move by what is lost of the place of any box: 2⁻²⁰ of a size that is more than rounding of
/// f64 is.
const STILL: f32 = 1.0 / (1_u128 << 100) as f32;

/// Rays within the world start within this; what starts elsewhere, or nowhere, is never culled.
const WITHIN: f32 = 8.0;

/// Rays of a packet, seen from the start of its first.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct PacketCuller {
    o: [[f32; PACKET]; 3],
    d: [[f32; PACKET]; 3],
    /// Where they start, seen from the origin.
    start: [[f32; PACKET]; 3],
    /// The inverse of the direction, and the moment `o × d`.
    inverse: [[f32; PACKET]; 3],
    moment: [[f32; PACKET]; 3],
    /// What lies farther along each does not matter.
    limit: [f32; PACKET],
    base: DVec3,
    /// How far the others start from there at most, added up over the axes.
    extent: f64,
    /// The rays that are never culled.
    odd: u64,
    /// Whether these are the rays of a packet, not yet forgotten; and whether what tests against balls, boxes
    /// and bars need is set.
    known: bool,
    points_known: bool,
    lines_known: bool,
    moments_known: bool,
}

/// A box as its middle and half its size, and what is lost of it.
#[derive(Clone, Copy, Debug)]
pub struct Slabs<S: Simd> {
    middle: [f32x16<S>; 3],
    half: [f32x16<S>; 3],
}

impl<S: Simd> Slabs<S> {
    /// All that is no farther from a box within the world than `slack`.
    #[inline(always)]
    pub fn around(simd: S, lo: DVec3, hi: DVec3, slack: f64) -> Self {
        let (middle, half) = (0.5 * lo + 0.5 * hi, 0.5 * hi - 0.5 * lo);
        Self { middle: splats(simd, middle), half: splats(simd, half + (slack + LOST_OF_SIDE)) }
    }
}

impl PacketCuller {
    /// No rays.
    pub const EMPTY: Self = Self {
        o: [[0.0; PACKET]; 3],
        d: [[0.0; PACKET]; 3],
        start: [[0.0; PACKET]; 3],
        inverse: [[0.0; PACKET]; 3],
        moment: [[0.0; PACKET]; 3],
        limit: [0.0; PACKET],
        base: DVec3::ZERO,
        extent: 0.0,
        odd: 0,
        known: false,
        points_known: false,
        lines_known: false,
        moments_known: false,
    };

    /// Whether they have been set since they were forgotten.
    pub fn is_known(&self) -> bool {
        self.known
    }

    /// Forgets them.
    pub fn forget(&mut self) {
        self.known = false;
    }

    /// Takes the rays of a closed packet, with no limit.
    #[inline(always)]
    pub fn set(&mut self, packet: &RayPacket) {
        self.known = true;
        (self.points_known, self.lines_known, self.moments_known) = (false, false, false);
        self.limit = [f32::INFINITY; PACKET];
        for axis in 0..3 {
            for lane in 0..PACKET {
                self.d[axis][lane] = packet.d[axis].0[lane] as f32;
            }
        }
    }

    /// Sets what tests against balls and bars need of the same rays.
    #[inline(always)]
    pub fn set_points<S: Simd>(&mut self, simd: S, packet: &RayPacket) {
        if std::mem::replace(&mut self.points_known, true) {
            return;
        }
        self.extent = 0.0;
        for axis in 0..3 {
            let base = packet.o[axis].0[0];
            self.base[axis] = base;
            for lane in 0..PACKET {
                self.o[axis][lane] = (packet.o[axis].0[lane] - base) as f32;
            }
            let mut most = f32x16::splat(simd, 0.0);
            for row in 0..ROWS {
                let o = row_of(simd, &self.o[axis], row).abs();
                most = o.simd_gt(most).select(o, most);
            }
            self.extent += f64::from(most.reduce_max());
        }
    }

    /// Sets for each lane how far away what the ray meets may be to matter, and what is lost of that.
    #[inline(always)]
    pub fn limit(&mut self, limit: impl Fn(usize) -> f64) {
        for lane in 0..PACKET {
            // Rounded twice, by half an ulp.
            self.limit[lane] = limit(lane) as f32 * (1.0 + 2.0 * f32::EPSILON);
        }
    }

    /// The limits, to be restored.
    #[inline]
    pub fn limits(&self) -> [f32; PACKET] {
        self.limit
    }

    /// Sets the limits to those that were.
    #[inline]
    pub fn restore(&mut self, limits: [f32; PACKET]) {
        self.limit = limits;
    }

    /// Sets nearer limits for some lanes, as [`PacketCuller::limit`]; those that are nearer stay.
    #[inline]
    pub fn shorten(&mut self, some: u64, limit: impl Fn(usize) -> f64) {
        for lane in lanes(some) {
            let shorter = limit(lane) as f32 * (1.0 + 2.0 * f32::EPSILON);
            self.limit[lane] = if shorter < self.limit[lane] { shorter } else { self.limit[lane] };
        }
    }

    /// Sets what tests against boxes need of the same rays.
    #[inline(always)]
    pub fn set_lines<S: Simd>(&mut self, simd: S, packet: &RayPacket) {
        if std::mem::replace(&mut self.lines_known, true) {
            return;
        }
        self.odd = 0;
        for axis in 0..3 {
            for lane in 0..PACKET {
                self.start[axis][lane] = packet.o[axis].0[lane] as f32;
            }
        }
        let (one, still) = (f32x16::splat(simd, 1.0), f32x16::splat(simd, STILL));
        let within = f32x16::splat(simd, WITHIN);
        for row in 0..ROWS {
            for axis in 0..3 {
                let (start, d) = (row_of(simd, &self.start[axis], row), row_of(simd, &self.d[axis], row));
                let plain = start.abs().simd_lt(within) & d.abs().simd_lt(within);
                self.odd |= (!plain).to_bitmask() << (row * ROW);
                let inverse = d.abs().simd_lt(still).select(one / still, one / d);
                inverse.store_slice(&mut self.inverse[axis][row * ROW..][..ROW]);
            }
        }
    }

    /// Sets what only tests against bars need of the same rays; those for balls and boxes are set.
    #[inline(always)]
    fn set_moments<S: Simd>(&mut self, simd: S, packet: &RayPacket) {
        if std::mem::replace(&mut self.moments_known, true) {
            return;
        }
        self.set_points(simd, packet);
        for row in 0..ROWS {
            let [o, d] = [
                [row_of(simd, &self.o[0], row), row_of(simd, &self.o[1], row), row_of(simd, &self.o[2], row)],
                [row_of(simd, &self.d[0], row), row_of(simd, &self.d[1], row), row_of(simd, &self.d[2], row)],
            ];
            for axis in 0..3 {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                let moment = o[next] * d[last] - o[last] * d[next];
                moment.store_slice(&mut self.moment[axis][row * ROW..][..ROW]);
            }
        }
    }

    /// Which of some rays may meet a ball between the two of `round`, ahead of their starts and within their
    /// limits: all others do not. And which certainly go into it ahead of their starts, and within their
    /// limits. The rays are [set](Self::set_points) as points.
    #[inline(always)]
    pub fn ball<S: Simd>(&self, simd: S, round: &BoundingSphere, slack: f64, wanted: u64) -> (u64, u64) {
        let from_base = wide(round.center) - self.base;
        let lost = LOST * (from_base.abs().element_sum() + self.extent);
        let (outer, inner) = (f64::from(round.outer) + lost, f64::from(round.inner) - lost);
        // The radius itself, and its square, are rounded.
        let limit = f32x16::splat(simd, (outer * outer) as f32 * (1.0 + 4.0 * f32::EPSILON));
        let deep = f32x16::splat(simd, (inner.max(0.0) * inner.max(0.0)) as f32 * (1.0 - 4.0 * f32::EPSILON));
        // How far the ends of a chord, as they are computed, may lie from its middle, as that is computed
        // here.
        let reach = f32x16::splat(simd, (outer + lost + ROOM) as f32 * (1.0 + 4.0 * f32::EPSILON));
        let early = f32x16::splat(simd, (lost + ROOM + slack) as f32 * (1.0 + 4.0 * f32::EPSILON));
        let shorter = f32x16::splat(simd, 1.0 - 8.0 * f32::EPSILON);
        let [cx, cy, cz] = splats(simd, from_base);
        let (mut near, mut inside) = (0, 0);
        for row in 0..ROWS {
            if (wanted >> (row * ROW)) as u16 == 0 {
                continue;
            }
            let x = row_of(simd, &self.o[0], row) - cx;
            let y = row_of(simd, &self.o[1], row) - cy;
            let z = row_of(simd, &self.o[2], row) - cz;
            let dx = row_of(simd, &self.d[0], row);
            let dy = row_of(simd, &self.d[1], row);
            let dz = row_of(simd, &self.d[2], row);
            let to = row_of(simd, &self.limit, row);
            let t = x * dx + y * dy + z * dz;
            let (x, y, z) = (x - t * dx, y - t * dy, z - t * dz);
            let square = x * x + y * y + z * z;
            // What is not a number is neither certainly missed nor certainly met.
            let missed = square.simd_gt(limit) | t.simd_gt(reach) | (-t - reach).simd_gt(to);
            let met = square.simd_lt(deep) & (-t).simd_gt(reach) & (early - t).simd_lt(to * shorter);
            near |= (!missed).to_bitmask() << (row * ROW);
            inside |= met.to_bitmask() << (row * ROW);
        }
        (near & wanted, inside & wanted)
    }

    /// Those of some rays that may pass a box, ahead of their starts and within their limits; all others do
    /// not. As for all that follows, the rays are [set](Self::set_lines) as lines too.
    #[inline(always)]
    pub fn passing<S: Simd>(&self, simd: S, slabs: &Slabs<S>, wanted: u64) -> u64 {
        let mut rays = 0;
        for row in 0..ROWS {
            if (wanted >> (row * ROW)) as u16 != 0 {
                let (near, end) = self.through(simd, slabs, row);
                rays |= (!near.simd_gt(end)).to_bitmask() << (row * ROW);
            }
        }
        (rays | self.odd) & wanted
    }

    /// Between which distances some rays pass a box, all of them, within their limits.
    #[inline(always)]
    pub fn range<S: Simd>(&self, simd: S, slabs: &Slabs<S>, passing: u64) -> (f64, f64) {
        if self.odd & passing != 0 {
            return (0.0, f64::INFINITY);
        }
        let (mut from, mut to) = (f32x16::splat(simd, f32::INFINITY), f32x16::splat(simd, 0.0));
        for row in 0..ROWS {
            let (near, end) = self.through(simd, slabs, row);
            let beside = near.simd_gt(end);
            (from, to) = (from.min(beside.select(from, near)), to.max(beside.select(to, end)));
        }
        (f64::from(from.reduce_min()), f64::from(to.reduce_max()))
    }

    /// Where the rays of a row enter a box, and where they leave it or reach their limits: the second before
    /// the first where they miss it. Of rays that are odd that means nothing.
    #[inline(always)]
    fn through<S: Simd>(
        &self,
        simd: S,
        Slabs { middle, half }: &Slabs<S>,
        row: usize,
    ) -> (f32x16<S>, f32x16<S>) {
        let (mut near, mut end) = (f32x16::splat(simd, 0.0), row_of(simd, &self.limit, row));
        for axis in 0..3 {
            let inverse = row_of(simd, &self.inverse[axis], row);
            let t = (middle[axis] - row_of(simd, &self.start[axis], row)) * inverse;
            let half = half[axis] * inverse.abs();
            (near, end) = (near.max(t - half), end.min(t + half));
        }
        (near, end)
    }

    /// Those of some rays whose lines may come within a bar's radius of its axis, be it as long as it will;
    /// all others do not.
    #[inline(always)]
    pub fn beside<S: Simd>(
        &mut self,
        simd: S,
        packet: &RayPacket,
        bar: &Bar,
        slack: f64,
        wanted: u64,
    ) -> u64 {
        self.set_moments(simd, packet);
        let (from_base, along, radius) = (bar.middle - self.base, bar.along, bar.radius + slack);
        // The product of two lines, by their moments, is their distance times the sine of the angle between
        // them.
        let moment = along.cross(from_base);
        let lost = LOST_OF_PRODUCT * (from_base.abs().element_sum() + self.extent);
        let square = radius * radius;
        let least = LOST_OF_SINE * square + (2.0 * radius + lost) * lost;
        let up = 1.0 + 8.0 * f32::EPSILON;
        let (square, least) =
            (f32x16::splat(simd, square as f32 * up), f32x16::splat(simd, least as f32 * up));
        let ([ax, ay, az], [mx, my, mz]) = (splats(simd, along), splats(simd, moment));
        let mut rays = 0;
        for row in 0..ROWS {
            if (wanted >> (row * ROW)) as u16 == 0 {
                continue;
            }
            let dx = row_of(simd, &self.d[0], row);
            let dy = row_of(simd, &self.d[1], row);
            let dz = row_of(simd, &self.d[2], row);
            let cosine = ax * dx + ay * dy + az * dz;
            let product = (row_of(simd, &self.moment[0], row) * ax - mx * dx)
                + (row_of(simd, &self.moment[1], row) * ay - my * dy)
                + (row_of(simd, &self.moment[2], row) * az - mz * dz);
            let sine = f32x16::splat(simd, 1.0) - cosine * cosine;
            let beside = (product * product).simd_gt(square * sine + least);
            rays |= (!beside).to_bitmask() << (row * ROW);
        }
        (rays | self.odd) & wanted
    }
}

/// A corner of a box in double precision.
#[inline(always)]
pub fn wide([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), f64::from(z))
}

#[cfg(test)]
mod tests;
