//! A scene on a turntable: recordings, pictures that move, and a file for each view.

use std::fs;
use std::num::NonZeroU16;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{done, fails, folder, ray13, run, text};
use crate::support::seen::Seen;

const CELLS: [u16; 2] = [30, 10];

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

/// The names of files in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

fn terminal() -> vt100::Parser {
    let [columns, rows] = CELLS.map(|side| NonZeroU16::new(side).unwrap());
    vt100::Parser::new(rows, columns, 0)
}

fn seen(terminal: &vt100::Parser) -> Vec<Seen> {
    let [columns, rows] = CELLS;
    let cells = (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x)));
    cells.map(|(y, x)| Seen::shown(terminal.screen().cell(y, x).unwrap())).collect()
}

/// The recording shows, view by view, what stills of the same views do, and ends where it began.
#[test]
fn a_cast_shows_the_views() {
    let folder = folder("turntable_cast");
    let turn = |rest: &[&str]| {
        let words = [&["render", "die", "--turntable", "4", "--cells", "30x10"], rest].concat();
        let mut command = ray13();
        command.args(words).env("TERM", "xterm-256color").env("COLORTERM", "truecolor");
        done(&command.output().unwrap())
    };
    turn(&["-o", &path(&folder, "turn-%d.ans")]);
    let cast = text(&turn(&["--format", "cast", "--fps", "5"]));
    let lines: Vec<Value> = cast.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let head = ["version", "width", "height"].map(|key| lines[0][key].as_u64().unwrap());
    assert_eq!(head, [2, 30, 10]);
    let mut shown = terminal();
    let mut screens = Vec::new();
    for (n, event) in lines[1..].iter().enumerate() {
        assert_eq!((event[0].as_f64(), event[1].as_str()), (Some(n as f64 / 5.0), Some("o")));
        shown.process(event[2].as_str().unwrap().as_bytes());
        screens.push(seen(&shown));
    }
    assert_eq!(screens.len(), 5);
    assert!(screens[0] == screens[4], "the end is the beginning");
    for (view, screen) in screens[..4].iter().enumerate() {
        let still = fs::read_to_string(folder.join(format!("turn-{view}.ans"))).unwrap();
        let mut meant = terminal();
        meant.process(still.trim_end_matches('\n').replace('\n', "\r\n").as_bytes());
        assert!(*screen == seen(&meant), "view {view}");
        assert!(view == 0 || *screen != screens[view - 1], "view {view} turns");
    }
}

#[test]
fn an_svg_moves_without_a_script() {
    let svg = |threads: &str| {
        let words = ["render", "die", "--turntable", "5", "--format", "svg", "--threads", threads];
        text(&done(&run(&words)))
    };
    let text = svg("1");
    assert!(text == svg("3"), "the same bytes on any number of threads");
    assert_eq!(text.matches("<g class=\"f\"").count(), 5);
    assert_eq!(text.matches("<g").count(), text.matches("</g>").count());
    assert!(!text.contains("<script") && !text.contains("href"), "no script, nothing from elsewhere");
}

#[test]
fn files_are_numbered_and_machines_share_them() {
    let folder = folder("turntable_files");
    let turn = |name: &str, rest: &[&str]| {
        let to = path(&folder, name);
        let words = ["render", "die", "--turntable", "5", "--dots", "40x20", "-o", &to];
        done(&run(&[&words, rest].concat()));
    };
    turn("part-%02d.png", &["--part", "2/3"]);
    assert_eq!(names(&folder), ["part-01.png", "part-04.png"]);
    turn("whole-%02d.png", &[]);
    for view in ["01", "04"] {
        let [part, whole] =
            ["part", "whole"].map(|name| fs::read(folder.join(format!("{name}-{view}.png"))).unwrap());
        assert!(part == whole, "{view}");
    }
    assert_eq!(names(&folder).len(), 2 + 5);
    // The first view is the still's, where a scene says from where it is seen.
    turn("levels-%d.levels", &[]);
    let still = done(&run(&["render", "die", "--dots", "40x20", "--format", "levels"]));
    assert!(fs::read(folder.join("levels-0.levels")).unwrap() == still);
}

/// A long part across the first view's line of sight would stand out of the picture a quarter of a turn
/// later.
#[test]
fn a_scene_without_a_view_stays_within_the_picture() {
    let folder = folder("turntable_framed");
    let bar = path(&folder, "bar.csg");
    fs::write(&bar, "rotate([0, 0, 25]) translate([50, 7, 3]) cube([1, 40, 1]);\n").unwrap();
    let to = path(&folder, "%d.levels");
    done(&run(&["render", &bar, "--turntable", "8", "--dots", "48x30", "-o", &to]));
    for view in 0..8 {
        let levels = fs::read_to_string(folder.join(format!("{view}.levels"))).unwrap();
        let rows: Vec<&str> = levels.lines().collect();
        assert!(levels.contains(|c| !matches!(c, '0' | '\n')), "view {view} shows nothing");
        let rim = [rows[0], rows[29]].concat()
            + &rows.iter().map(|row| [&row[..1], &row[47..]].concat()).collect::<String>();
        assert!(rim.chars().all(|c| c == '0'), "view {view}:\n{levels}");
    }
}

#[test]
fn what_can_not_be_written_is_said_before_anything_is_drawn() {
    let folder = folder("turntable_refused");
    let refused = |rest: &[&str]| fails(&run(&[&["render", "die", "--turntable", "3"], rest].concat()), 2);
    assert!(refused(&["--format", "png"]).contains("-o turn-%03d.png"));
    assert!(refused(&["-o", &path(&folder, "a.png")]).contains("-o turn-%03d.png"));
    assert!(refused(&["-o", &path(&folder, "a-%x.png")]).contains("behind a %"));
    assert!(refused(&["-o", &path(&folder, "a-%d.cast")]).contains("holds all views"));
    assert!(refused(&["-o", &path(&folder, "a.svg"), "--part", "1/2"]).contains("whole views"));
    let scene = path(&folder, "scene-1.txt");
    fs::write(&scene, "sphere(1);\n").unwrap();
    let to = path(&folder, "scene-%d.txt");
    let lost = fails(&run(&["render", &scene, "--turntable", "3", "-o", &to]), 2);
    assert!(lost.contains("would be lost"), "{lost}");
    assert_eq!(names(&folder), ["scene-1.txt"]);
}

/// Ctrl-C leaves files that are whole, and none of what is one file.
#[cfg(unix)]
#[test]
fn a_signal_leaves_nothing_half_written() {
    use std::os::unix::process::ExitStatusExt;
    use std::process::{Command, Stdio};

    for (name, option) in [("turn.cast", "--cells"), ("turn-%d.png", "--dots")] {
        let folder: PathBuf = folder("turntable_interrupted");
        let to = path(&folder, name);
        let mut command = ray13();
        command.args(["render", "glass", "--turntable", "3600", option, "160x100", "-o", &to]);
        let mut child = command.stderr(Stdio::null()).spawn().unwrap();
        if name.contains('%') {
            while names(&folder).len() < 3 {
                assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
                std::thread::yield_now();
            }
        }
        // What runs in the background of a shell, as checks do, may have interrupts ignored: it would draw
        // on.
        let killed = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
        assert!(killed.success());
        let ended = child.wait().unwrap();
        assert_eq!(ended.signal(), Some(15), "{ended}");
        for file in names(&folder) {
            let bytes = fs::read(folder.join(&file)).unwrap();
            assert!(bytes.ends_with(b"IEND\xaeB`\x82"), "{file} is no whole picture");
        }
    }
}
