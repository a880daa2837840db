//! A packet of rays against a mesh that is an object by itself, in single precision. What that leaves in
//! doubt is answered for each ray by the exact engine.

use fearless_simd::Simd;

use crate::math::{DVec3, Lanes, Ray, lanes};
use crate::solid::{ExprView, MeshAnswer, MeshLearning, MeshQuery, WorldShape};

use super::Fast;
use super::memory::TileMemory;
use super::mesh_walk::{KnownStart, MeshLister, MeshObject, walk_mesh};
use super::object::PacketTest;
use super::precision::Precision;
use super::sink::{HitSink, offer_crossings};
use super::source::PacketSource;

impl Fast<'_> {
    /// What a packet's rays cross first of a mesh. Answers whether any ray may have met it.
    pub(super) fn mesh_of_packet<S: Simd, T: Precision, H: HitSink<T>>(
        &self,
        simd: S,
        of: &MeshObject,
        test: &PacketTest<T>,
        sink: &mut H,
        memory: &mut TileMemory,
    ) -> bool {
        let (source, packet) = (test.source.full(), test.source.full_rays);
        let MeshAnswer { hits, uncertain } = self.mesh_answer(simd, of, source, test.k, test.passing, memory);
        sink.mark_uncertain(uncertain);
        if hits == 0 {
            return false;
        }
        let TileMemory { mesh, mesh_start, doubles, .. } = memory;
        let found = &mut *doubles.found;
        simd.vectorize(
            #[inline(always)]
            || {
                (found.any, found.uncertain, found.entering) = (hits, 0, 0);
                found.surface = *mesh.surfaces();
                found.primitive = Lanes::filled(of.primitive);
                of.mesh.planes_of(simd, packet, found);
            },
        );
        for lane in lanes(hits) {
            let enters = self.enters(of, &packet.ray(lane), found.t.0[lane], mesh_start);
            found.entering |= u64::from(enters) << lane;
        }
        offer_crossings(simd, found, of.object, sink);
        true
    }

    /// Which rays of a packet cross a mesh, as far as single precision can tell.
    pub(super) fn mesh_answer<S: Simd>(
        &self,
        simd: S,
        of: &MeshObject,
        source: PacketSource,
        k: usize,
        wanted: u64,
        memory: &mut TileMemory,
    ) -> MeshAnswer {
        let TileMemory { mesh: rays, mesh_stack, frustums, cullers, counts, .. } = memory;
        let nothing_known = MeshAnswer { hits: 0, uncertain: wanted };
        let Some(Some(frustum)) = frustums.get(k) else { return nothing_known };
        simd.vectorize(
            #[inline(always)]
            || {
                let query = MeshQuery {
                    packet: source.rays,
                    wanted,
                    departures: source.departures,
                    primitive: of.primitive,
                    limits: &cullers[k].limits(),
                    place_error: self.assembly.place_error,
                    neighbour_error: of.mesh.place_error(),
                };
                if !rays.set(simd, &query) {
                    return nothing_known;
                }
                let [nodes, triangles] = walk_mesh(simd, of.mesh, frustum, &mut **rays, mesh_stack);
                counts.cells_visited += nodes;
                counts.primitive_tests += triangles;
                rays.answer(simd)
            },
        )
    }

    /// Computes the spans of a packet's rays in the meshes of an expression, where they are not known yet.
    pub(super) fn know_meshes<S: Simd>(
        &self,
        simd: S,
        expression: ExprView,
        source: PacketSource,
        (k, wanted): (usize, u64),
        memory: &mut TileMemory,
    ) {
        for leaf in expression.leaves {
            let form = &self.assembly.primitives[leaf.primitive as usize].form;
            if let WorldShape::Mesh(mesh) = form
                && !memory.doubles.csg.knows_mesh(leaf.primitive)
            {
                let of = MeshObject { object: 0, primitive: leaf.primitive, mesh };
                self.know_mesh(simd, &of, source, (k, wanted), memory);
            }
        }
    }

    fn know_mesh<S: Simd>(
        &self,
        simd: S,
        of: &MeshObject,
        source: PacketSource,
        (k, wanted): (usize, u64),
        memory: &mut TileMemory,
    ) {
        let PacketSource { rays: packet, departures, .. } = source;
        let Some(Some(frustum)) = memory.frustums.get(k) else { return };
        let mut limits = memory.cullers[k].limits();
        let b = of.mesh.bounds().padded(DVec3::splat(self.slack));
        let (mut boxed, mut complete) = (0, 0);
        for lane in lanes(wanted) {
            let ray: Ray = packet.ray(lane);
            if !b.contains(ray.o) {
                continue;
            }
            boxed |= 1 << lane;
            if !memory.ends_at_light {
                limits[lane] = f32::INFINITY;
            }
            let limit = f64::from(limits[lane]);
            complete |= u64::from(limit == f64::INFINITY || !b.contains(ray.at(limit))) << lane;
        }
        let TileMemory { mesh: rays, mesh_lists: lists, mesh_stack, counts, doubles, .. } = memory;
        let is_listed = simd.vectorize(
            #[inline(always)]
            || {
                let query = MeshQuery {
                    packet,
                    wanted,
                    departures,
                    primitive: of.primitive,
                    limits: &limits,
                    place_error: self.assembly.place_error,
                    neighbour_error: self.assembly.place_error,
                };
                if !rays.set(simd, &query) {
                    return false;
                }
                lists.clear();
                let [nodes, triangles] =
                    walk_mesh(simd, of.mesh, frustum, &mut MeshLister { rays, lists }, mesh_stack);
                counts.cells_visited += nodes;
                counts.primitive_tests += triangles;
                true
            },
        );
        if !is_listed {
            return;
        }
        let learning = MeshLearning {
            mesh: of.mesh,
            primitive: of.primitive,
            packet,
            departures,
            wanted,
            boxed,
            complete,
        };
        doubles.csg.learn_mesh(simd, &learning, lists);
    }

    /// Whether a ray goes into a mesh where it first crosses it, at `t`: whether it starts outside. `start`
    /// keeps where many rays start, as those of a tile from the eye do.
    fn enters(&self, of: &MeshObject, ray: &Ray, t: f64, start: &mut Option<KnownStart>) -> bool {
        let slack = DVec3::splat(self.slack);
        let b = of.mesh.bounds().padded(slack);
        if ray.o.cmplt(b.lo).any() || ray.o.cmpgt(b.hi).any() {
            return true;
        }
        if let Some(known) = start
            && known.primitive == of.primitive
            && known.o == ray.o
        {
            return !known.inside;
        }
        let mut before = 0_u32;
        of.mesh.crossings(ray, |end| before += u32::from(end.t < t));
        let inside = before % 2 == 1;
        if !of.mesh.boxes().has_near(ray.o) {
            *start = Some(KnownStart { primitive: of.primitive, o: ray.o, inside });
        }
        !inside
    }
}
