//! Scenes that change while they are shown, in each way in which editors change files.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use super::pty::{Pty, Size};
use crate::support::seen::Seen;
use crate::{Reading, VIEWER};

const SCREEN: Size = Size { columns: 160, rows: 40 };

/// A folder of its own for a test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("watching-{test}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The viewer on a file, its first picture drawn.
fn viewer(file: &Path) -> Pty {
    let mut pty = Pty::start(&[VIEWER, file.to_str().unwrap()], SCREEN);
    pty.wait_for("the first picture", Reading::drawn);
    pty
}

/// A block that is lower for each number up to 5: all of them are in the view of the first.
fn objects(number: usize) -> String {
    format!("cube([1, 1, {}]);\n", 1.0 - 0.15 * number as f64)
}

/// Waits until another picture is shown.
fn shows(pty: &mut Pty, what: &str, before: &[Seen]) {
    pty.wait_for(what, |pty| pty.drawn() && pty.picture() != *before && !pty.text().contains(" MISTAKE "));
}

#[test]
fn every_way_to_save_is_seen_and_the_view_stays() {
    let folder = folder("ways");
    let file = folder.join("part.csg");
    let other = folder.join("other.csg");
    fs::write(&file, objects(0)).unwrap();
    let mut pty = viewer(&file);
    let eye = pty.eye();
    let mut number = 0;
    let mut change = |pty: &mut Pty, what: &str, way: &dyn Fn(String)| {
        number += 1;
        let before = pty.picture();
        way(objects(number));
        shows(pty, what, &before);
        assert_eq!(pty.eye(), eye, "after {what}");
    };
    change(&mut pty, "a save", &|text| fs::write(&file, text).unwrap());
    change(&mut pty, "a rename", &|text| {
        fs::write(&other, text).unwrap();
        fs::rename(&other, &file).unwrap();
    });
    change(&mut pty, "a second rename", &|text| {
        fs::write(&other, text).unwrap();
        fs::rename(&other, &file).unwrap();
    });
    fs::remove_file(&file).unwrap();
    pty.wait_for("the missing file", |pty| {
        pty.text().contains(" MISTAKE ") && pty.text().contains("No such file")
    });
    change(&mut pty, "another file in its place", &|text| fs::write(&file, text).unwrap());
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_mistake_stands_over_the_last_picture_until_it_is_mended() {
    let folder = folder("mistake");
    let file = folder.join("part.csg");
    fs::write(&file, objects(2)).unwrap();
    let mut pty = viewer(&file);
    let right = pty.picture();
    // Half of what is written.
    fs::write(&file, "cube(1);\ncub").unwrap();
    pty.wait_for("the mistake", |pty| pty.text().contains(" MISTAKE ") && pty.text().contains("part.csg:2"));
    fs::write(&file, objects(2)).unwrap();
    pty.wait_for("the picture", |pty| pty.drawn() && pty.picture() == right);
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_link_that_is_switched_is_followed() {
    let folder = folder("link");
    for number in 0..3 {
        fs::write(folder.join(format!("{number}.csg")), objects(number)).unwrap();
    }
    let link = folder.join("part.csg");
    let switch = |number: usize| {
        let new = folder.join("new");
        std::os::unix::fs::symlink(format!("{number}.csg"), &new).unwrap();
        fs::rename(new, &link).unwrap();
    };
    switch(0);
    let mut pty = viewer(&link);
    for number in [1, 2] {
        let before = pty.picture();
        switch(number);
        shows(&mut pty, "the other file", &before);
    }
    let before = pty.picture();
    fs::write(folder.join("2.csg"), objects(4)).unwrap();
    shows(&mut pty, "what the link leads to", &before);
    pty.send("q");
    pty.wait_for_end(0);
}

/// The number of threads and of open files of the viewer.
fn held(pty: &Pty) -> [usize; 2] {
    let log = String::from_utf8_lossy(pty.log()).into_owned();
    let pid = log.split("pid=").nth(1).and_then(|rest| rest.split('.').next()).unwrap().to_owned();
    ["task", "fd"].map(|what| fs::read_dir(format!("/proc/{pid}/{what}")).map_or(0, Iterator::count))
}

/// The same, once threads that have done their work are gone: as many as `expected`, or as many as a moment
/// before.
fn held_at_rest(pty: &Pty, expected: Option<[usize; 2]>) -> [usize; 2] {
    let deadline = Instant::now() + Duration::from_secs(20);
    let mut last = held(pty);
    loop {
        thread::sleep(Duration::from_millis(50));
        let now = held(pty);
        if expected.unwrap_or(last) == now || Instant::now() > deadline {
            return now;
        }
        last = now;
    }
}

#[test]
fn of_a_hundred_quick_saves_the_last_is_shown_and_nothing_is_left() {
    let folder = folder("hundred");
    let file = folder.join("part.csg");
    fs::write(&file, objects(0)).unwrap();
    let mut pty = viewer(&file);
    let first = pty.picture();
    fs::write(&file, objects(1)).unwrap();
    shows(&mut pty, "a second picture", &first);
    let second = pty.picture();
    let before = held_at_rest(&pty, None);
    for number in 0..100 {
        fs::write(&file, objects(3 + number % 3)).unwrap();
    }
    fs::write(&file, objects(0)).unwrap();
    pty.wait_for("the last", |pty| pty.drawn() && pty.picture() == first);
    fs::write(&file, objects(1)).unwrap();
    pty.wait_for("one more", |pty| pty.drawn() && pty.picture() == second);
    assert_eq!(held_at_rest(&pty, Some(before)), before, "threads and files");
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn what_a_program_includes_and_the_colours_of_a_mesh_are_watched() {
    let folder = folder("parts");
    let mesh = folder.join("part.obj");
    let face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    fs::write(&mesh, format!("mtllib part.mtl\n{face}")).unwrap();
    fs::write(folder.join("part.mtl"), "newmtl a\nKd 1 1 1\n").unwrap();
    let mut pty = viewer(&mesh);
    let before = pty.picture();
    fs::write(folder.join("part.mtl"), "newmtl a\nKd 0.1 0.1 0.1\n").unwrap();
    shows(&mut pty, "another colour", &before);
    pty.send("q");
    pty.wait_for_end(0);

    if Command::new("openscad").arg("--version").output().is_err() {
        eprintln!("skipped: openscad is not installed");
        return;
    }
    let program = folder.join("part.scad");
    fs::write(&program, "include <lib.scad>\npart();\n").unwrap();
    fs::write(folder.join("lib.scad"), "module part() cube(1);\n").unwrap();
    let mut pty = viewer(&program);
    let before = pty.picture();
    fs::write(folder.join("lib.scad"), "module part() cube([1, 1, 0.5]);\n").unwrap();
    shows(&mut pty, "what is included", &before);
    fs::write(folder.join("lib.scad"), "module part() cube(1\n").unwrap();
    pty.wait_for("the mistake", |pty| {
        pty.text().contains(" MISTAKE ") && pty.text().contains("Parser error")
    });
    fs::write(folder.join("lib.scad"), "module part() cube(1);\n").unwrap();
    pty.wait_for("the first picture", |pty| pty.drawn() && pty.picture() == before);
    pty.send("q");
    pty.wait_for_end(0);
}

/// `--watch` draws a still in the place of the one before, and a mistake below it.
#[test]
fn stills_are_repainted() {
    let folder = folder("still");
    let file = folder.join("part.csg");
    fs::write(&file, objects(0)).unwrap();
    let mut pty = Pty::start(&[VIEWER, "--watch", file.to_str().unwrap(), "--cells", "40x12"], SCREEN);
    let ink = |pty: &Pty| pty.text().lines().take(12).map(str::trim_end).collect::<Vec<_>>().join("\n");
    // Whole, and not the part that has come so far: what ends a picture clears all below it. (A first picture
    // taken half drawn was waited for in vain, on a busy machine.)
    let is_there = |pty: &Pty| {
        pty.log().ends_with(b"\x1b[J") && ink(pty).chars().filter(|c| !c.is_whitespace()).count() > 20
    };
    pty.wait_for("a picture", |pty| is_there(pty) && !pty.text().contains("pid="));
    let first = ink(&pty);
    fs::write(&file, objects(2)).unwrap();
    pty.wait_for("another", |pty| ink(pty) != first && is_there(pty));
    fs::write(&file, "cub").unwrap();
    pty.wait_for("the mistake", |pty| pty.text().contains("part.csg:1"));
    fs::write(&file, objects(0)).unwrap();
    pty.wait_for("the first picture", |pty| ink(pty) == first && !pty.text().contains("part.csg:1"));
    pty.signal("TERM");
    pty.wait_for("its end", |pty| pty.text().contains("code=143"));
}
