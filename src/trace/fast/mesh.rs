//! A packet of rays against a mesh that is an object by itself, in single precision. What that leaves in
//! doubt is answered for each ray by the exact engine.

use fearless_simd::Simd;

use crate::math::{DVec3, Lanes, PACKET, Ray, lanes};
use crate::solid::{
    AheadQuery, BatchKind, ExprView, FirstAhead, Leaf, MeshAnswer, MeshLearning, MeshQuery, WorldShape,
};

use super::Fast;
use super::memory::TileMemory;
use super::mesh_walk::{AskingRays, KnownStart, MeshLister, MeshObject, NearestTriangles};
use super::object::PacketTest;
use super::packet_culler::Slabs;
use super::precision::Precision;
use super::sink::{HitSink, offer_crossings};
use super::source::PacketSource;

/// What is seen is no farther than this from the origin along each axis, with room for rounding.
const WITHIN: f64 = 2.01;

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
        let here = source.departures.map_or(0, |departures| departures.here(simd, of.primitive).0);
        let is_sheet = self.assembly.kind(of.object).0 == BatchKind::Sheet;
        for lane in lanes(hits) {
            let (ray, t, leaves) = (packet.ray(lane), found.t.0[lane], here >> lane & 1 == 1);
            let enters = if is_sheet {
                of.mesh.normal(found.surface.0[lane]).dot(ray.d) < 0.0
            } else {
                self.enters(of, &ray, t, leaves, mesh_start)
            };
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
        let nothing_known = MeshAnswer { hits: 0, uncertain: wanted };
        let limits = memory.cullers[k].limits();
        let query = self.mesh_query(of, source, wanted, &limits, of.mesh.place_error());
        let is_set = simd.vectorize(
            #[inline(always)]
            || memory.mesh.set(simd, &query),
        );
        if !is_set {
            return nothing_known;
        }
        let TileMemory { mesh: rays, mesh_walks, frustums, counts, .. } = memory;
        let Some(Some(frustum)) = frustums.get(k) else { return nothing_known };
        let nearest = &mut NearestTriangles { mesh: of.mesh, rays };
        if mesh_walks.walk(simd, of, (frustum, wanted), nearest, counts) {
            return simd.vectorize(
                #[inline(always)]
                || rays.answer(simd),
            );
        }
        // What a walk that was broken off has found is not all.
        simd.vectorize(
            #[inline(always)]
            || rays.set(simd, &query),
        );
        let mut answer = MeshAnswer { hits: 0, uncertain: 0 };
        for lane in lanes(wanted) {
            let asked = ahead_query(&query, lane, rays.limit_of(lane));
            match of.mesh.first_ahead(&source.rays.ray(lane), &asked) {
                FirstAhead::Nothing => {}
                FirstAhead::Triangle(surface) => {
                    rays.put(lane, surface);
                    answer.hits |= 1 << lane;
                }
                FirstAhead::Uncertain => answer.uncertain |= 1 << lane,
            }
        }
        counts.primitive_tests += u64::from(wanted.count_ones());
        answer
    }

    /// Computes the spans of a packet's rays in the meshes of an expression, where they are not known yet.
    pub(super) fn know_meshes<S: Simd>(
        &self,
        simd: S,
        expression: ExprView,
        source: PacketSource,
        asking: AskingRays,
        memory: &mut TileMemory,
    ) {
        let is_unknown = |leaf: &Leaf, memory: &TileMemory| {
            matches!(self.assembly.primitives[leaf.primitive as usize].form, WorldShape::Mesh(_))
                && !memory.doubles.csg.knows_mesh(leaf.primitive)
        };
        if expression.leaves.iter().any(|leaf| is_unknown(leaf, memory)) {
            memory.doubles.csg.make_room_for_meshes(expression.leaves.len());
        }
        for leaf in expression.leaves {
            if is_unknown(leaf, memory)
                && let WorldShape::Mesh(mesh) = &self.assembly.primitives[leaf.primitive as usize].form
            {
                let of = MeshObject { object: 0, primitive: leaf.primitive, mesh };
                self.know_mesh(simd, &of, source, asking, memory);
            }
        }
    }

    fn know_mesh<S: Simd>(
        &self,
        simd: S,
        of: &MeshObject,
        source: PacketSource,
        asking: AskingRays,
        memory: &mut TileMemory,
    ) {
        let AskingRays { k, wanted } = asking;
        let PacketSource { rays: packet, departures, .. } = source;
        let mut limits = memory.cullers[k].limits();
        let b = of.mesh.bounds().padded(DVec3::splat(self.slack));
        let culler = &memory.cullers[k];
        let wanted = simd.vectorize(
            #[inline(always)]
            || culler.passing(simd, &Slabs::around(simd, b.lo, b.hi, 0.0), wanted),
        );
        // A ray that leaves the mesh starts in its box, even if single precision found the start beside it.
        let here = departures.map_or(0, |departures| departures.here(simd, of.primitive).0);
        let (mut boxed, mut complete) = (0, 0);
        for lane in lanes(wanted) {
            let ray: Ray = packet.ray(lane);
            if here >> lane & 1 == 0 && !b.contains(ray.o) {
                continue;
            }
            boxed |= 1 << lane;
            if !memory.ends_at_light {
                limits[lane] = f32::INFINITY;
            }
            let limit = f64::from(limits[lane]);
            complete |= u64::from(limit == f64::INFINITY || !b.contains(ray.at(limit))) << lane;
        }
        let query = self.mesh_query(of, source, wanted, &limits, self.assembly.place_error);
        let TileMemory { mesh: rays, mesh_lists: lists, mesh_walks, frustums, counts, doubles, .. } = memory;
        let is_set = simd.vectorize(
            #[inline(always)]
            || rays.set(simd, &query),
        );
        let Some(Some(frustum)) = frustums.get(k).filter(|_| is_set) else { return };
        lists.clear();
        // A cutter may reach out of the world, which frustums end with.
        let is_within = b.farthest().max_element() <= WITHIN;
        let lister = &mut MeshLister { mesh: of.mesh, rays, lists };
        let is_known = is_within && mesh_walks.walk(simd, of, (frustum, wanted), lister, counts);
        if !is_known {
            lists.clear();
            for lane in lanes(wanted) {
                let asked = ahead_query(&query, lane, rays.limit_of(lane));
                lists.list_ray(lane, of.mesh, &packet.ray(lane), &asked);
            }
            counts.primitive_tests += u64::from(wanted.count_ones());
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

    /// What some rays of a packet ask of a mesh; whose surface may be one place with the mesh's is off its
    /// place by `neighbour_error` at most.
    fn mesh_query<'q>(
        &self,
        of: &MeshObject,
        source: PacketSource<'q>,
        wanted: u64,
        limits: &'q [f32; PACKET],
        neighbour_error: f64,
    ) -> MeshQuery<'q> {
        MeshQuery {
            packet: source.rays,
            wanted,
            departures: source.departures,
            primitive: of.primitive,
            limits,
            place_error: self.assembly.place_error,
            neighbour_error,
        }
    }

    /// Whether a ray goes into a mesh where it first crosses it, at `t`: whether it starts outside. One that
    /// leaves the mesh may start beside its box, where single precision found the start, and go in there.
    /// `start` keeps where many rays start, as those of a tile from the eye do.
    fn enters(
        &self,
        of: &MeshObject,
        ray: &Ray,
        t: f64,
        leaves: bool,
        start: &mut Option<KnownStart>,
    ) -> bool {
        let b = of.mesh.bounds().padded(DVec3::splat(self.slack));
        if !leaves && !b.contains(ray.o) {
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

/// What one ray of a packet asks of a mesh.
fn ahead_query(query: &MeshQuery, lane: usize, limit: [f64; 2]) -> AheadQuery {
    let own = query.departures.filter(|all| all.primitive.0[lane] == query.primitive);
    AheadQuery { leaves: own.map(|all| all.surface.0[lane]), limit, neighbour_error: query.place_error }
}
