//! The surfaces that a packet met: what [`super::SurfaceInteraction`] is of one ray, eight at a time.

use fearless_simd::{Level, Simd, SimdBase, f64x8};

use crate::math::{
    DVec3, LANES, LaneVector, Lanes, Mask, Number, REGISTERS, RayPacket, Vector, dispatch, mask_of,
};
use crate::solid::{Assembly, Departures, WorldShape};
use crate::trace::PacketHits;

/// The surfaces that a packet met.
#[derive(Clone, Debug)]
pub(crate) struct Surfaces {
    /// Which rays met one that is to be shaded.
    pub hits: u64,
    /// Where.
    pub p: [Lanes; 3],
    /// The normals, turned to the sides that the rays come from, of length 1.
    pub normal: [Lanes; 3],
    /// The path lengths from the eye, in the assembly's unit.
    pub path_length: Lanes,
    /// Which of the surfaces are patches: their normals and departures are still to be found.
    pub patches: u64,
    /// The materials, by their numbers, each with the rays that met it.
    pub materials: Vec<(u32, u64)>,
}

impl Surfaces {
    pub const NONE: Self = Self {
        hits: 0,
        p: [Lanes::filled(0.0); 3],
        normal: [Lanes::filled(0.0); 3],
        path_length: Lanes::filled(0.0),
        patches: 0,
        materials: Vec::new(),
    };

    /// Marks all rays as having missed.
    pub fn forget(&mut self) {
        (self.hits, self.patches) = (0, 0);
        self.materials.clear();
    }

    /// Sets the points at which rays met something, and their path lengths. `before` is the path length from
    /// the eye to where each ray starts, in two parts, the second to be added first.
    pub fn set_points(
        &mut self,
        packet: &RayPacket,
        before: &[Lanes; 2],
        nearest: &PacketHits,
        level: Level,
    ) {
        dispatch!(level, simd => self.set_all_points(simd, packet, before, nearest));
        self.hits &= packet.live & !nearest.uncertain;
    }

    #[inline(always)]
    fn set_all_points<S: Simd>(
        &mut self,
        simd: S,
        packet: &RayPacket,
        before: &[Lanes; 2],
        nearest: &PacketHits,
    ) {
        self.hits = 0;
        for register in 0..REGISTERS {
            let t = nearest.t.load(simd, register);
            let met = t.is_below(t.same(f64::INFINITY));
            self.hits |= met.bits() << (register * LANES);
            self.p.store(register, packet.load(simd, register).at(t));
            self.path_length
                .store(register, before[0].load(simd, register) + (before[1].load(simd, register) + t));
        }
    }

    /// Finds materials and normals of the surfaces that were hit. Sets `departures` for rays that leave them
    /// to the sides that these came from.
    pub fn resolve(
        &mut self,
        packet: &RayPacket,
        nearest: &PacketHits,
        assembly: &Assembly,
        departures: &mut Departures,
        level: Level,
    ) {
        self.materials.clear();
        self.patches = 0;
        if self.hits != 0 {
            dispatch!(level, simd => self.resolve_all(simd, nearest, assembly, departures));
            departures.inward = dispatch!(level, simd => self.turned(simd, packet));
        }
    }

    #[inline(always)]
    fn resolve_all<S: Simd>(
        &mut self,
        simd: S,
        nearest: &PacketHits,
        assembly: &Assembly,
        departures: &mut Departures,
    ) {
        (departures.primitive, departures.surface) = (nearest.primitive, nearest.surface);
        let mut rest = self.hits;
        while rest != 0 {
            // Neighbours mostly meet the same face: all that do are looked at together.
            let lane = rest.trailing_zeros() as usize;
            let (primitive, surface) = (nearest.primitive.0[lane], nearest.surface.0[lane]);
            let own = &assembly.primitives[primitive as usize];
            let mut group = rest & nearest.primitive.rays_of(simd, primitive);
            // A mesh may have so many that each ray meets its own; of Bézier patches each place is one.
            if !matches!(own.form, WorldShape::Mesh(_) | WorldShape::Bezier(_)) {
                group &= nearest.surface.rays_of(simd, surface);
            }
            rest &= !group;
            self.made_of(own.material.0, group);
            let place_error = f64x8::splat(simd, own.form.place_error());
            for register in lane / LANES..REGISTERS {
                departures.place_error.put(simd, register, mask_of(simd, group, register), place_error);
            }
            match &own.form {
                WorldShape::Ball(ball) => self.face(
                    simd,
                    group,
                    #[inline(always)]
                    |p| ball.normals(p),
                ),
                WorldShape::Quadric(quadric) => self.face(
                    simd,
                    group,
                    #[inline(always)]
                    |p| quadric.normals(p, surface),
                ),
                WorldShape::Tube(tube) => self.face(
                    simd,
                    group,
                    #[inline(always)]
                    |p| tube.normals(p),
                ),
                WorldShape::Patch(_) => self.patches |= group,
                WorldShape::Mesh(mesh) => {
                    for register in lane / LANES..REGISTERS {
                        let some = group >> (register * LANES) & 0xFF;
                        if some != 0 {
                            let normal = mesh.normals_of(simd, some, register, &nearest.surface);
                            let others = self.normal.load(simd, register);
                            let own = mask_of(simd, group, register);
                            self.normal.store(register, Vector::choose(own, normal, others));
                        }
                    }
                }
                WorldShape::Bezier(patches) => {
                    for register in lane / LANES..REGISTERS {
                        let some = group >> (register * LANES) & 0xFF;
                        if some != 0 {
                            let surfaces = &nearest.surface.0[register * LANES..][..LANES];
                            let p = self.p.load(simd, register);
                            let normal = patches.normals_of(simd, some, surfaces, p);
                            let others = self.normal.load(simd, register);
                            let own = mask_of(simd, group, register);
                            self.normal.store(register, Vector::choose(own, normal, others));
                        }
                    }
                }
                flat => {
                    let normal = flat.normal(DVec3::ZERO, surface);
                    self.face(
                        simd,
                        group,
                        #[inline(always)]
                        |p| p.same(normal),
                    );
                }
            }
        }
    }

    /// Adds the rays of `group` to those that met a material.
    #[inline(always)]
    fn made_of(&mut self, material: u32, group: u64) {
        match self.materials.iter_mut().find(|(known, _)| *known == material) {
            Some((_, rays)) => *rays |= group,
            None => self.materials.push((material, group)),
        }
    }

    /// Sets the normals of the rays of `group`, which met one face.
    #[inline(always)]
    fn face<S: Simd>(&mut self, simd: S, group: u64, normals: impl Fn(Vector<f64x8<S>>) -> Vector<f64x8<S>>) {
        for register in 0..REGISTERS {
            if (group >> (register * LANES)) as u8 != 0 {
                let normal = normals(self.p.load(simd, register));
                let others = self.normal.load(simd, register);
                self.normal.store(register, Vector::choose(mask_of(simd, group, register), normal, others));
            }
        }
    }

    /// Turns the normals to the sides that the rays come from. Answers for which rays that is the inside.
    #[inline(always)]
    fn turned<S: Simd>(&mut self, simd: S, packet: &RayPacket) -> u64 {
        let mut inward = 0;
        for register in 0..REGISTERS {
            if (self.hits >> (register * LANES)) as u8 == 0 {
                continue;
            }
            let d = packet.d.load(simd, register);
            let normal = self.normal.load(simd, register).normalized_or(-d);
            let away = normal.dot(d).is_above(d.x.same(0.0));
            self.normal.store(register, Vector::choose(away, -normal, normal));
            inward |= away.bits() << (register * LANES);
        }
        inward
    }
}
