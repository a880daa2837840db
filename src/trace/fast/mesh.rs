//! A packet of rays against a mesh that is an object by itself: the packet's frustum walks the boxes of the
//! triangles, the nearest first, and the rays are intersected with what it meets, in single precision. What
//! that leaves in doubt is answered for each ray by the exact engine.

use fearless_simd::Simd;

use crate::bvh::BvhChild;
use crate::lattice::Frustum;
use crate::math::{DVec3, RayPacket, lanes};
use crate::solid::{Departures, MeshAnswer, MeshPacket, MeshQuery, TriangleMesh};

use super::Fast;
use super::memory::TileMemory;
use super::object::PacketTest;
use super::precision::Precision;
use super::sink::{HitSink, offer_crossings};

/// A node of a mesh that is to be walked.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshItem {
    /// No ray meets it nearer than this.
    near: f32,
    node: u32,
}

/// A mesh that is an object, by its indices in the assembly.
#[derive(Clone, Copy)]
pub(super) struct MeshObject<'a> {
    pub object: u32,
    pub primitive: u32,
    pub mesh: &'a TriangleMesh,
}

/// A point that many rays start from, and on which side of a mesh it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownStart {
    primitive: u32,
    o: DVec3,
    inside: bool,
}

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
        let (packet, departures) = (test.source.full_rays, test.source.full_departures);
        let MeshAnswer { hits, uncertain } =
            self.mesh_answer(simd, of, (packet, departures), test.k, test.passing, memory);
        sink.mark_uncertain(uncertain);
        if hits == 0 {
            return false;
        }
        let mut found = std::mem::take(&mut memory.doubles.found);
        simd.vectorize(
            #[inline(always)]
            || {
                let surfaces = memory.mesh.surfaces();
                let numbers = [&mut found.t, &mut found.error];
                of.mesh.planes_of(simd, packet, hits, surfaces, numbers);
                found.surface = *surfaces;
            },
        );
        (found.any, found.uncertain) = (hits, 0);
        found.primitive = crate::math::Lanes::filled(of.primitive);
        found.entering = 0;
        for lane in lanes(hits) {
            let enters = self.enters(of, &packet.ray(lane), found.t.0[lane], memory);
            found.entering |= u64::from(enters) << lane;
        }
        offer_crossings(simd, &found, of.object, sink);
        memory.doubles.found = found;
        true
    }

    /// Which rays of a packet cross a mesh, as far as single precision can tell.
    pub(super) fn mesh_answer<S: Simd>(
        &self,
        simd: S,
        of: &MeshObject,
        (packet, departures): (&RayPacket, Option<&Departures>),
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
                    packet,
                    wanted,
                    departures,
                    primitive: of.primitive,
                    limits: &cullers[k].limits(),
                    place_error: self.assembly.place_error,
                };
                if !rays.set(simd, of.mesh, &query) {
                    return nothing_known;
                }
                let [nodes, triangles] = walk(simd, of.mesh, frustum, rays, mesh_stack);
                counts.cells_visited += nodes;
                counts.primitive_tests += triangles;
                rays.answer(simd)
            },
        )
    }

    /// Whether a ray goes into a mesh where it first crosses it, at `t`: whether it starts outside.
    fn enters(&self, of: &MeshObject, ray: &crate::math::Ray, t: f64, memory: &mut TileMemory) -> bool {
        let slack = DVec3::splat(self.slack);
        let b = of.mesh.bounds().padded(slack);
        if ray.o.cmplt(b.lo).any() || ray.o.cmpgt(b.hi).any() {
            return true;
        }
        if let Some(known) = memory.mesh_start {
            if known.primitive == of.primitive && known.o == ray.o {
                return !known.inside;
            }
        }
        let mut before = 0_u32;
        of.mesh.crossings(ray, |end| before += u32::from(end.t < t));
        let inside = before % 2 == 1;
        if !of.mesh.boxes().has_near(ray.o) {
            memory.mesh_start = Some(KnownStart { primitive: of.primitive, o: ray.o, inside });
        }
        !inside
    }
}

/// Walks the boxes of a mesh with a packet's frustum. Answers how many nodes and triangles were looked at.
#[inline(always)]
fn walk<S: Simd>(
    simd: S,
    mesh: &TriangleMesh,
    frustum: &Frustum,
    rays: &mut MeshPacket,
    stack: &mut Vec<MeshItem>,
) -> [u64; 2] {
    let nodes = mesh.boxes().nodes();
    let (mut visited, mut tested) = (0, 0);
    let mut farthest = rays.farthest(simd);
    stack.clear();
    stack.push(MeshItem { near: f32::NEG_INFINITY, node: 0 });
    while let Some(MeshItem { near, node }) = stack.pop() {
        if near > farthest {
            continue;
        }
        visited += 1;
        let node = &nodes[node as usize];
        let (lo, hi) = node.sides(simd);
        let met = frustum.meets_boxes(simd, &lo, &hi);
        let near: [f32; crate::bvh::WIDE] = met.near.into();
        let mut triangles = met.boxes & !node.inner();
        let some = triangles != 0;
        while triangles != 0 {
            let slot = triangles.trailing_zeros() as usize;
            triangles &= triangles - 1;
            let Some(BvhChild::Object(surface)) = node.child(slot) else { continue };
            if near[slot] <= farthest {
                tested += 1;
                rays.intersect(simd, mesh.corners(surface), surface, near[slot]);
            }
        }
        if some {
            farthest = rays.farthest(simd);
        }
        let (first, mut left) = (stack.len(), met.boxes & node.inner());
        while left != 0 {
            let slot = left.trailing_zeros() as usize;
            left &= left - 1;
            let Some(BvhChild::Node(index)) = node.child(slot) else { continue };
            let near = near[slot];
            let mut place = stack.len();
            stack.push(MeshItem { near, node: index });
            while place > first && stack[place - 1].near < near {
                stack.swap(place - 1, place);
                place -= 1;
            }
        }
    }
    [visited, tested]
}
