//! A packet of rays against Bézier patches that are an object by themselves.

use fearless_simd::Simd;

use crate::math::{DVec3, Ray, lanes};
use crate::solid::{BezierPacket, BezierQuery, BezierSurface, PacketShear};

use super::Fast;
use super::memory::TileMemory;
use super::mesh_walk::{BezierObject, PartVisitor};
use super::object::PacketTest;
use super::precision::Precision;
use super::sink::{HitSink, offer_crossings};

/// The nearest crossings of patches.
struct NearestPieces<'a> {
    query: &'a BezierQuery<'a>,
    rays: &'a mut BezierPacket,
    shear: &'a mut PacketShear,
}

impl<S: Simd> PartVisitor<S> for NearestPieces<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, part: u32, _: f32) {
        self.rays.visit(simd, self.query, self.shear, part);
    }

    #[inline(always)]
    fn farthest(&self, simd: S) -> f32 {
        self.rays.farthest(simd)
    }
}

impl Fast<'_> {
    /// What a packet's rays cross first of patches. Answers whether any ray may have met them.
    pub(super) fn patches_of_packet<S: Simd, T: Precision, H: HitSink<T>>(
        &self,
        simd: S,
        of: &BezierObject,
        test: &PacketTest<T>,
        sink: &mut H,
        memory: &mut TileMemory,
    ) -> bool {
        let (k, patches) = (test.k, of.patches);
        let limits = memory.cullers[k].limits();
        let query = BezierQuery {
            patches,
            primitive: of.primitive,
            packet: test.source.full_rays,
            wanted: test.passing,
            departures: test.source.full_departures,
            limits: &limits,
        };
        let TileMemory { bezier, mesh_walks, frustums, sheared, counts, doubles, .. } = memory;
        let Some(Some(frustum)) = frustums.get(k) else {
            sink.mark_uncertain(test.passing);
            return false;
        };
        bezier.set(&query);
        let found = &mut *doubles.found;
        let nearest = &mut NearestPieces { query: &query, rays: bezier, shear: &mut sheared[k] };
        mesh_walks.walk_all(simd, patches.boxes(), frustum, nearest, counts);
        bezier.answer(&query, found);
        sink.mark_uncertain(found.uncertain);
        if found.any == 0 {
            return false;
        }
        if patches.is_closed() && H::NEEDS_SIDES {
            for lane in lanes(found.any) {
                let enters = self.enters_patches(patches, &query.packet.ray(lane), found.t.0[lane]);
                found.entering = found.entering & !(1 << lane) | u64::from(enters) << lane;
            }
        }
        offer_crossings(simd, found, of.object, sink);
        true
    }

    /// Whether a ray goes into a solid of patches where it first crosses it, at `t`.
    fn enters_patches(&self, patches: &BezierSurface, ray: &Ray, t: f64) -> bool {
        if !patches.bounds().padded(DVec3::splat(self.slack)).contains(ray.o) {
            return true;
        }
        let mut before = 0_u32;
        patches.crossings(ray, |end| before += u32::from(end.t < t));
        before.is_multiple_of(2)
    }
}
