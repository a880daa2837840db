//! PLY.

use super::mesh_files::MeshText;
use super::{all_refused, facts, refused};

/// A header with these lines between the format and its end, and what follows.
fn ascii(lines: &str, body: &str) -> Vec<u8> {
    format!("ply\nformat ascii 1.0\n{lines}\nend_header\n{body}").into_bytes()
}

const CORNERS: &str = "element vertex 3\nproperty float x\nproperty float y\nproperty float z";
const FACES: &str = "element face 1\nproperty list uchar int vertex_index";
const PLACES: &str = "0 0 0\n1 0 0\n0 1 0\n";

#[test]
fn elements_come_in_any_order_and_with_more_than_ray13_shows() {
    let lines = format!(
        "{FACES}\nelement empty 1000000000000\nelement edge 1\nproperty list int double length\n{CORNERS}\nproperty float nx"
    );
    let body = "3 0 1 2\n2 0.5 nan\n0 0 0 9\n1 0 0 inf\n0 1 0 9\n";
    let triangle = facts("a.ply", &ascii(&lines, body));
    assert_eq!((triangle.triangles, triangle.open_edges), (1, 3));
}

#[test]
fn lines_of_a_header_end_as_they_like() {
    let text = MeshText::brick().ply_ascii().replace('\n', "\r\n");
    assert!(facts("standard input", text.as_bytes()).is_solid);
}

#[test]
fn wrong_texts_are_refused() {
    let both = format!("{CORNERS}\n{FACES}");
    let files = [
        (b"ply\n".to_vec(), "1:3: error: the file is cut off: it ends where `end_header`"),
        (b"ply\nformat ascii 1.0\n".to_vec(), "it ends where `end_header`"),
        (b"ply\nend_header\n".to_vec(), "2:1: error: `format` in the lines before is expected"),
        (b"ply\nformat utf8 1.0\n".to_vec(), "2:8: error: `ascii`, `binary_little_endian`"),
        (ascii("", ""), "no triangles"),
        (ascii("element", ""), "the name of an element is expected"),
        (ascii("element vertex", ""), "the number of elements is expected"),
        (ascii("element vertex -3", ""), "3:16: error: the number of elements is expected"),
        (ascii("property float x", ""), "`element` is expected"),
        (ascii("element vertex 1\nproperty real x", ""), "4:10: error: a type such as"),
        (
            ascii("element face 1\nproperty list float int vertex_index", ""),
            "a type of whole numbers is expected",
        ),
        (ascii("element face 1\nproperty list uchar int", ""), "the name of a property is expected"),
        (ascii("elephant", ""), "3:1: error: a line of a PLY header is expected"),
        (ascii("element vertex 3", ""), "`property float x` in the header"),
        (ascii("element vertex 3\nproperty float x", "1 2 3"), "corners with `x`, `y` and `z`"),
        (
            ascii(&format!("{CORNERS}\nelement face 1\nproperty int vertex_index"), PLACES),
            "faces with a list",
        ),
        (ascii(&both, "0 0 0 1 0 0 0 1"), "it ends where a coordinate"),
        (ascii(&both, "0 0 0 1 0 nan 0 1 0 3 0 1 2"), "10:11: error: a coordinate is not a finite"),
        (ascii(&both, "0 0 0 1 0 1e999 0 1 0 3 0 1 2"), "not a finite"),
        (ascii(&both, "0 0 0 1 0 x 0 1 0 3 0 1 2"), "10:11: error: a coordinate is no number"),
        (ascii(&both, &format!("{PLACES}3 0 1 3")), "13:7: error: a face names corner 3"),
        (ascii(&both, &format!("{PLACES}3 0 1 -1")), "numbered from 0 to 2"),
        (ascii(&both, &format!("{PLACES}3 0 1 1e300")), "names corner 9223372036854775807"),
        (ascii(&both, &format!("{PLACES}3 0 1 0.5")), "the whole number of a corner is expected"),
        (ascii(&both, &format!("{PLACES}3 0 1")), "it ends where the number of a corner"),
        (ascii(&both, &format!("{PLACES}2 0 1")), "a face has 2 corners"),
        (ascii(&both, &format!("{PLACES}-3 0 1 2")), "13:1: error: the length of a list is expected"),
        (ascii(&both, &format!("{PLACES}4294967295 0 1 2")), "it ends where the number of a corner"),
        (ascii(&both, &format!("{PLACES}3 0 0 0")), "no face of the mesh has an area"),
        (ascii(&both.replace("vertex 3", "vertex 1000000000"), PLACES), "it ends where a coordinate"),
        (
            ascii(&both.replace("face 1", "face 18446744073709551615"), &format!("{PLACES}3 0 1 2")),
            "where the length",
        ),
        (ascii(FACES, "3 0 1 2"), "there are no corners before it"),
    ];
    let files: Vec<(&[u8], &str)> = files.iter().map(|(bytes, says)| (&bytes[..], *says)).collect();
    all_refused("a.ply", &files);
}

#[test]
fn wrong_binary_files_are_refused() {
    let brick = MeshText::brick();
    let (little, big) = (brick.ply_little(), brick.ply_big());
    let header = |bytes: &[u8]| bytes.windows(11).position(|part| part == b"end_header\n").unwrap() + 11;
    let (of_little, of_big) = (header(&little), header(&big));
    let with = |bytes: &[u8], at: usize, part: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes[at..at + part.len()].copy_from_slice(part);
        bytes
    };
    // Of the little one a corner has 13 bytes, a face 17.
    let faces = of_little + 8 * 13;
    let renamed = |bytes: &[u8], from: &[u8], to: &[u8]| {
        assert_eq!(from.len(), to.len());
        let at = bytes.windows(from.len()).position(|part| part == from).unwrap();
        with(bytes, at, to)
    };
    let files = [
        (little[..of_little].to_vec(), "vertex 0, at byte"),
        (little[..of_little + 3].to_vec(), "a coordinate should be"),
        (little[..of_little + 12].to_vec(), "a value should be"),
        (little[..faces].to_vec(), "face 0, at byte"),
        (little[..=faces].to_vec(), "the number of a corner should be"),
        (little[..little.len() - 1].to_vec(), "face 5, at byte"),
        (with(&little, of_little, &f32::NAN.to_le_bytes()), "vertex 0, at byte"),
        (with(&little, of_little + 13, &f32::INFINITY.to_le_bytes()), "vertex 1, at byte"),
        (with(&little, faces, &[2]), "a face has 2 corners"),
        (with(&little, faces, &[0]), "a face has 0 corners"),
        (with(&little, faces, &[255]), "which there is not"),
        (with(&little, faces + 1, &8_i32.to_le_bytes()), "names corner 8"),
        (with(&little, faces + 1, &(-1_i32).to_le_bytes()), "names corner -1"),
        (with(&little, faces + 1, &i32::MIN.to_le_bytes()), "numbered from 0 to 7"),
        (renamed(&little, b"vertex 8", b"vertex 9"), "at byte"),
        (renamed(&little, b"face 6", b"face 7"), "face 6, at byte"),
        (renamed(&little, b"binary_little_endian", b"binary_big_endian   "), "at byte"),
        (renamed(&little, b"binary_little_endian", b"ascii               "), "error"),
        (big[..of_big + 30].to_vec(), "vertex 1, at byte"),
        (big[..big.len() - 2].to_vec(), "face 5, at byte"),
        (with(&big, of_big, &f64::NAN.to_be_bytes()), "a coordinate is not a finite"),
        (with(&big, big.len() - 4, &(-1_i32).to_be_bytes()), "face 5, at byte"),
        (with(&big, of_big, &1e306_f64.to_be_bytes()), "reaches farther"),
    ];
    let files: Vec<(&[u8], &str)> = files.iter().map(|(bytes, says)| (&bytes[..], *says)).collect();
    all_refused("a.ply", &files);
}

#[test]
fn a_billion_announced_faces_take_no_memory() {
    let text = MeshText::brick().ply_ascii().replace("face 6", "face 1000000000");
    assert!(refused("a.ply", text.as_bytes()).contains("the file is cut off"));
}
