//! Which triangles the rays of a packet cross, as single precision lists them.

use crate::math::{PACKET, Ray};

use super::mesh::TriangleMesh;
use super::mesh_ray::AheadQuery;

/// So many crossings of a ray are listed at most.
pub(super) const MOST: usize = 24;

/// The triangles that each ray of a packet certainly crosses ahead of its start, in no order.
#[derive(Clone, Debug)]
pub struct MeshLists {
    surfaces: [[u32; MOST]; PACKET],
    counts: [u8; PACKET],
    /// Nearer than this a ray crosses nothing but what is listed.
    doubt_from: [f32; PACKET],
    /// Which rays certainly pass through the triangle that they leave.
    pub(super) left: u64,
}

impl MeshLists {
    /// None.
    pub const EMPTY: Self = Self {
        surfaces: [[0; MOST]; PACKET],
        counts: [0; PACKET],
        doubt_from: [f32::INFINITY; PACKET],
        left: 0,
    };

    /// Forgets all.
    pub fn clear(&mut self) {
        self.counts = [0; PACKET];
        self.doubt_from = [f32::INFINITY; PACKET];
        self.left = 0;
    }

    #[inline]
    pub(super) fn push(&mut self, lane: usize, surface: u32) {
        let count = usize::from(self.counts[lane]);
        if let Some(place) = self.surfaces[lane].get_mut(count) {
            *place = surface;
            self.counts[lane] += 1;
        } else {
            self.doubt_from[lane] = f32::NEG_INFINITY;
        }
    }

    /// Nothing is certain of a ray from this distance on; from its start where that is no number.
    #[inline]
    pub(super) fn doubt(&mut self, lane: usize, from: f32) {
        let known = self.doubt_from[lane];
        self.doubt_from[lane] = if from.is_nan() { f32::NEG_INFINITY } else { known.min(from) };
    }

    /// Lists what a ray crosses by the exact predicate.
    pub fn list_ray(&mut self, lane: usize, mesh: &TriangleMesh, ray: &Ray, asked: &AheadQuery) {
        let all_known = mesh.all_ahead(ray, asked, |surface| {
            if asked.leaves == Some(surface) {
                self.left |= 1 << lane;
            } else {
                self.push(lane, surface);
            }
        });
        if !all_known {
            self.doubt(lane, f32::NEG_INFINITY);
        }
    }

    /// The triangles of one ray.
    #[inline]
    pub(super) fn of(&self, lane: usize) -> &[u32] {
        &self.surfaces[lane][..usize::from(self.counts[lane])]
    }

    /// From where on they may not be all.
    #[inline]
    pub(super) fn doubt_of(&self, lane: usize) -> f32 {
        self.doubt_from[lane]
    }
}
