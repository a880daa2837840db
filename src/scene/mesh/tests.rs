//! What the readers of meshes give, and what they say of files that are wrong.

#[path = "../../../tests/support/mesh_files.rs"]
mod mesh_files;
mod mutations;
mod obj;
mod objects;
mod off;
mod parts;
mod ply;
mod stl;

use crate::scene::{Diagnostics, MeshFacts, ReadOptions, Scene, UpAxis, read};
use mesh_files::MeshText;

/// Up as most formats have it: facts and places are then those of the file.
fn options() -> ReadOptions {
    ReadOptions { up: Some(UpAxis::Z), ..ReadOptions::default() }
}

fn scene(name: &str, bytes: &[u8]) -> Scene {
    read(name, bytes, &options()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// What the only part of a mesh is.
fn facts(name: &str, bytes: &[u8]) -> MeshFacts {
    let mut meshes = scene(name, bytes).meshes;
    assert_eq!(meshes.len(), 1, "{name}");
    meshes.remove(0)
}

/// What is wrong with a file, which is told at a place within it.
fn refused(name: &str, bytes: &[u8]) -> String {
    let errors = read(name, bytes, &options()).expect_err(&String::from_utf8_lossy(bytes));
    check_places(&errors);
    errors.to_string()
}

fn check_places(errors: &Diagnostics) {
    assert!(!errors.list.is_empty());
    for diagnostic in &errors.list {
        assert!(errors.source.get(diagnostic.span.clone()).is_some(), "{diagnostic:?}");
    }
}

/// Checks that each of some files is refused, with words that say why and where.
fn all_refused(name: &str, files: &[(&[u8], &str)]) {
    assert!(files.len() >= 20);
    for (bytes, says) in files {
        let message = refused(name, bytes);
        assert!(message.contains(says), "{}\n{message}\ninstead of: {says}", bytes.escape_ascii());
        assert!(message.starts_with(name), "{message}");
    }
}

/// Editors of Windows put it before a text; an STL was then taken for a binary one that is cut off.
#[test]
fn a_byte_order_mark_is_passed_over() {
    for (name, bytes) in MeshText::brick().files() {
        let marked = [&b"\xef\xbb\xbf"[..], &bytes].concat();
        if std::str::from_utf8(&bytes).is_ok_and(|text| !text.contains('\0')) {
            assert_eq!(facts(name, &marked), facts(name, &bytes), "{name}");
        }
    }
}

#[test]
fn every_format_gives_the_same_solid() {
    for (mesh, corners, triangles, volume) in
        [(MeshText::brick(), 8, 12, 9.0), (MeshText::tetrahedron(), 4, 4, 0.848_958_333_333)]
    {
        let files = mesh.files();
        let (_, first) = &files[0];
        let solid = scene("a.stl", first);
        let scad = read("a.scene", mesh.polyhedron().as_bytes(), &ReadOptions::default()).unwrap();
        for (name, bytes) in &files {
            let facts = facts(name, bytes);
            let what = format!("{name}: {facts}");
            assert_eq!((facts.triangles, facts.corners, facts.shells), (triangles, corners, 1), "{what}");
            assert!(facts.is_solid && facts.is_closed(), "{what}");
            assert!((facts.volume.unwrap() - volume).abs() < 1e-9, "{what}");
            let scene = scene(name, bytes);
            assert_eq!((scene.objects.len(), scene.notes.len()), (1, 0), "{name}");
            let bounds = |scene: &Scene| {
                let mut bounds = None;
                scene.objects[0].solid.visit(&mut |primitive| bounds = Some(primitive.shape.bounds()));
                bounds
            };
            assert_eq!(bounds(&scene), bounds(&solid), "{name}");
            assert_eq!(bounds(&scene), bounds(&scad), "{name}");
        }
    }
}

#[test]
fn content_tells_the_format_whatever_the_name() {
    for (_, bytes) in MeshText::brick().files() {
        for name in ["standard input", "part.csg", "part.scene", "part.nff", "part.stl", "part.obj"] {
            assert_eq!(facts(name, &bytes).triangles, 12, "{name}");
        }
    }
}

#[test]
fn y_is_up_in_obj_and_z_in_all_others() {
    for (name, bytes) in MeshText::brick().files() {
        let height = |up| {
            let scene = read(name, &bytes, &ReadOptions { up, ..ReadOptions::default() }).unwrap();
            let mut height = 0.0;
            scene.objects[0].solid.visit(&mut |primitive| height = primitive.shape.bounds().hi.z);
            height
        };
        assert_eq!((height(Some(UpAxis::Y)), height(Some(UpAxis::Z))), (1.5, 3.0), "{name}");
        assert_eq!(height(None), if name == "part.obj" { 1.5 } else { 3.0 }, "{name}");
    }
    let errors = read("a.scene", b"cube(1);", &options()).unwrap_err().to_string();
    assert!(errors.contains("for meshes only"), "{errors}");
}

#[test]
fn memory_is_counted() {
    let bytes = MeshText::brick().stl_binary(b"");
    let limited =
        |memory| read("a.stl", &bytes, &ReadOptions { memory: Some(memory), ..ReadOptions::default() });
    assert!(limited(bytes.len() as u64).unwrap_err().to_string().contains("--memory"));
    assert!(limited(1 << 20).is_ok());
}
