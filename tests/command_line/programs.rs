//! OpenSCAD's programs, `.scad`: read by OpenSCAD where it is installed, and what is said where not.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use super::{fails, run, scene, text};

/// Runs the program where the path has nothing but this folder.
fn run_on_path(folder: &Path, arguments: &[&str]) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.args(arguments).env("PATH", folder).stdin(Stdio::null()).output().unwrap()
}

/// A folder with a script in place of OpenSCAD.
#[cfg(unix)]
fn in_place_of_openscad(test: &str, script: &str) -> (std::path::PathBuf, String) {
    use std::os::unix::fs::PermissionsExt;
    let (folder, file) = scene(test, "");
    let program = folder.join("part.scad");
    fs::rename(file, &program).unwrap();
    let path = folder.join("openscad");
    // The path has nothing else.
    fs::write(&path, format!("#!/bin/sh\nPATH=/usr/bin:/bin\n{script}")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    (folder, program.to_str().unwrap().to_owned())
}

fn openscad_is_missing() -> bool {
    let is_missing = Command::new("openscad").arg("--version").output().is_err();
    if is_missing {
        eprintln!("skipped: openscad is not installed");
    }
    is_missing
}

/// A program in a folder of its own.
fn program(test: &str, text: &str) -> (std::path::PathBuf, String) {
    let (folder, file) = scene(test, "");
    fs::remove_file(file).unwrap();
    let path = folder.join("a part.scad");
    fs::write(&path, text).unwrap();
    (folder, path.to_str().unwrap().to_owned())
}

const LEVELS: [&str; 5] = ["render", "--format", "levels", "--dots", "40x30"];

#[test]
fn have_the_picture_of_what_they_make() {
    if openscad_is_missing() {
        return;
    }
    let (folder, file) = program(
        "programs",
        "include <lib.scad>\nsize = 1;\necho(\"made\", size);\nfor (i = [0:2]) translate([2 * i, 0, 0]) part(size);\n",
    );
    fs::write(folder.join("lib.scad"), "module part(s) cube(s);\n").unwrap();
    let csg = folder.join("same.csg");
    let boxes = |size: &str| {
        let moved = |x: u32| format!("translate([{x}, 0, 0]) cube({size});");
        [0, 2, 4].map(moved).concat()
    };
    fs::write(&csg, boxes("1")).unwrap();
    let levels = |more: &[&str]| run(&[&LEVELS[..], more].concat());
    let same = levels(&[csg.to_str().unwrap()]);
    let made = levels(&[&file]);
    assert_eq!(text(&made.stdout), text(&same.stdout), "{}", text(&made.stderr));
    assert!(text(&made.stderr).contains("OpenSCAD: ECHO: \"made\", 1"), "{}", text(&made.stderr));

    fs::write(&csg, boxes("1.5")).unwrap();
    let same = levels(&[csg.to_str().unwrap()]);
    let set = folder.join("sets.json");
    fs::write(&set, r#"{"parameterSets": {"tall": {"size": "1.5"}}, "fileFormatVersion": "1"}"#).unwrap();
    let told = [&["-D", "size=1.5", &file][..], &["-p", set.to_str().unwrap(), "-P", "tall", &file]];
    for told in told {
        let made = levels(told);
        assert!(made.status.success(), "{told:?}: {}", text(&made.stderr));
        assert_eq!(text(&made.stdout), text(&same.stdout), "{told:?}");
    }
    assert!(run(&["check", &file]).status.success());
    assert!(run(&["snapshot", "--update", &file]).status.success());
    assert!(run(&["snapshot", &file]).status.success());
    assert!(!run(&["snapshot", "-D", "size=3", &file]).status.success());
}

#[test]
fn are_known_on_standard_input_by_what_openscad_is_told() {
    if openscad_is_missing() {
        return;
    }
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.args(["check", "-", "-D", "n=3"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = ray13.spawn().unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(b"n = 1; for (i = [1:n]) translate([3 * i, 0, 0]) cube(1);")
        .unwrap();
    let said = text(&child.wait_with_output().unwrap().stdout);
    assert!(said.contains("3 primitives"), "{said}");
}

#[test]
fn are_wrong_in_lines_of_their_own() {
    if openscad_is_missing() {
        return;
    }
    for (program_text, says) in [
        ("cube(1);\ncube(1;\n", "line 2"),
        ("cube(1);\nassert(false, \"too thin\");\n", "too thin"),
        ("cube(1);\nechoo(1);\n", ""),
    ] {
        let (_, file) = program("programs_wrong", program_text);
        let output = run(&["check", &file]);
        let message = text(&output.stderr);
        if says.is_empty() {
            assert!(
                output.status.success() && message.contains("WARNING: Ignoring unknown module 'echoo'"),
                "{message}"
            );
        } else {
            assert!(fails(&output, 2).contains(says) && message.contains("a part.scad"), "{message}");
        }
    }
}

#[test]
fn are_noted_and_wrong_in_what_openscad_wrote() {
    if openscad_is_missing() {
        return;
    }
    let kept = "`openscad -o FILE.csg ";
    let (_, file) = program("programs_noted", "cube(1);\nscale([1, 1, 0]) cube(2);\n");
    let noted = run(&["check", &file]);
    let message = text(&noted.stderr);
    assert!(noted.status.success() && message.contains("in what OpenSCAD wrote, line 2: "), "{message}");
    assert!(message.contains(kept) && message.contains("a part.scad` keeps"), "{message}");
    let (_, file) = program("programs_empty", "sphere(0);\n");
    let message = fails(&run(&["check", &file]), 2);
    assert!(message.contains("as OpenSCAD's .csg") && message.contains(kept), "{message}");
    let (_, file) = program("programs_right", "cube(1);\n");
    assert_eq!(text(&run(&["check", &file]).stderr), "");
}

#[test]
fn need_openscad() {
    let (folder, file) = program("programs_missing", "cube(1);");
    let message = fails(&run_on_path(&folder, &["check", &file]), 2);
    assert!(message.contains("has to be installed") && message.contains("apt install openscad"), "{message}");
    let message = fails(&run(&["check", folder.join("none.scad").to_str().unwrap()]), 2);
    assert!(message.contains("No such file"), "{message}");
    let message = fails(&run(&["check", "-D", "a=1", "part.csg"]), 2);
    assert!(message.contains("no program of OpenSCAD"), "{message}");
    fails(&run(&["check", "-D", "a", &file]), 2);
    fails(&run(&["check", "-P", "a", &file]), 2);
}

/// What is left of a run: neither the program nor its folder.
#[cfg(unix)]
#[test]
fn are_ended_in_time() {
    let (folder, file) = in_place_of_openscad("programs_slow", "echo $$ > \"${0%/*}/pid\"\nsleep 100\n");
    let temporary = folder.join("tmp");
    fs::create_dir(&temporary).unwrap();
    let ray13 = |time: &str| {
        let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
        ray13.args(["check", "--openscad-time", time, &file]).env("PATH", &folder).env("TMPDIR", &temporary);
        ray13.stdin(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let is_alive = || {
        let pid = fs::read_to_string(folder.join("pid")).unwrap_or_default();
        !pid.is_empty() && Path::new("/proc").join(pid.trim()).exists()
    };
    let message = fails(&ray13("200ms").wait_with_output().unwrap(), 2);
    assert!(message.contains("longer than 0.2 s"), "{message}");
    assert!(!is_alive());

    fs::remove_file(folder.join("pid")).unwrap();
    let mut slow = ray13("60s");
    let deadline = Instant::now() + Duration::from_secs(60);
    while !is_alive() {
        assert!(Instant::now() < deadline, "it has not begun");
        std::thread::sleep(Duration::from_millis(5));
    }
    let pid = slow.id().to_string();
    assert!(Command::new("kill").args(["-s", "INT", &pid]).status().unwrap().success());
    let status = slow.wait().unwrap();
    assert_eq!(std::os::unix::process::ExitStatusExt::signal(&status), Some(2));
    assert!(!is_alive());
    assert_eq!(fs::read_dir(&temporary).unwrap().count(), 0, "a folder is left");
}

/// An endless file, and endless words, are ended, and little of them is kept.
#[cfg(unix)]
#[test]
fn are_bounded() {
    let (folder, file) = in_place_of_openscad("programs_large", "truncate -s 300M \"$2\"; sleep 100\n");
    let message = fails(&run_on_path(&folder, &["check", &file]), 2);
    assert!(message.contains("more than 256 MiB"), "{message}");
    let (folder, file) = in_place_of_openscad(
        "programs_loud",
        "yes WARNING: no | head -c 9000000 >&2; echo 'cube(1);' > \"$2\"\n",
    );
    let output = run_on_path(&folder, &["check", "--openscad-time", "30s", &file]);
    let message = text(&output.stderr);
    assert!(output.status.success() && message.len() < 4000, "{message}");
    assert!(message.contains("lines more"), "{message}");
}
