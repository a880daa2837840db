//! Mesh files as a person opens them: the picture is that of the same solid in OpenSCAD's words, `check` says
//! what it is, and what is wrong has a place.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::support::mesh_files::MeshText;

fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("meshes");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path
}

fn ray13(arguments: &[&str], file: &Path) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.args(arguments).arg(file).stdin(Stdio::null()).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The levels of a file, of which nothing is to be said.
#[track_caller]
fn levels(file: &Path, more: &[&str]) -> String {
    let arguments = [&["render", "--format", "levels", "--dots", "60x40"], more].concat();
    let output = ray13(&arguments, file);
    assert!(output.status.success() && output.stderr.is_empty(), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn every_format_has_the_picture_of_openscads_polyhedron() {
    for (number, mesh) in [MeshText::brick(), MeshText::tetrahedron()].into_iter().enumerate() {
        let scad = levels(&file(&format!("{number}.csg"), mesh.polyhedron().as_bytes()), &[]);
        assert!(scad.contains(|level: char| level.is_alphanumeric() && level != '0'), "a picture: {scad}");
        for (name, bytes) in mesh.files() {
            let mesh = file(&format!("{number}-{name}"), &bytes);
            for engine in ["auto", "exact"] {
                let shown = levels(&mesh, &["--up", "z", "--engine", engine]);
                assert_eq!(shown, scad, "{} by {engine}", mesh.display());
            }
        }
    }
}

#[test]
fn a_brick_has_the_picture_of_openscads_cube() {
    let cube = levels(&file("cube.csg", b"cube(size = [2, 1.5, 3]);"), &[]);
    for (name, bytes) in MeshText::brick().files() {
        assert_eq!(levels(&file(name, &bytes), &["--up", "z"]), cube, "{name}");
    }
}

/// An OBJ file has y up: its picture is that of the solid stood up by a rotation.
#[test]
fn y_is_turned_up() {
    let brick = MeshText::brick();
    let turned = format!("rotate([90, 0, 0]) {}", brick.polyhedron());
    let turned = levels(&file("turned.csg", turned.as_bytes()), &[]);
    assert_eq!(levels(&file("up.obj", brick.obj().as_bytes()), &[]), turned);
    assert_eq!(levels(&file("up.off", brick.off().as_bytes()), &["--up", "y"]), turned);
    let scene = ray13(&["render", "--up", "y"], &file("up.csg", b"cube(1);"));
    assert_eq!(scene.status.code(), Some(2));
    assert!(text(&scene.stderr).contains("for meshes only"), "{}", text(&scene.stderr));
}

#[test]
fn check_says_what_a_mesh_is() {
    let brick = MeshText::brick();
    let path = file("said.stl", &brick.stl_binary(b"solid"));
    let said = ray13(&["check"], &path);
    let expected = format!(
        "{}: 1 object, 1 primitive, 1 material, 0 lights, 0 views\n\
         binary STL, z up: 12 triangles, 8 corners, closed, 1 shell, volume 9, area 27, size 2 x 1.5 x 3\n",
        path.display()
    );
    assert_eq!((text(&said.stdout), text(&said.stderr)), (expected, String::new()));
    let up = ray13(&["check", "--up", "y"], &path);
    assert!(text(&up.stdout).contains("binary STL, y up"), "{}", text(&up.stdout));
}

/// Two bricks of one part, one a little off the other: each goes through the other. The place is that of the
/// file, whatever is up.
#[test]
fn check_says_where_a_mesh_crosses_itself() {
    let mut two = MeshText::brick();
    let moved: Vec<[f32; 3]> = two.points.iter().map(|[x, y, z]| [x + 1.0, y + 0.5, z + 0.25]).collect();
    let faces: Vec<Vec<u32>> =
        two.faces.iter().map(|face| face.iter().map(|corner| corner + 8).collect()).collect();
    two.faces.extend(faces);
    two.points.extend(moved);
    for up in ["y", "z"] {
        let said = text(&ray13(&["check", "--up", up], &file("crossing.stl", &two.stl_binary(b""))).stdout);
        let (_, place) = said.split_once(" pairs of triangles as at [").expect(&said);
        let place = place.split(']').next().unwrap().split(", ").map(|word| word.parse::<f64>().unwrap());
        let inside = [1.0..=2.0, 0.5..=1.5, 0.25..=3.0];
        assert!(place.zip(inside).all(|(x, range)| range.contains(&x)), "{said}");
    }
}

#[test]
fn an_open_mesh_is_shown_and_an_edge_is_named() {
    let mut brick = MeshText::brick();
    let closed = levels(&file("closed.off", brick.off().as_bytes()), &[]);
    // The bottom, which is not seen from above.
    brick.faces.remove(0);
    let open = file("open.off", brick.off().as_bytes());
    let shown = ray13(&["render", "--format", "levels", "--dots", "60x40"], &open);
    assert!(shown.status.success());
    assert_eq!(text(&shown.stdout), closed);
    assert!(
        text(&shown.stderr).contains("nothing meets its edge from [0, 0, 0] to [2, 0, 0]"),
        "{}",
        text(&shown.stderr)
    );
}

#[test]
fn colours_beside_an_obj_file_are_its_colours() {
    let obj = MeshText::brick().obj();
    let coloured = obj.replace("o part", "mtllib dark.mtl\no part\nusemtl dark");
    file("dark.mtl", b"newmtl dark\nKd 0.1 0.1 0.1\n");
    let dark = levels(&file("dark.obj", coloured.as_bytes()), &[]);
    let as_scene = format!("color([0.1, 0.1, 0.1]) rotate([90, 0, 0]) {}", MeshText::brick().polyhedron());
    assert_eq!(dark, levels(&file("dark.csg", as_scene.as_bytes()), &[]));
    assert_ne!(dark, levels(&file("light.obj", obj.as_bytes()), &[]));
    let missing = coloured.replace("dark.mtl", "../dark.mtl");
    let output = ray13(&["check"], &file("missing.obj", missing.as_bytes()));
    assert!(output.status.success());
    assert!(text(&output.stderr).contains("only a file beside the mesh is read"), "{}", text(&output.stderr));
}

#[test]
fn what_is_behind_the_end_is_said() {
    let brick = MeshText::brick();
    for (name, bytes, says) in [
        ("behind.off", (brick.off() + "3 0 1 2\n\n# no more\n").into_bytes(), "1 lines behind the last face"),
        ("behind.ply", (brick.ply_ascii() + "3 0 1 2\n").into_bytes(), "4 words behind the last element"),
        ("behind-binary.ply", [brick.ply_little(), vec![0; 9]].concat(), "9 bytes behind the last element"),
    ] {
        let output = ray13(&["check"], &file(name, &bytes));
        assert!(
            output.status.success() && text(&output.stderr).contains(says),
            "{name}: {}",
            text(&output.stderr)
        );
    }
}

#[test]
fn what_is_wrong_has_a_place() {
    let brick = MeshText::brick();
    let binary = brick.stl_binary(b"");
    let obj = brick.obj().replace("f 3//1", "f 99//1");
    for (name, bytes, says) in [
        ("cut.stl", &binary[..300], "says that it has 12 triangles, and has room for 4"),
        ("far.obj", obj.as_bytes(), "a face names corner 99"),
        ("cut.ply", &brick.ply_big()[..400], "at byte 400"),
        ("cut.off", b"OFF\n8 6 0\n0 0 0\n", "the file is cut off"),
        ("none.stl", b"solid nothing\nendsolid nothing\n", "no triangles"),
    ] {
        let output = ray13(&["render"], &file(name, bytes));
        let message = text(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{name}: {message}");
        assert!(message.contains(says) && message.contains(name), "{name}: {message}");
    }
}
