//! STL.

use super::mesh_files::MeshText;
use super::{all_refused, facts, refused, scene};

const FACET: &str =
    "facet normal nan nan nan outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet";

#[test]
fn solids_of_a_text_are_parts() {
    let brick = MeshText::brick().stl_text();
    let text = format!("{brick}SOLID\r\n{FACET}\r\nENDSOLID\r\n").replace("a part", "");
    let scene = scene("a.stl", text.as_bytes());
    assert_eq!((scene.objects.len(), scene.meshes.len()), (2, 2));
    assert_eq!(scene.objects[1].name, None);
    assert!(scene.meshes[0].is_solid && !scene.meshes[1].is_solid);
    assert_eq!(scene.meshes[1].open_edges, 3);
    assert!(
        scene.notes[0].contains("nothing meets its edge from [0, 0, 0] to [1, 0, 0]"),
        "{:?}",
        scene.notes
    );
    let named = super::scene("a.stl", brick.as_bytes());
    assert_eq!(named.objects[0].name.as_deref(), Some("a part"));
}

#[test]
fn names_and_comments_may_be_in_any_encoding() {
    let text = MeshText::brick().stl_text().replace("a part", "Geh?use").replace('?', "\u{e4}");
    assert_eq!(facts("a.stl", text.as_bytes()).triangles, 12);
    let mut latin = b"solid Geh\xe4use\n".to_vec();
    latin.extend_from_slice(b"facet normal 0 0 1 outer loop vertex 0 0 x");
    let message = refused("a.stl", &latin);
    assert!(message.contains("line 2: a coordinate is no number"), "{message}");
}

#[test]
fn bytes_behind_the_triangles_are_noted() {
    let mut bytes = MeshText::brick().stl_binary(b"");
    bytes.extend(b"colours");
    assert_eq!(scene("a.stl", &bytes).notes, ["7 bytes behind the last triangle are ignored"]);
}

/// Binary STL of one triangle, with a number of bytes replaced.
fn with(at: usize, bytes: &[u8]) -> Vec<u8> {
    let mut stl = MeshText::tetrahedron().stl_binary(b"solid that is binary");
    stl[at..at + bytes.len()].copy_from_slice(bytes);
    stl
}

#[test]
fn wrong_binary_files_are_refused() {
    let whole = MeshText::tetrahedron().stl_binary(b"solid that is binary");
    let number = |value: f32| value.to_le_bytes();
    let count = |value: u32| value.to_le_bytes();
    let corner = |triangle: usize, corner: usize| 84 + 50 * triangle + 12 + 12 * corner;
    let mut none = whole[..84].to_vec();
    none[80] = 0;
    let mut flat = whole.clone();
    (0..4).for_each(|triangle| flat[corner(triangle, 0)..corner(triangle, 3)].fill(0));
    let files = [
        (
            with(corner(0, 0), &number(f32::NAN)),
            "triangle 1, at byte 96: a coordinate of a corner is not a finite",
        ),
        (with(corner(2, 1) + 4, &number(f32::INFINITY)), "triangle 3, at byte 208"),
        (with(corner(3, 2) + 8, &number(f32::NEG_INFINITY)), "triangle 4, at byte 270"),
        (with(80, &count(5)), "says that it has 5 triangles, and has room for 4"),
        (with(80, &count(1_000_000_000)), "says that it has 1000000000 triangles, and has room for 4"),
        (with(80, &count(u32::MAX)), "says that it has 4294967295 triangles"),
        (with(80, &count(0)), "no triangles"),
        (whole[..whole.len() - 1].to_vec(), "has room for 3"),
        (whole[..85].to_vec(), "has room for 0"),
        (whole[..84].to_vec(), "has room for 0"),
        (whole[..83].to_vec(), "at byte 83: the file is cut off"),
        (whole[..40].to_vec(), "at byte 40: the file is cut off"),
        (none, "no triangles"),
        (flat, "no face of the mesh has an area"),
        (vec![0; 84], "no triangles"),
        (vec![0; 200], "no triangles"),
        (vec![255; 84], "has room for 0"),
        (vec![255; 200], "has room for 2"),
        (b"\0".to_vec(), "at byte 1: the file is cut off"),
        (vec![7; 3], "at byte 3: the file is cut off"),
        (Vec::new(), "at byte 0: the file is cut off"),
    ];
    let files: Vec<(&[u8], &str)> = files.iter().map(|(bytes, says)| (&bytes[..], *says)).collect();
    all_refused("a.stl", &files);
}

#[test]
fn wrong_texts_are_refused() {
    let texts: [(&str, &str); 24] = [
        ("solid", "1:5: error: the file is cut off: it ends where `facet` or `endsolid` should be"),
        ("solid a\nendsolid a", "no triangles"),
        ("solid a\n", "1:7: error: the file is cut off"),
        ("solid a\nvertex 0 0 0", "2:1: error: `facet` or `endsolid` is expected here"),
        ("solid a\nfacet", "`normal` should be"),
        ("solid a\nfacet norm 0 0 1", "2:7: error: `normal` is expected"),
        ("solid a\nfacet normal 0 0", "the normal of a facet should be"),
        ("solid a\nfacet normal 0 0 1", "`outer` should be"),
        ("solid a\nfacet normal 0 0 1 inner", "`outer` is expected"),
        ("solid a\nfacet normal 0 0 1\nouter\nring", "4:1: error: `loop` is expected"),
        ("solid a\nfacet normal 0 0 1\nouter loop", "`vertex` should be"),
        ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "4:10: error: the file is cut off"),
        (
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan",
            "4:12: error: a coordinate is not a finite",
        ),
        (
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 1e999 0",
            "4:10: error: a coordinate is not a finite",
        ),
        ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 -inf 0", "not a finite"),
        ("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0,5 0", "4:10: error: a coordinate is no number"),
        (
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop",
            "5:1: error: `vertex` is expected",
        ),
        (
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 2 2 2\nendloop",
            "7:1: error: `endloop` is expected",
        ),
        (
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendsolid",
            "8:1: error: `endfacet` is expected",
        ),
        (
            "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet endsolid",
            "no face of the mesh has an area",
        ),
        (
            "solid a\nfacet normal 0 0 1 outer loop vertex 1 0 0 vertex 2 0 0 vertex 3 0 0 endloop endfacet endsolid",
            "no face of the mesh has an area",
        ),
        (
            "solid a\nfacet normal 0 0 1 outer loop vertex 1e306 0 0 vertex 0 1 0 vertex 0 0 0 endloop endfacet endsolid",
            "reaches farther",
        ),
        ("solid a\nendsolid a\nfacet normal", "3:1: error: `solid` is expected"),
        ("solid \u{1f600}\nfacet \u{1f600}", "2:7: error: `normal` is expected"),
    ];
    let files: Vec<(&[u8], &str)> = texts.iter().map(|(text, says)| (text.as_bytes(), *says)).collect();
    all_refused("a.stl", &files);
}
