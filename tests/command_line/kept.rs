//! `diff` and `snapshot`: pictures that people keep beside their parts, and what changed since.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use crate::{done, fails, folder, run, text};

/// A folder with a scene in it, `part.csg`.
fn parts(test: &str) -> PathBuf {
    let folder = folder(test);
    fs::write(folder.join("part.csg"), "cube(2, center = true);\n").unwrap();
    folder
}

/// Exit code 1, a picture or lines on standard output and why on standard error; gives both.
#[track_caller]
fn differs(output: &Output) -> [String; 2] {
    let [shown, why] = [&output.stdout, &output.stderr].map(|bytes| text(bytes));
    assert_eq!(output.status.code(), Some(1), "{why}");
    assert!(!shown.is_empty() && !why.is_empty());
    [shown, why]
}

#[test]
fn a_part_is_kept_and_compared() {
    let folder = parts("kept");
    let part = folder.join("part.csg");
    let (part, kept) = (part.to_str().unwrap(), folder.join("part.levels"));
    // Not kept yet, then kept, then the same.
    let [missing, _] = differs(&run(&["snapshot", part]));
    assert!(missing.contains("part.levels: not kept yet, --update keeps it"), "{missing}");
    assert!(!kept.exists());
    assert!(text(&done(&run(&["snapshot", part, "--update"]))).contains("part.levels: written"));
    assert_eq!(fs::read_to_string(&kept).unwrap().lines().count(), 100);
    assert!(text(&done(&run(&["snapshot", part]))).contains("part.levels: same"));
    // A hole is seen, marked and counted; until it is kept.
    fs::write(part, "difference() { cube(2, center = true); cylinder(3, r = .5, center = true); }\n")
        .unwrap();
    let [shown, why] = differs(&run(&["snapshot", part]));
    assert!(shown.contains("of 16000 dots differ") && shown.lines().count() == 26, "{shown}");
    assert!(why.contains("1 of 1 pictures not as kept"), "{why}");
    let before = fs::read(&kept).unwrap();
    done(&run(&["snapshot", part, "--tolerance", "12"]));
    assert_eq!(fs::read(&kept).unwrap(), before);
    done(&run(&["snapshot", part, "--update"]));
    assert_ne!(fs::read(&kept).unwrap(), before);
    done(&run(&["snapshot", part]));
}

#[test]
fn each_named_view_has_its_picture() {
    let folder = parts("views");
    let scene = folder.join("die.scene");
    fs::write(
        &scene,
        "camera(name = \"front\", eye = [0, -9, 3]); camera(name = \"top\", eye = [0, -1, 9]); sphere(1);\n",
    )
    .unwrap();
    let scene = scene.to_str().unwrap();
    let written = text(&done(&run(&["snapshot", "--update", scene])));
    assert!(written.contains("die.front.levels: written") && written.contains("die.top.levels: written"));
    let one = text(&done(&run(&["snapshot", "--view", "top", scene])));
    assert!(one.contains("die.top.levels: same") && !one.contains("front"), "{one}");
    fails(&run(&["snapshot", "--eye", "1,2,3", scene]), 2);
    fails(&run(&["snapshot", "-"]), 2);
    fails(&run(&["snapshot"]), 2);
}

#[test]
fn two_pictures_are_compared() {
    let folder = parts("compared");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (part, kept, other) = (path("part.csg"), path("part.levels"), path("other.csg"));
    done(&run(&["render", &part, "--format", "levels", "--cells", "40x20", "-o", &kept]));
    // A scene has the dots of what it is compared with; two scenes those of a terminal.
    assert_eq!(text(&done(&run(&["diff", &kept, &part]))), "the same 6400 dots\n");
    assert_eq!(text(&done(&run(&["diff", &part, &part]))), "the same 16000 dots\n");
    assert_eq!(text(&done(&run(&["diff", &kept, &kept]))), "the same 6400 dots\n");
    fs::write(&other, "sphere(1.2);\n").unwrap();
    let [shown, why] = differs(&run(&["diff", &kept, &other]));
    assert_eq!(shown.lines().count(), 20, "{shown}");
    assert!(why.contains("of 6400 dots differ"), "{why}");
}

#[test]
fn what_can_not_be_compared_says_why() {
    let folder = parts("incomparable");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (small, large, broken) = (path("small.levels"), path("large.levels"), path("broken.levels"));
    fs::write(&small, "01\n23\n").unwrap();
    fs::write(&large, "012\n345\n").unwrap();
    fs::write(&broken, "01\n2Z\n").unwrap();
    for (arguments, why) in [
        ([&small, &large], "2 × 2 dots and"),
        ([&small, &broken], "line 2, column 2: 'Z' is no level"),
        ([&small, &path("none.levels")], "none.levels"),
        ([&small, &path("none.csg")], "none.csg"),
    ] {
        let message = fails(&run(&["diff", arguments[0], arguments[1]]), 2);
        assert!(message.contains(why), "{message}");
    }
}

/// From a merge that left `<<<<<<< HEAD` in a kept picture, which `--update` then refused to write.
#[test]
fn what_is_broken_or_shared_is_said_before_anything_is_written() {
    let folder = parts("broken");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (part, kept) = (path("part.csg"), path("part.levels"));
    fs::write(&kept, "<<<<<<< HEAD\n").unwrap();
    assert!(fails(&run(&["snapshot", &part]), 2).contains("'<' is no level"));
    done(&run(&["snapshot", &part, "--update"]));
    done(&run(&["snapshot", &part]));
    // Two scenes that would be kept in one file.
    let before = fs::read(&kept).unwrap();
    fs::copy(&part, path("part.scene")).unwrap();
    let message = fails(&run(&["snapshot", "--update", &part, &path("part.scene")]), 2);
    assert!(message.contains("would both be kept as"), "{message}");
    assert_eq!(fs::read(&kept).unwrap(), before);
    // What stands inside the program has no file to be beside.
    assert!(fails(&run(&["snapshot", "--update", "die"]), 2).contains("no file of that name"));
    // A picture that is a link to the scene would take its place.
    #[cfg(unix)]
    {
        fs::remove_file(&kept).unwrap();
        std::os::unix::fs::symlink("part.csg", &kept).unwrap();
        fails(&run(&["snapshot", "--update", &part]), 2);
        assert_eq!(fs::read_to_string(&part).unwrap(), "cube(2, center = true);\n");
    }
}

/// The first scene with a mistake ended the run, and what came after it was not looked at.
#[test]
fn what_is_broken_does_not_keep_the_others_from_being_compared() {
    let folder = parts("others");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (broken, part, gone) = (path("broken.csg"), path("part.csg"), path("gone.csg"));
    fs::write(&broken, "cube(2, center = true\n").unwrap();
    let run = || run(&["snapshot", &broken, &part, &gone]);
    let [shown, why] = [run().stdout, run().stderr].map(|bytes| text(&bytes));
    assert_eq!(run().status.code(), Some(2), "{why}");
    assert!(shown.contains("part.levels: not kept yet"), "{shown}");
    for what in ["broken.csg:1:5", "gone.csg: ", "2 of the scenes", "1 of 1 pictures not as kept"] {
        assert!(why.contains(what), "{what}: {why}");
    }
    done(&crate::run(&["snapshot", &part, "--update"]));
    assert_eq!(run().status.code(), Some(2));
}

/// Whether a file is a picture was asked of its bytes, and its scene was read once more: of a pipe nothing
/// was left.
#[cfg(unix)]
#[test]
fn pipes_are_compared_as_files_are() {
    let folder = parts("pipes");
    let part = folder.join("part.csg");
    let (part, pipe) = (part.to_str().unwrap(), folder.join("pipe"));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let levels = done(&run(&["render", part, "--format", "levels", "--cells", "80x25"]));
    for bytes in [fs::read(part).unwrap(), levels] {
        // As the shell does it: one writes while the other reads.
        let to = pipe.clone();
        let writer = std::thread::spawn(move || fs::write(to, bytes).unwrap());
        let compared = done(&run(&["diff", pipe.to_str().unwrap(), part]));
        writer.join().unwrap();
        assert!(text(&compared).contains("the same 16000 dots"), "{}", text(&compared));
    }
}

/// The marked picture was always of block characters, for a dark terminal.
#[test]
fn a_marked_picture_is_shown_as_asked_for() {
    let folder = parts("shown");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (part, ball) = (path("part.csg"), path("ball.csg"));
    fs::write(&ball, "sphere(1.2);\n").unwrap();
    let marked = |options: &[&str]| differs(&run(&[&["diff", &part, &ball], options].concat()))[0].clone();
    let plain = marked(&[]);
    assert!(plain.contains('▓') && !plain.is_ascii());
    assert!(marked(&["--glyphs", "ascii"]).is_ascii());
    assert!(marked(&["--invert"]) != plain);
    let [_, why] = differs(&run(&["diff", &part, &ball, "--palette", "gray"]));
    assert!(why.contains("--palette has no effect here"), "{why}");
}

#[test]
fn a_picture_of_nothing_says_so() {
    let folder = parts("nothing");
    let scene = folder.join("away.scene");
    fs::write(&scene, "camera(eye = [0, -9, 0], target = [0, -99, 0]); sphere(1);\n").unwrap();
    let output = run(&["snapshot", "--update", scene.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    assert!(text(&output.stderr).contains("nothing"), "{}", text(&output.stderr));
}
