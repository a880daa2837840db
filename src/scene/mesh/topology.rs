//! How the triangles of a mesh hang together.

use crate::scene::groups::Groups;

/// What is told by the edges of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Topology {
    /// Edges that an odd number of triangles share.
    pub open_edges: usize,
    /// One of them: of those the one whose corners come first.
    pub open_edge: Option<[u32; 2]>,
    /// Whether each edge is passed as often one way as the other.
    pub is_oriented: bool,
    /// Parts that have no corner in common.
    pub shells: usize,
    /// Corners that triangles name.
    pub corners: usize,
}

impl Topology {
    /// That of triangles whose corners are below `points`.
    pub fn of(triangles: &[[u32; 3]], points: usize) -> Self {
        // Each edge by its lower corner: the other one, and whether it is passed from that, as the last bit.
        // Corners are fewer than 2³¹: files are shorter.
        let edges = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edges = edges.map(|[a, b]| if a < b { (a, 2 * b) } else { (b, 2 * a + 1) });
        let (mut open_edges, mut open_edge, mut is_oriented) = (0, None, true);
        Groups::new(points, edges).each(|lower, others| {
            others.sort_unstable();
            for same in others.chunk_by(|a, b| a / 2 == b / 2) {
                if same.len() % 2 == 1 {
                    open_edges += 1;
                    open_edge = open_edge.or(Some([lower, same[0] / 2]));
                }
                is_oriented &= 2 * same.iter().filter(|&edge| edge % 2 == 1).count() == same.len();
            }
        });
        let (shells, corners) = shells(triangles, points);
        Self { open_edges, open_edge, is_oriented, shells, corners }
    }

    /// Whether every edge is shared by an even number of triangles.
    pub const fn is_closed(&self) -> bool {
        self.open_edges == 0
    }
}

/// How many parts have no corner in common, and how many corners there are.
fn shells(triangles: &[[u32; 3]], points: usize) -> (usize, usize) {
    /// Of corners that no triangle names.
    const UNUSED: u32 = u32::MAX;
    let mut parents = vec![UNUSED; points];
    for &corner in triangles.iter().flatten() {
        parents[corner as usize] = corner;
    }
    let corners = parents.iter().filter(|&&parent| parent != UNUSED).count();
    let mut shells = corners;
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (from, to) = (root(&mut parents, a), root(&mut parents, other));
            if from != to {
                parents[from.max(to) as usize] = from.min(to);
                shells -= 1;
            }
        }
    }
    (shells, corners)
}

/// The first corner of those that hang together with one; ways to it are halved on the way.
fn root(parents: &mut [u32], mut corner: u32) -> u32 {
    while parents[corner as usize] != corner {
        let next = parents[parents[corner as usize] as usize];
        parents[corner as usize] = next;
        corner = next;
    }
    corner
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    #[test]
    fn a_tetrahedron_is_closed_and_turns_one_way() {
        let topology = Topology::of(&TETRAHEDRON, 4);
        let expected = Topology { open_edges: 0, open_edge: None, is_oriented: true, shells: 1, corners: 4 };
        assert_eq!(topology, expected);
        let mut turned = TETRAHEDRON;
        turned[0] = [0, 1, 2];
        assert!(!Topology::of(&turned, 4).is_oriented);
    }

    #[test]
    fn a_missing_face_leaves_three_open_edges() {
        let topology = Topology::of(&TETRAHEDRON[1..], 5);
        assert_eq!((topology.open_edges, topology.open_edge), (3, Some([0, 1])));
        assert_eq!((topology.shells, topology.corners), (1, 4));
    }

    #[test]
    fn shells_share_no_corner() {
        let two: Vec<_> = [0, 4].iter().flat_map(|by| TETRAHEDRON.map(|t| t.map(|i| i + by))).collect();
        assert_eq!(Topology::of(&two, 8).shells, 2);
        let touching: Vec<_> = [0, 3].iter().flat_map(|by| TETRAHEDRON.map(|t| t.map(|i| i + by))).collect();
        assert_eq!(Topology::of(&touching, 7).shells, 1);
    }
}
