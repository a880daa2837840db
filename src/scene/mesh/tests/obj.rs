//! OBJ.

use super::{all_refused, facts, scene};
use crate::math::DVec3;
use crate::scene::{Solid, read};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

#[test]
fn what_is_not_shown_is_read_over() {
    let text = format!(
        "mtllib\n{CORNERS}vt 0 0\ns off\nl 1 2\nf 1/1 3/1/1 2//1\nf 1 2 4 # side\nf 2 3 \\\n 4\nf -2 -4 -1\n"
    );
    let tetrahedron = facts("a.obj", text.as_bytes());
    assert!(tetrahedron.is_solid, "{tetrahedron}");
}

#[test]
fn groups_are_objects_and_may_be_opened_again() {
    let other = CORNERS.replace("v 0", "v 5").replace("v 1", "v 6");
    let text = format!(
        "{CORNERS}o a\nf 1 3 2\nf 1 2 4\n{other}o b\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\no a\nf 2 3 4\nf 3 1 4\n"
    );
    let scene = scene("a.obj", text.as_bytes());
    let names: Vec<_> = scene.objects.iter().map(|object| object.name.as_deref()).collect();
    assert_eq!(names, [Some("a"), Some("b")]);
    assert!(scene.meshes.iter().all(|facts| facts.is_solid), "{:?}", scene.meshes);
}

#[test]
fn groups_of_one_solid_are_one_object() {
    let text = format!("{CORNERS}g a\nf 1 3 2\nf 1 2 4\ng b\nf 2 3 4\nf 3 1 4\n");
    let scene = scene("a.obj", text.as_bytes());
    assert_eq!((scene.objects.len(), scene.notes.len()), (1, 0));
    assert!(scene.meshes[0].is_solid);
}

#[test]
fn colours_are_those_of_the_file_beside_it() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let text = format!("mtllib part.mtl\n{CORNERS}usemtl red\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    let options = crate::scene::ReadOptions { folder: Some(folder), ..super::options() };
    let scene = read("a.obj", text.as_bytes(), &options).unwrap();
    let Solid::Primitive(primitive) = &scene.objects[0].solid else { panic!("a solid") };
    let color = scene.materials[primitive.material.0 as usize].color;
    assert_eq!((color, scene.notes), (DVec3::new(0.8, 0.1, 0.1), vec![]));
    let alone = super::scene("a.obj", text.as_bytes());
    assert_eq!(alone.notes.len(), 2, "{:?}", alone.notes);
}

#[test]
fn a_solid_of_two_materials_is_shown_as_a_surface() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let text =
        format!("mtllib part.mtl\n{CORNERS}usemtl red\nf 1 3 2\nf 1 2 4\nusemtl blue\nf 2 3 4\nf 3 1 4\n");
    let options = crate::scene::ReadOptions { folder: Some(folder), ..super::options() };
    let scene = read("a.obj", text.as_bytes(), &options).unwrap();
    assert_eq!(scene.objects.len(), 2);
    assert!(scene.meshes[0].is_closed() && !scene.meshes[0].is_solid);
    assert!(scene.notes[0].contains("several materials"), "{:?}", scene.notes);
}

#[test]
fn wrong_files_are_refused() {
    let texts: [(&str, &str); 26] = [
        ("", "no triangles"),
        ("# nothing", "no triangles"),
        ("v 0 0 0", "no triangles"),
        ("v", "1:1: error: the file is cut off: it ends where a coordinate"),
        ("v 0 0\nv 1 0 0", "1:5: error: a coordinate is expected here"),
        ("v 0 0 nan", "1:7: error: a coordinate is not a finite"),
        ("v 0 0 -inf", "1:7: error: a coordinate is not a finite"),
        ("v 0 1e400 0", "1:5: error: a coordinate is not a finite"),
        ("v 0 0 x", "1:7: error: a coordinate is no number"),
        ("v 0 0 0,5", "1:7: error: a coordinate is no number"),
        ("f 1 2 3", "1:3: error: a face names corner 1, which there is not: there are no corners"),
        ("v 0 0 0\nf 1 1 2", "2:7: error: a face names corner 2"),
        ("v 0 0 0\nf 0 1 1", "2:3: error: a face names corner 0"),
        ("v 0 0 0\nf -1 -1 -2", "2:9: error: a face names corner -2"),
        ("v 0 0 0\nf 1 1 9223372036854775807", "numbered from 1 to 1"),
        ("v 0 0 0\nf 1 1 -9223372036854775808", "numbered from 1 to 1"),
        ("v 0 0 0\nf 1 1 9223372036854775808", "is no number"),
        ("v 0 0 0\nf 1 1 1.5", "2:7: error: the number of a corner is no number"),
        ("v 0 0 0\nf 1 1 /1", "2:7: error: the number of a corner is no number"),
        ("v 0 0 0\nf 1 1", "2:1: error: a face has 2 corners"),
        ("v 0 0 0\nf", "2:1: error: a face has 0 corners"),
        ("v 0 0 0\nf 1 1 1", "no face of the mesh has an area"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3", "no face of the mesh has an area"),
        ("v 1e306 0 0\nv 1 0 0\nv 2 1 0\nf 1 2 3", "reaches farther"),
        ("v 0 0 0\nvertex 1 2 3", "2:1: error: a statement of OBJ"),
        ("<html>\nv 0 0 0", "1:1: error: a statement of OBJ"),
    ];
    let files: Vec<(&[u8], &str)> = texts.iter().map(|(text, says)| (text.as_bytes(), *says)).collect();
    all_refused("a.obj", &files);
}
