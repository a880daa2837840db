//! A scene that takes long to read: the screen says what is at work, and keys work meanwhile.

use std::fs::{self, File};
use std::io::Write;
use std::path::PathBuf;
use std::process::Command;

use super::pty::{Pty, Size};
use crate::VIEWER;

const SCREEN: Size = Size { columns: 80, rows: 24 };

/// A pipe that is read as a scene, which lasts until all of it is written.
struct Slow {
    path: PathBuf,
}

impl Slow {
    fn new(test: &str) -> Self {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("loading-{test}.scene"));
        let _ = fs::remove_file(&path);
        assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
        Self { path }
    }

    /// The viewer on it, once it reads, and the other end of the pipe.
    fn viewer(&self) -> (Pty, File) {
        let mut pty = Pty::start(&[VIEWER, self.path.to_str().unwrap()], SCREEN);
        let end = File::options().write(true).open(&self.path).unwrap();
        pty.wait_for("the stage at work", |pty| {
            pty.text().contains("1►OBJECTS")
                && pty.text().contains(" reading ")
                && pty.row(23).contains("10Quit")
        });
        assert!(pty.row(0).contains("LOADING-"), "{}", pty.text());
        (pty, end)
    }
}

#[test]
fn the_stage_at_work_is_shown_and_then_the_picture() {
    let (mut pty, mut end) = Slow::new("picture").viewer();
    pty.resize(Size { columns: 100, rows: 30 });
    pty.wait_for("the larger screen", |pty| pty.row(29).contains("10Quit"));
    end.write_all(b"sphere(1);").unwrap();
    drop(end);
    pty.wait_for("the picture", |pty| pty.text().contains(" fps "));
    assert!(!pty.text().contains('►'));
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_key_that_quits_ends_it_at_once() {
    for (test, key) in [("q", "q"), ("control-c", "\x03")] {
        let (mut pty, _end) = Slow::new(test).viewer();
        pty.send(key);
        pty.wait_for_end(0);
    }
    let (mut pty, _end) = Slow::new("term").viewer();
    pty.signal("TERM");
    pty.wait_for_end(128 + 15);
}

#[test]
fn an_error_comes_behind_the_terminal_as_it_was() {
    let (mut pty, mut end) = Slow::new("error").viewer();
    end.write_all(b"spere(1);").unwrap();
    drop(end);
    pty.wait_for_end(2);
    assert!(pty.text().contains("spere(1);") && pty.text().contains("sphere"), "{}", pty.text());
}

#[test]
fn what_is_read_at_once_never_shows_that_it_was() {
    let mut pty = Pty::start(&[VIEWER, "no-such-scene"], SCREEN);
    pty.wait_for_end(2);
    // The terminal was not even taken.
    assert!(!String::from_utf8_lossy(pty.log()).contains('\x1b'));
}
