//! The planes across the rays of a packet: what [`super::ray_shear`] decides for one ray, for eight at a
//! time.
//!
//! The same places and the same areas are computed in the same order. Where rounding could have made the sign
//! of an area there is no answer: that ray is to be asked alone, of the exact predicate.

use fearless_simd::{Simd, SimdMask, f64x8, mask64x8};

use crate::math::{Bounds, DVec3, LANES, Lanes, Mask, Number, REGISTERS, RayPacket};

use super::ray_shear::ROUNDED;

/// The planes across the rays of a packet: two axes of the world, sheared along each ray.
#[derive(Clone, Debug)]
pub struct PacketShear {
    /// By axis, which of the rays go farthest along it: one bit for each ray, in one of the three.
    main: [u64; 3],
    /// How far each goes along the next two axes for a step along its main one.
    shear: [Lanes; 2],
}

/// The planes across the rays of a register that go farthest along axis `MAIN`.
pub(super) struct Row<S: Simd, const MAIN: usize> {
    /// Where they start: along the main axis, and the next two.
    o: [f64x8<S>; 3],
    shear: [f64x8<S>; 2],
}

/// How an outline lies around the rays of a register.
#[derive(Clone, Copy)]
pub(super) struct Around<S: Simd> {
    /// Which rays it goes around an odd number of times.
    pub odd: mask64x8<S>,
    /// Which are to be asked one by one.
    pub uncertain: mask64x8<S>,
}

impl PacketShear {
    /// Of a packet that was not looked at yet.
    pub const UNKNOWN: Self = Self { main: [0; 3], shear: [Lanes::filled(0.0), Lanes::filled(0.0)] };

    /// Another packet follows.
    pub fn forget(&mut self) {
        self.main = [0; 3];
    }

    /// Computes them, where that was not done before.
    #[inline(always)]
    pub(super) fn know<S: Simd>(&mut self, simd: S, packet: &RayPacket) {
        if self.main != [0; 3] {
            return;
        }
        for register in 0..REGISTERS {
            let d = packet.load(simd, register).d;
            let size = d.magnitude();
            // The same axis of several that are equally long as for one ray.
            let x = size.x.is_at_least(size.y) & size.x.is_at_least(size.z);
            let y = !x & size.y.is_at_least(size.z);
            let z = !x & !y;
            for (main, mask) in [x, y, z].into_iter().enumerate() {
                self.main[main] |= mask.bits() << (register * LANES);
            }
            let main = x.choose(d.x, y.choose(d.y, d.z));
            self.shear[0].store(register, x.choose(d.y, y.choose(d.z, d.x)) / main);
            self.shear[1].store(register, x.choose(d.z, y.choose(d.x, d.y)) / main);
        }
    }

    /// Which rays go farthest along an axis.
    #[inline(always)]
    pub(super) fn main(&self, axis: usize) -> u64 {
        self.main[axis]
    }

    /// One register of them; those of the packet's rays that go farthest along another axis mean nothing.
    #[inline(always)]
    pub(super) fn load<S: Simd, const MAIN: usize>(
        &self,
        simd: S,
        packet: &RayPacket,
        register: usize,
    ) -> Row<S, MAIN> {
        let [main, first, second] = [&packet.o[MAIN], &packet.o[(MAIN + 1) % 3], &packet.o[(MAIN + 2) % 3]];
        Row {
            o: [main.load(simd, register), first.load(simd, register), second.load(simd, register)],
            shear: [self.shear[0].load(simd, register), self.shear[1].load(simd, register)],
        }
    }
}

impl<S: Simd, const MAIN: usize> Row<S, MAIN> {
    /// The places of a point in the planes.
    #[inline(always)]
    fn place(&self, p: DVec3) -> [f64x8<S>; 2] {
        let [x, y, _] = self.sheared(p);
        [x, y]
    }

    /// The places of a point in the planes, and how far it lies from the starts along the main axis.
    #[inline(always)]
    pub fn sheared(&self, p: DVec3) -> [f64x8<S>; 3] {
        let p = p.to_array();
        let along = -self.o[0] + p[MAIN];
        let x = (-self.o[1] + p[(MAIN + 1) % 3]) - self.shear[0] * along;
        let y = (-self.o[2] + p[(MAIN + 2) % 3]) - self.shear[1] * along;
        [x, y, along]
    }

    /// Adds a stretch of an outline: `RayShear::crosses_odd` for eight.
    #[inline(always)]
    pub fn add(&self, around: &mut Around<S>, corners: &[DVec3]) {
        let Some((first, rest)) = corners.split_first() else { return };
        let zero = self.o[0].same(0.0);
        let mut p = self.place(*first);
        let mut p_above = p[1].is_above(zero);
        for corner in rest {
            let q = self.place(*corner);
            let q_above = q[1].is_above(zero);
            let crosses = p_above ^ q_above;
            if crosses.any_true() {
                let (left, right) = (p[0] * q[1], p[1] * q[0]);
                let area = left - right;
                let bound = (left + right).magnitude() * ROUNDED;
                // From above to below it is the area's negative that has to be above 0.
                around.odd ^= crosses & (area.is_above(zero) ^ p_above);
                around.uncertain |= crosses & !area.magnitude().is_above(bound);
            }
            (p, p_above) = (q, q_above);
        }
    }

    /// Whether edges between points of a box can lie to the right of any of the lines: `RayShear::may_cross`
    /// for eight.
    #[inline(always)]
    pub fn may_cross(&self, b: &Bounds) -> bool {
        let (lo, hi) = (b.lo.to_array(), b.hi.to_array());
        let shear = self.shear[1];
        let along = [(-self.o[0] + lo[MAIN]) * shear, (-self.o[0] + hi[MAIN]) * shear];
        let least = (-self.o[2] + lo[(MAIN + 2) % 3]) - along[0].larger(along[1]);
        let most = (-self.o[2] + hi[(MAIN + 2) % 3]) - along[0].smaller(along[1]);
        let zero = least.same(0.0);
        (least.is_at_most(zero) & most.is_above(zero)).any()
    }
}

impl<S: Simd> Around<S> {
    /// Of no outline yet.
    #[inline(always)]
    pub fn nothing(simd: S) -> Self {
        let no = mask64x8::splat(simd, false);
        Self { odd: no, uncertain: no }
    }
}
