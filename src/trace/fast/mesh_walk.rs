//! The walk of a packet's frustum through the boxes of a mesh, or of patches, the nearest first: rays are
//! intersected with the triangles, or pieces, that it meets.

use fearless_simd::Simd;

use crate::bvh::{Bvh8, BvhChild, WIDE};
use crate::lattice::Frustum;
use crate::math::DVec3;
use crate::solid::{BezierSurface, MeshLists, MeshPacket, TriangleMesh};
use crate::stage::Counts;

use super::ranked::push_ranked;

/// A node of a mesh, or of patches, that is to be walked.
#[derive(Clone, Copy, Debug)]
struct MeshItem {
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

/// Bézier patches that are an object, by their indices in the assembly.
#[derive(Clone, Copy)]
pub(super) struct BezierObject<'a> {
    pub object: u32,
    pub primitive: u32,
    pub patches: &'a BezierSurface,
}

/// Rays of a packet that ask for what they cross of meshes.
#[derive(Clone, Copy)]
pub(super) struct AskingRays {
    /// The packet's number in the tile.
    pub k: usize,
    /// Which of its rays ask, a bit for each.
    pub wanted: u64,
}

/// A point that many rays start from, and on which side of a mesh it lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct KnownStart {
    /// The mesh, by its index among the primitives.
    pub primitive: u32,
    pub o: DVec3,
    pub inside: bool,
}

/// What a walk does with the triangles or pieces that it meets.
pub(super) trait PartVisitor<S: Simd> {
    /// Intersects the packet's rays with a part, whose box lies no nearer to any start than `near`.
    fn visit(&mut self, simd: S, part: u32, near: f32);

    /// How far any of the rays still matters.
    fn farthest(&self, simd: S) -> f32;
}

/// The nearest crossings of a mesh.
pub(super) struct NearestTriangles<'a> {
    pub mesh: &'a TriangleMesh,
    pub rays: &'a mut MeshPacket,
}

impl<S: Simd> PartVisitor<S> for NearestTriangles<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, part: u32, near: f32) {
        self.rays.intersect(simd, self.mesh.corners(part), part, near);
    }

    #[inline(always)]
    fn farthest(&self, simd: S) -> f32 {
        self.rays.farthest(simd)
    }
}

/// All crossings within the rays' limits.
pub(super) struct MeshLister<'a> {
    pub mesh: &'a TriangleMesh,
    pub rays: &'a MeshPacket,
    pub lists: &'a mut MeshLists,
}

impl<S: Simd> PartVisitor<S> for MeshLister<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, part: u32, near: f32) {
        self.rays.list(simd, self.mesh.corners(part), part, near, self.lists);
    }

    #[inline(always)]
    fn farthest(&self, simd: S) -> f32 {
        self.rays.farthest(simd)
    }
}

/// More triangles than this for each of a packet's rays take longer than the rays do one by one.
const TRIANGLES_PER_RAY: u64 = 8;

/// From so many rays of a packet is told how the other packets of a tile fare with a mesh.
const MANY_RAYS: u32 = 32;

/// What walks through meshes need, used again for every packet.
#[derive(Clone, Debug, Default)]
pub(super) struct MeshWalks {
    /// Nodes to be walked.
    stack: Vec<MeshItem>,
    /// The meshes of the tile that have too many triangles for packets, by their indices among the
    /// primitives.
    by_rays: Vec<u32>,
}

impl MeshWalks {
    /// Forgets how packets of the last tile fared.
    pub fn forget_tile(&mut self) {
        self.by_rays.clear();
    }

    /// Intersects the `wanted` rays of a packet with the triangles of a mesh that its frustum meets. False
    /// where there are so many that the rays are to be asked one by one: not all triangles were looked at.
    pub fn walk<S: Simd>(
        &mut self,
        simd: S,
        of: &MeshObject,
        (frustum, wanted): (&Frustum, u64),
        rays: &mut impl PartVisitor<S>,
        counts: &mut Counts,
    ) -> bool {
        if self.by_rays.contains(&of.primitive) {
            return false;
        }
        let asking = wanted.count_ones();
        let budget = TRIANGLES_PER_RAY * u64::from(asking);
        let stack = &mut self.stack;
        let [nodes, triangles] = simd.vectorize(
            #[inline(always)]
            || walk_parts(simd, of.mesh.boxes(), frustum, rays, stack, budget),
        );
        counts.cells_visited += nodes;
        counts.primitive_tests += triangles;
        if triangles > budget && asking >= MANY_RAYS {
            self.by_rays.push(of.primitive);
        }
        triangles <= budget
    }

    /// Intersects a packet's rays with all parts whose boxes its frustum meets.
    pub fn walk_all<S: Simd>(
        &mut self,
        simd: S,
        boxes: &Bvh8,
        frustum: &Frustum,
        rays: &mut impl PartVisitor<S>,
        counts: &mut Counts,
    ) {
        let stack = &mut self.stack;
        let [nodes, parts] = simd.vectorize(
            #[inline(always)]
            || walk_parts(simd, boxes, frustum, rays, stack, u64::MAX),
        );
        counts.cells_visited += nodes;
        counts.primitive_tests += parts;
    }
}

/// Walks boxes with a packet's frustum, until more than `budget` parts were looked at. Answers how many nodes
/// and parts were.
#[inline(always)]
fn walk_parts<S: Simd>(
    simd: S,
    boxes: &Bvh8,
    frustum: &Frustum,
    rays: &mut impl PartVisitor<S>,
    stack: &mut Vec<MeshItem>,
    budget: u64,
) -> [u64; 2] {
    let nodes = boxes.nodes();
    let (mut visited, mut tested) = (0, 0);
    let mut farthest = rays.farthest(simd);
    stack.clear();
    stack.push(MeshItem { near: f32::NEG_INFINITY, node: 0 });
    while let Some(MeshItem { near, node }) = stack.pop() {
        if near > farthest {
            continue;
        }
        if tested > budget {
            break;
        }
        visited += 1;
        let node = &nodes[node as usize];
        let (lo, hi) = node.sides(simd);
        let met = frustum.meets_boxes(simd, &lo, &hi);
        let near: [f32; WIDE] = met.near.into();
        let mut parts = met.boxes & !node.inner();
        let some = parts != 0;
        while parts != 0 {
            let slot = parts.trailing_zeros() as usize;
            parts &= parts - 1;
            let Some(BvhChild::Object(part)) = node.child(slot) else { continue };
            if near[slot] <= farthest {
                tested += 1;
                rays.visit(simd, part, near[slot]);
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
            push_ranked(
                stack,
                first,
                MeshItem { near: near[slot], node: index },
                #[inline(always)]
                |item| item.near,
            );
        }
    }
    [visited, tested]
}
