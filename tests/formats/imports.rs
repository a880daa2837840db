//! Scenes that import meshes: the picture is that of the same solid as a `polyhedron`, what may not or can
//! not be read is said at its place, and no picture takes a file's place.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::support::mesh_files::{MeshText, gzip};

/// An empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("imports").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("scenes")).unwrap();
    folder
}

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path
}

fn ray13(at: &Path, arguments: &[&str]) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.current_dir(at).args(arguments).stdin(Stdio::null()).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const LEVELS: [&str; 5] = ["render", "--format", "levels", "--dots", "60x40"];

/// The levels of a scene, of which nothing is to be said.
#[track_caller]
fn levels(at: &Path, file: &str) -> String {
    let output = ray13(at, &[&LEVELS[..], &[file]].concat());
    assert!(output.status.success() && output.stderr.is_empty(), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// What is wrong with a scene.
#[track_caller]
fn wrong(at: &Path, arguments: &[&str], says: &[&str]) {
    let output = ray13(at, arguments);
    let message = text(&output.stderr);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{message}");
    for part in says {
        assert!(message.contains(part), "{message}\ninstead of: {part}");
    }
}

#[test]
fn what_is_imported_is_a_solid_like_any_other() {
    let at = folder("solid");
    let brick = MeshText::brick();
    let uses = |part: &str| {
        [
            format!("{part}\n"),
            format!("color(\"red\") difference() {{ {part} translate([1, .7, 3]) sphere(.6); }}"),
            format!("intersection() {{ sphere(1.8); scale(.9) {part} }}"),
            format!("hull() {{ {part} translate([0, 0, 4]) cube(1); }}"),
            format!("rotate([20, 30, 40]) {{ {part} translate([3, 0, 0]) {part} }}"),
        ]
    };
    for (number, solid) in uses(&brick.polyhedron()).into_iter().enumerate() {
        write(&at, "solid.scene", &solid);
        let expected = levels(&at, "solid.scene");
        for (name, bytes) in brick.files() {
            write(&at, name, bytes);
            write(&at, "part.scene", &uses(&format!("import(\"{name}\");"))[number]);
            assert_eq!(levels(&at, "part.scene"), expected, "{solid} from {name}");
            // As OpenSCAD writes it, from elsewhere.
            let call = format!(
                "import(file = \"{name}\", layer = \"\", origin = [0, 0], scale = 1, convexity = 1, $fn = 0, \
                 $fa = 12, $fs = 2, timestamp = 1700000000);"
            );
            write(&at, "part.csg", &uses(&call)[number]);
            assert_eq!(levels(Path::new("/"), &at.join("part.csg").display().to_string()), expected);
            if number > 0 {
                break;
            }
        }
    }
}

/// A part of its own stays one where it overlaps another: in OpenSCAD both are there.
#[test]
fn the_parts_of_a_file_are_united() {
    let at = folder("parts");
    let brick = MeshText::brick();
    let mut moved = brick.clone();
    moved.points.iter_mut().for_each(|point| point[0] += 1.0);
    write(&at, "two.stl", brick.stl_text() + &moved.stl_text());
    write(&at, "two.scene", "import(\"two.stl\");");
    write(&at, "one.scene", "cube([3, 1.5, 3]);");
    assert_eq!(levels(&at, "two.scene"), levels(&at, "one.scene"));
    let said = text(&ray13(&at, &["check", "two.scene"]).stdout);
    assert_eq!(
        said.matches("text STL, z up, `two.stl a part`: 12 triangles, 8 corners, closed").count(),
        2,
        "{said}"
    );
}

#[test]
fn an_open_mesh_is_an_error_that_names_an_edge() {
    let at = folder("open");
    let mut brick = MeshText::brick();
    brick.faces.remove(0);
    write(&at, "open.off", brick.off());
    write(&at, "a.scene", "cube(1);\n  import(\"open.off\");");
    let says = "a.scene:2:10";
    let edge = "`open.off` can not be imported: the mesh is not closed: nothing meets its edge from [0, 0, 0] to [2, 0, 0]";
    wrong(&at, &["check", "a.scene"], &[says, edge]);
    // In what a program wrote it is left out, as an open `polyhedron` is.
    write(&at, "a.csg", "cube(1);\n  import(\"open.off\");");
    let output = ray13(&at, &["check", "a.csg"]);
    let said = text(&output.stderr);
    assert!(
        output.status.success() && said.contains("line 2: `import` is left out") && said.contains(edge),
        "{said}"
    );
}

#[test]
fn what_lies_elsewhere_is_read_where_that_is_allowed() {
    let at = folder("elsewhere");
    let brick = MeshText::brick();
    write(&at, "part.stl", brick.stl_binary(b""));
    let scenes = at.join("scenes");
    write(&scenes, "beside.stl", brick.stl_binary(b""));
    write(&scenes, "up.scene", "import(\"../part.stl\");");
    let outside = "`../part.stl` can not be imported: it lies outside of the scene's folder";
    wrong(&at, &["check", "scenes/up.scene"], &["up.scene:1:8", outside, "--root ."]);
    wrong(&scenes, &["check", "up.scene"], &[outside, "--root .."]);
    for root in ["..", "../../elsewhere"] {
        assert!(ray13(&scenes, &["check", "--root", root, "up.scene"]).status.success());
    }
    wrong(&scenes, &["check", "--root", "nowhere", "up.scene"], &["there is no such folder"]);
    // By its whole path, and through a link that leads out.
    let whole = scenes.join("beside.stl").display().to_string();
    write(&scenes, "whole.scene", format!("import(\"{whole}\");"));
    assert!(ray13(&at, &["check", "scenes/whole.scene"]).status.success());
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../part.stl", scenes.join("link.stl")).unwrap();
        write(&scenes, "link.scene", "import(\"link.stl\");");
        wrong(&scenes, &["check", "link.scene"], &["`link.stl` can not be imported: it lies outside"]);
        assert!(ray13(&scenes, &["check", "--root", "..", "link.scene"]).status.success());
    }
}

#[test]
fn what_can_not_be_read_is_said_at_its_place() {
    let at = folder("wrong");
    write(&at, "cut.stl", &MeshText::brick().stl_binary(b"")[..300]);
    write(&at, "far.obj", MeshText::brick().obj().replace("f 3//1", "f 99//1"));
    write(&at, "twice.stl", gzip(&gzip(&MeshText::brick().stl_binary(b""))));
    write(&at, "other.scene", "cube(1);");
    write(&at, "a.DXF", "0\nSECTION\nSVG\n");
    write(&at, "flat.off", "OFF 3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
    for (call, says) in [
        ("import(\"none.stl\");", "a.scene:1:8: error: `none.stl` can not be imported: No such file"),
        ("import(\"scenes\");", "it is no plain file"),
        ("import(\"cut.stl\");", "the header, at byte 80: the file is cut off"),
        ("import(\"far.obj\");", "a face names corner 99"),
        ("import(\"twice.stl\");", "it is a gzip archive, not a mesh"),
        ("import(\"other.scene\");", "it is no mesh: STL, OFF, PLY, OBJ, 3MF and AMF are read"),
        ("import(\"flat.off\");", "not closed"),
        ("import(file = \"a.DXF\", layer = \"x\");", "`a.DXF` can not be imported: line 3: a group code"),
        ("import(file = \"a.DXF\", layer = 5);", "`layer` of `import` takes a text"),
        ("import(file = \"a.DXF\", origin = 5);", "`origin` of `import` takes [x, y, z] or [x, y]"),
        ("import();", "`import` needs `file`"),
        ("import(5);", "`file` of `import` takes a text"),
        ("import(\"\");", "`file` of `import` takes a text"),
    ] {
        write(&at, "a.scene", call);
        let output = ray13(&at, &["check", "a.scene"]);
        let message = text(&output.stderr).replace('\n', " ");
        assert_eq!(output.status.code(), Some(2), "{message}");
        let place = says.strip_prefix("a.scene:1:8: error: ").map_or(says, |rest| rest);
        assert!(message.contains(place) && message.contains("a.scene:1:"), "{message}\ninstead of: {says}");
    }
    let brick = write(&at, "part.stl", MeshText::brick().stl_binary(b""));
    write(&at, "a.scene", "import(\"part.stl\", scale = 2, center = true);");
    let said = text(&ray13(&at, &["check", "a.scene"]).stderr);
    assert!(said.contains("`scale` of `import` has no effect") && said.contains("`center`"), "{said}");
    let small = fs::metadata(brick).unwrap().len().to_string();
    wrong(&at, &["check", "--memory", &small, "a.scene"], &["more than the", "--memory"]);
}

/// The picture would be what the scene is made of.
#[test]
fn no_picture_takes_the_place_of_what_is_imported() {
    let at = folder("kept");
    let brick = MeshText::brick().stl_binary(b"");
    write(&at, "part.stl", &brick);
    write(&at, "a.scene", "import(\"part.stl\");");
    let lost = "part.stl is a file that the scene is read from";
    wrong(&at, &["render", "--format", "txt", "a.scene", "-o", "part.stl"], &[lost]);
    wrong(&at.join("scenes"), &["render", "--format", "txt", "../a.scene", "-o", "../part.stl"], &[lost]);
    assert_eq!(fs::read(at.join("part.stl")).unwrap(), brick);
}

#[test]
fn what_standard_input_names_lies_in_the_working_folder() {
    let at = folder("input");
    write(&at, "part.stl", MeshText::brick().stl_binary(b""));
    write(&at, "a.scene", "import(\"part.stl\");");
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    let scene = fs::File::open(at.join("a.scene")).unwrap();
    let output = ray13.current_dir(&at).args(["check", "-"]).stdin(scene).output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// OpenSCAD writes names from the program's folder on, wherever the `.csg` is.
#[test]
fn a_program_imports_from_its_own_folder() {
    if !Command::new("openscad").arg("--version").output().is_ok_and(|it| it.status.success()) {
        eprintln!("skipped: openscad is not installed");
        return;
    }
    let at = folder("program");
    write(&at, "part.stl", MeshText::brick().stl_binary(b""));
    let scenes = at.join("scenes");
    write(&scenes, "beside.stl", MeshText::brick().stl_binary(b""));
    write(&scenes, "a.scad", "for (i = [0, 4]) translate([i, 0, 0]) import(\"beside.stl\");");
    write(&scenes, "a.scene", "import(\"beside.stl\"); translate([4, 0, 0]) import(\"beside.stl\");");
    let render = |file: &str| text(&ray13(&at, &[&LEVELS[..], &[file]].concat()).stdout);
    assert_eq!(render("scenes/a.scad"), render("scenes/a.scene"));
    write(&scenes, "up.scad", "import(\"../part.stl\");");
    let outside = ray13(&at, &["check", "scenes/up.scad"]);
    assert!(
        text(&outside.stderr).contains("lies outside of the scene's folder"),
        "{}",
        text(&outside.stderr)
    );
    assert!(ray13(&at, &["check", "--root", ".", "scenes/up.scad"]).status.success());
    let lost = ray13(&at, &["render", "--format", "txt", "scenes/a.scad", "-o", "scenes/beside.stl"]);
    assert!(text(&lost.stderr).contains("beside.stl is a file that the scene is read from"));
}
