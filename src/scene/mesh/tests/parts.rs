//! Closed and open, shells, and what is told of them.

use super::mesh_files::MeshText;
use super::{facts, scene};
use crate::scene::{Shape, Solid};

#[test]
fn an_open_mesh_is_surfaces_and_names_an_edge() {
    let mut brick = MeshText::brick();
    brick.faces.remove(5);
    let scene = scene("a.off", brick.off().as_bytes());
    assert_eq!(scene.objects.len(), 5);
    let is_face = |solid: &Solid| matches!(solid, Solid::Primitive(p) if matches!(p.shape, Shape::Face(_)));
    assert!(scene.objects.iter().all(|object| is_face(&object.solid)));
    assert_eq!(
        scene.notes,
        [
            "the mesh is not closed: nothing meets its edge from [2, 0, 0] to [2, 1.5, 0]; it is shown as a surface"
        ]
    );
    assert_eq!(
        scene.meshes[0].to_string(),
        "OFF, z up: 10 triangles, 8 corners, open at 4 edges as from [2, 0, 0] to [2, 1.5, 0], 1 shell, area 22.5, \
         size 2 x 1.5 x 3"
    );
}

#[test]
fn a_closed_mesh_says_what_it_encloses() {
    let brick = MeshText::brick();
    let expected =
        "binary STL, z up: 12 triangles, 8 corners, closed, 1 shell, volume 9, area 27, size 2 x 1.5 x 3";
    assert_eq!(facts("a.stl", &brick.stl_binary(b"")).to_string(), expected);
    let mut inverted = brick.clone();
    inverted.faces.iter_mut().for_each(|face| face.reverse());
    let said = facts("a.off", inverted.off().as_bytes()).to_string();
    assert!(said.contains("volume 9 (its faces look inwards)"), "{said}");
    let mut mixed = brick;
    mixed.faces[0].reverse();
    let mixed = facts("a.off", mixed.off().as_bytes());
    assert!(mixed.is_solid && mixed.to_string().contains("look both ways"), "{mixed}");
}

#[test]
fn faces_that_lie_on_each_other_are_no_solid() {
    let text = "OFF 3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n";
    let scene = scene("a.off", text.as_bytes());
    assert_eq!((scene.objects.len(), scene.meshes[0].is_solid), (1, false));
    assert!(scene.notes[0].contains("lie on each other"), "{:?}", scene.notes);
}

#[test]
fn equal_corners_are_one_at_any_scale() {
    for scale in [1e-300_f64, 1e-30, 1.0, 1e30, 1e300] {
        let corner =
            |x: f64, y: f64, z: f64| format!("v {:e} {:e} {:e}\n", x * scale, y * scale, -0.0 + z * scale);
        let mut text = String::new();
        let points = [[0.0, 0.0, -0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for triangle in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
            for [x, y, z] in triangle.map(|i: usize| points[i]) {
                text += &corner(x, y, z);
            }
            text += "f -3 -2 -1\n";
        }
        let tetrahedron = facts("a.obj", text.as_bytes());
        assert!(tetrahedron.is_solid && tetrahedron.corners == 4, "{scale}: {tetrahedron}");
    }
}

#[test]
fn concave_faces_are_cut_within_their_outline() {
    // An L, drawn out.
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let mut text = "OFF 12 8 0\n".to_owned();
    for z in [0, 1] {
        for [x, y] in outline {
            text += &format!("{x} {y} {z}\n");
        }
    }
    text += "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n";
    for i in 0..6 {
        let next = (i + 1) % 6;
        text += &format!("4 {i} {next} {} {}\n", next + 6, i + 6);
    }
    let l = facts("a.off", text.as_bytes());
    assert!(l.is_solid, "{l}");
    assert_eq!((l.volume, l.triangles), (Some(3.0), 20), "{l}");
}
