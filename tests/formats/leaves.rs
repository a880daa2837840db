//! What a program wrote wrong, as a user meets it: the rest is shown, and one line says what is not. And what
//! a program nests deeper than people do.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::{fs, thread};

use ray13::frame::Studio;
use ray13::scene::{ReadOptions, read};

fn file(name: &str, text: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("leaves");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn levels(path: &Path, more: &[&str]) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.arg("render").arg(path).args(["--format", "levels", "--dots", "24x24"]).args(more);
    ray13.stdin(Stdio::null()).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_picture_is_that_of_the_rest() {
    let whole = "difference() { cube(size = [4, 4, 4]); cylinder($fn = 0, $fa = 12, $fs = 2, h = 9, r1 = 1, r2 = 1); }";
    let rest = levels(&file("rest.csg", whole), &[]);
    let wrong = whole.replace(
        "cylinder(",
        "cube(size = [0, 1, 1]); cylinder($fn = 0, h = inf, r1 = 1, r2 = 1); cylinder(",
    );
    let scene = file("wrong.scene", &wrong);
    let (program, person) = (levels(&file("wrong.csg", &wrong), &[]), levels(&scene, &[]));
    assert!(program.status.success(), "{}", text(&program.stderr));
    assert_eq!(text(&program.stdout), text(&rest.stdout));
    assert_eq!(text(&program.stderr).lines().count(), 2, "{}", text(&program.stderr));
    assert_eq!(person.status.code(), Some(2), "a person mends it");
    assert_eq!(text(&levels(&scene, &["--skip-unsupported"]).stdout), text(&rest.stdout));
}

#[test]
fn an_intersection_with_something_unknown_is_not_its_other_child() {
    let unknown = "intersection() { roof() { circle(r = 5); } cube(size = [1000, 1000, 1000]); }";
    let (alone, both) = ("cube(size = [10, 1, 1]);", format!("{unknown}\ncube(size = [10, 1, 1]);"));
    let shown = levels(&file("unknown.csg", &both), &["--skip-unsupported"]);
    assert_eq!(text(&shown.stdout), text(&levels(&file("alone.csg", alone), &[]).stdout));
    assert!(text(&shown.stderr).contains("`intersection` is left out whole"), "{}", text(&shown.stderr));
    let none = levels(&file("none.csg", unknown), &["--skip-unsupported"]);
    let message = text(&none.stderr);
    assert_eq!(none.status.code(), Some(2));
    assert!(message.contains("nothing is left") && message.contains("`roof` is left out"), "{message}");
    assert!(!message.contains("add a solid"), "{message}");
}

#[test]
fn operators_two_thousand_deep_are_drawn() {
    let levels =
        "difference() { cube(9, center = true); intersection() { cube(8, center = true); ".repeat(999);
    let nested = format!("{levels}sphere(1);{}", "}".repeat(2 * 999));
    thread::scope(|scope| {
        // Half of what a thread gets by default.
        let small = thread::Builder::new().stack_size(1 << 20).spawn_scoped(scope, || {
            let scene = read("deep.csg", nested.as_bytes(), &ReadOptions::default()).expect("a scene");
            let studio = Studio::new(scene).expect("a solid");
            studio.camera(0, 1.0)
        });
        assert!(small.expect("a thread").join().is_ok());
    });
    for engine in ["exact", "fast"] {
        let drawn = self::levels(&file("deep.csg", &nested), &["--engine", engine, "--threads", "2"]);
        assert!(drawn.status.success(), "{engine}: {}", text(&drawn.stderr));
        assert!(text(&drawn.stdout).contains('9'), "{engine}: nothing is seen");
    }
}
