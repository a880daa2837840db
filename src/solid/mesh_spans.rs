//! The spans of a packet's rays in meshes that are operands of CSG.
//!
//! Single precision lists which triangles a ray crosses ([`super::mesh_lists`]); where, is computed here by
//! the exact engine's own formula, eight at a time. In the order of their distances every two crossings are
//! a span. Whether a ray starts inside is a matter of parity: outside the box of a mesh it is outside,
//! elsewhere the number of crossings ahead says so, if all are known.

use fearless_simd::Simd;

use crate::math::{Lanes, RayPacket, Real, lanes};

use super::csg_query::{CsgQuery, Departures, PacketCrossings};
use super::mesh::TriangleMesh;
use super::mesh_lists::{MOST, MeshLists};
use super::span::End;
use super::span_cache::CachedSpans;

/// So many meshes are known at most, but for those of one expression.
const MANY: usize = 64;

/// A mesh, and what is known of the rays that ask for their spans in it.
#[derive(Clone, Copy, Debug)]
pub struct MeshLearning<'a> {
    /// The mesh.
    pub mesh: &'a TriangleMesh,
    /// Its index among the primitives.
    pub primitive: u32,
    /// The rays.
    pub packet: &'a RayPacket,
    /// The surfaces that they leave; none for rays from the eye.
    pub departures: Option<&'a Departures>,
    /// Which of them ask, a bit for each.
    pub wanted: u64,
    /// Which may start inside.
    pub boxed: u64,
    /// Whose lists reach to where they are outside again.
    pub complete: u64,
}

/// What is known of a packet's rays in one mesh.
#[derive(Clone, Debug)]
pub(super) struct KnownMesh {
    primitive: u32,
    /// Its spans, by their places: of each ray the first, of each the second, and so on.
    pub first: usize,
    pub count: usize,
    /// The rays that are not certain all the way, and from where on.
    doubtful: u64,
    doubt_from: Lanes,
}

/// The spans of one packet in meshes.
#[derive(Clone, Debug)]
pub(super) struct MeshSpans<T> {
    /// Those in use come first.
    spans: Vec<CachedSpans<T>>,
    used: usize,
    known: Vec<KnownMesh>,
    /// By place in the lists: the crossings of all rays.
    crossings: Vec<PacketCrossings>,
}

impl<T> Default for MeshSpans<T> {
    fn default() -> Self {
        Self { spans: Vec::new(), used: 0, known: Vec::new(), crossings: Vec::new() }
    }
}

impl<T: Real> MeshSpans<T> {
    /// Forgets all: another packet follows.
    pub fn clear(&mut self) {
        self.used = 0;
        self.known.clear();
    }

    /// Makes room for so many more, where that takes forgetting all: each takes a few times 3 KB.
    pub fn make_room(&mut self, more: usize) {
        if self.known.len() + more > MANY {
            self.clear();
        }
    }

    /// What is known of a mesh.
    pub fn find(&self, primitive: u32) -> Option<&KnownMesh> {
        self.known.iter().find(|known| known.primitive == primitive)
    }

    /// All spans, by their places.
    pub fn spans(&mut self) -> &mut [CachedSpans<T>] {
        &mut self.spans[..self.used]
    }
}

impl KnownMesh {
    /// Of which rays, given what was found of them, the answer is not certain.
    pub fn uncertain<T: Real>(&self, asked: &CsgQuery<T>, wanted: u64, found: &PacketCrossings<T>) -> u64 {
        let mut uncertain = 0;
        for lane in lanes(wanted & self.doubtful) {
            let from = self.doubt_from.0[lane];
            let (t, error): (f64, f64) = (found.t.0[lane].into(), found.error.0[lane].into());
            let is_nearer = found.any >> lane & 1 == 1 && t + error < from;
            uncertain |= u64::from(!is_nearer && asked.reach.to.0[lane].into() >= from) << lane;
        }
        uncertain
    }
}

impl MeshSpans<f64> {
    /// Computes the spans in a mesh from what was listed of it.
    pub fn learn<S: Simd>(&mut self, simd: S, of: &MeshLearning, lists: &MeshLists) {
        let here = of.departures.map_or(0, |departures| departures.here(simd, of.primitive).0);
        let most = lanes(of.wanted).map(|lane| lists.of(lane).len()).max().unwrap_or(0);
        for place in 0..most {
            if place == self.crossings.len() {
                self.crossings.push(PacketCrossings::NONE);
            }
            let crossings = &mut self.crossings[place];
            crossings.any = 0;
            for lane in lanes(of.wanted) {
                if let Some(&surface) = lists.of(lane).get(place) {
                    crossings.any |= 1 << lane;
                    crossings.surface.0[lane] = surface;
                }
            }
            simd.vectorize(
                #[inline(always)]
                || of.mesh.planes_of(simd, of.packet, crossings),
            );
        }
        let Self { spans, used, crossings, .. } = self;
        let mut known = KnownMesh {
            primitive: of.primitive,
            first: *used,
            count: 0,
            doubtful: 0,
            doubt_from: Lanes::filled(f64::INFINITY),
        };
        for lane in lanes(of.wanted) {
            let is_here = here >> lane & 1 == 1;
            let doubt_from = f64::from(lists.doubt_of(lane));
            let ahead = lists.of(lane).len();
            let mut ends = RayEnds::NONE;
            if of.boxed >> lane & 1 == 1 {
                let all_known = doubt_from == f64::INFINITY
                    && of.complete >> lane & 1 == 1
                    && (!is_here || lists.left >> lane & 1 == 1);
                if !all_known {
                    known.doubt(lane, f64::NEG_INFINITY);
                    continue;
                }
                if (ahead % 2 == 1) != is_here {
                    ends.insert(End { t: f64::NEG_INFINITY, ..START });
                }
            }
            if is_here {
                ends.insert(START);
            }
            for found in &crossings[..ahead] {
                ends.insert(End {
                    t: found.t.0[lane],
                    error: found.error.0[lane],
                    surface: found.surface.0[lane],
                });
            }
            known.doubt(lane, doubt_from.min(ends.together()));
            for (number, pair) in ends.all().chunks(2).enumerate() {
                if number == known.count {
                    known.count += 1;
                    if *used == spans.len() {
                        spans.push(CachedSpans::NONE);
                    }
                    spans[*used].reset(of.mesh.place_error());
                    *used += 1;
                }
                let leave = pair.get(1).copied().unwrap_or(End { t: f64::INFINITY, ..START });
                spans[known.first + number].put(lane, pair[0], leave);
            }
        }
        self.known.push(known);
    }
}

impl KnownMesh {
    /// Nothing is certain of a ray from this distance on.
    fn doubt(&mut self, lane: usize, from: f64) {
        self.doubt_from.0[lane] = from;
        self.doubtful |= u64::from(from < f64::INFINITY) << lane;
    }
}

/// The start of a ray on a surface, which is at 0 by construction.
const START: End = End { t: 0.0, error: 0.0, surface: 0 };

/// What one ray crosses, the nearest first.
struct RayEnds {
    ends: [End; MOST + 2],
    count: usize,
}

impl RayEnds {
    const NONE: Self = Self { ends: [START; MOST + 2], count: 0 };

    fn all(&self) -> &[End] {
        &self.ends[..self.count]
    }

    /// Adds one behind those that are as near.
    fn insert(&mut self, end: End) {
        let mut place = self.count;
        while place > 0 && self.ends[place - 1].t > end.t {
            self.ends[place] = self.ends[place - 1];
            place -= 1;
        }
        self.ends[place] = end;
        self.count += 1;
    }

    /// From where on two of them may be one place, whose order is not known then.
    fn together(&self) -> f64 {
        let starts_together =
            |pair: &&[End]| pair[1].t - pair[1].error <= pair[0].t + pair[0].error && pair[1].t > 0.0;
        let first = self.all().windows(2).find(starts_together);
        first.map_or(f64::INFINITY, |pair| (pair[0].t - pair[0].error).min(pair[1].t - pair[1].error))
    }
}
