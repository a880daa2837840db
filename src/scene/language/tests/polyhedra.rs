//! Polyhedra: closed surfaces of triangles.

use std::collections::HashMap;
use std::sync::Arc;

use super::primitive;
use crate::math::DVec3;
use crate::scene::{Mesh, Shape};

fn mesh(points: &str, faces: &str) -> Arc<Mesh> {
    match primitive(&format!("polyhedron({points}, {faces});")).shape {
        Shape::Mesh(mesh) => mesh,
        other => panic!("{other:?}"),
    }
}

/// Six times the volume inside; fails where an edge is shared by an odd number of triangles.
pub fn six_volumes(mesh: &Mesh) -> f64 {
    let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
    let mut volume = 0.0;
    for &[a, b, c] in &mesh.triangles {
        assert!(a != b && b != c && c != a);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
        let [a, b, c] = [a, b, c].map(|index| mesh.points[index as usize]);
        volume += a.cross(b).dot(c);
    }
    assert!(edges.values().all(|count| count % 2 == 0), "{edges:?}");
    volume.abs()
}

const BOX: &str = "[[0,0,0],[2,0,0],[2,3,0],[0,3,0],[0,0,4],[2,0,4],[2,3,4],[0,3,4]]";

#[test]
fn convex_faces_are_frusta() {
    let mesh = mesh(BOX, "[[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3],[3,7,4,0]]");
    assert_eq!((mesh.points.len(), mesh.triangles.len()), (8, 12));
    assert_eq!(six_volumes(&mesh), 6.0 * 24.0);
}

#[test]
fn equal_points_are_merged_and_flat_faces_dropped() {
    let points = "[[0,0,0],[1,0,0],[0,1,0],[0,0,1],[-0,0,0],[1,0,0],[0,1,0]]";
    let mesh = mesh(points, "[[0,1,2],[4,3,5],[1,3,6],[6,3,0],[0,4,1],[1,5,5,1]]");
    assert_eq!((mesh.points.len(), mesh.triangles.len()), (4, 4));
    assert_eq!(six_volumes(&mesh), 1.0);
}

#[test]
fn faces_that_are_not_convex_are_cut() {
    // An L of 3 squares, one high, whose inner corner no frusta from its first corner would keep free.
    let outline = [[2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [0, 0]];
    let point = |z: i32| outline.map(|[x, y]| format!("[{x},{y},{z}]")).join(",");
    let sides: Vec<String> =
        (0..6).map(|i| format!("[{},{},{},{}]", (i + 1) % 6, i, i + 6, (i + 1) % 6 + 6)).collect();
    let faces = format!("[[0,1,2,3,4,5],[11,10,9,8,7,6],{}]", sides.join(","));
    let mesh = mesh(&format!("[{},{}]", point(0), point(1)), &faces);
    assert_eq!(six_volumes(&mesh), 6.0 * 3.0);
    let area: f64 = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|index| mesh.points[index as usize]))
        .filter(|corners| corners.iter().all(|corner| corner.z == 0.0))
        .map(|[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() / 2.0)
        .sum();
    assert_eq!(area, 3.0, "the triangles of the bottom do not overlap");
}

#[test]
fn corners_on_a_straight_edge_stay() {
    // The bottom is not convex and has a corner amid a straight edge, where two side faces meet: ear
    // clipping alone would leave the edge open.
    let outline = [[0, 0], [1, 0], [2, 0], [2, 2], [1, 1], [0, 2]];
    let point = |z: i32| outline.map(|[x, y]| format!("[{x},{y},{z}]")).join(",");
    let sides: Vec<String> =
        (0..6).map(|i| format!("[{},{},{},{}]", (i + 1) % 6, i, i + 6, (i + 1) % 6 + 6)).collect();
    let faces = format!("[[0,1,2,3,4,5],[11,10,9,8,7,6],{}]", sides.join(","));
    assert_eq!(six_volumes(&mesh(&format!("[{},{}]", point(0), point(1)), &faces)), 6.0 * 3.0);
}

#[test]
fn faces_may_turn_either_way() {
    let mesh = mesh("[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]", "[[0,2,1],[0,3,1],[1,3,2],[2,3,0]]");
    assert_eq!(mesh.triangles.len(), 4);
    six_volumes(&mesh);
}

#[test]
fn faces_that_cross_themselves_stay_closed() {
    let star = "[[0,3,0],[2,-3,0],[-3,1,0],[3,1,0],[-2,-3,0],[0,0,5]]";
    let faces = "[[0,1,2,3,4],[0,1,5],[1,2,5],[2,3,5],[3,4,5],[4,0,5]]";
    six_volumes(&mesh(star, faces));
    let keyhole = "[[0,0,0],[4,0,0],[0,4,0],[1,1,0],[2,1,0],[1,2,0],[0,0,5]]";
    let faces = "[[0,1,2,0,3,5,4,3],[0,1,6],[1,2,6],[2,0,6],[3,5,6],[5,4,6],[4,3,6]]";
    six_volumes(&mesh(keyhole, faces));
}
