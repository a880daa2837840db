//! The viewer in a real terminal: it draws, moves, follows the size, and gives the terminal back.
#![cfg(all(unix, feature = "app"))]

mod support {
    pub mod seen;
}

mod viewer {
    mod embedded;
    mod link;
    mod loading;
    pub mod pty;
    mod terminals;
    mod watching;
}

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use std::{fs, thread};

use support::seen::Seen;
use viewer::pty::{Pty, Size};

/// The smallest screen with every panel.
const SMALLEST: Size = Size { columns: 80, rows: 24 };

/// What is taken for the size of a terminal that reports none.
const USUAL: Size = Size { columns: 80, rows: 25 };

const VIEWER: &str = env!("CARGO_BIN_EXE_ray13");

/// What stands before an update, and behind it.
const BEGIN_UPDATE: &str = "\x1b[?2026h";
const STATUS_REQUEST: &[u8] = b"\x1b[5n";

/// An embedded scene that looks different from every side.
const SCENE: &str = "die";

/// The viewer on the scene with one ray a dot, moving or not: each key has one picture.
const PLAIN: [&str; 6] = [VIEWER, SCENE, "--aa", "off", "--fps", "0"];

/// The viewer on the scene, its first picture drawn.
fn viewer(size: Size) -> Pty {
    let mut pty = Pty::start(&PLAIN, size);
    pty.wait_for("the first picture", Reading::drawn);
    pty
}

/// What the tests read from the screen.
trait Reading {
    fn drawn(&self) -> bool;
    fn eye(&self) -> String;
    fn rays(&self) -> String;
    fn picture(&self) -> Vec<Seen>;
}

impl Reading for Pty {
    /// The frame stands in the four corners and the picture is there.
    fn drawn(&self) -> bool {
        let Size { columns, rows } = self.size();
        let corner = |column, row| self.symbol(column, row);
        let corners =
            [corner(0, 0), corner(columns - 1, 0), corner(0, rows - 2), corner(columns - 1, rows - 2)];
        corners == ["╔", "╗", "╚", "╝"]
            && self.row(0).contains(" RAY13 ")
            && self.row(rows - 1).contains("1Help")
            && self.row(rows - 3).contains(" fps ")
            && self.picture().windows(2).filter(|pair| pair[0] != pair[1]).count() > 20
    }

    fn eye(&self) -> String {
        let status = self.row(self.size().rows - 3);
        status
            .split("EYE")
            .nth(1)
            .and_then(|rest| rest.split("DIR").next())
            .unwrap_or_default()
            .trim()
            .to_owned()
    }

    fn rays(&self) -> String {
        rays(&(0..self.size().rows).map(|row| self.row(row)).collect::<Vec<_>>())
    }

    /// What is seen inside the panel of the picture, right of its left border.
    fn picture(&self) -> Vec<Seen> {
        let left = self.row(1).chars().position(|c| c == '┐').unwrap_or_default() + 2;
        let Size { columns, rows } = self.size();
        let columns = |row| (left as u16..columns).take_while(move |&column| self.symbol(column, row) != "│");
        (2..rows - 4).flat_map(|row| columns(row).map(move |column| self.seen(column, row))).collect()
    }
}

#[test]
fn an_arrow_moves_the_eye_and_changes_the_picture() {
    let mut pty = viewer(SMALLEST);
    let (eye, picture) = (pty.eye(), pty.picture());
    pty.send("\x1b[C");
    pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye && pty.picture() != picture);
    pty.send("\x1b[H");
    pty.wait_for("the first picture", |pty| pty.eye() == eye && pty.picture() == picture);
}

#[test]
fn a_ray_is_followed_and_left_again() {
    let mut pty = viewer(SMALLEST);
    let (eye, picture) = (pty.eye(), pty.picture());
    pty.send("\x1bOS");
    pty.wait_for("the story of a ray", |pty| {
        pty.text().contains("┌ RAY of dot") && pty.text().contains("P(t) = ")
    });
    let story = pty.text();
    pty.send("\x1b[D");
    pty.wait_for("another ray", |pty| pty.text().contains("┌ RAY of dot") && pty.text() != story);
    pty.send("\x1b[6~\x1b[6~");
    pty.send("\x1b");
    pty.wait_for("the picture as it was", |pty| pty.eye() == eye && pty.picture() == picture);
}

#[test]
fn the_screen_follows_the_size_of_the_terminal() {
    let mut pty = viewer(SMALLEST);
    pty.resize(Size { columns: 120, rows: 40 });
    pty.wait_for("the larger screen", Reading::drawn);
    pty.resize(Size { columns: 40, rows: 10 });
    pty.wait_for("title, picture and keys", |pty| {
        let text = pty.text();
        pty.row(0).starts_with("═ RAY13 ═") && pty.row(9).contains("1Help") && !text.contains(['║', '│'])
    });
    pty.resize(Size { columns: 15, rows: 4 });
    pty.wait_for("the picture alone", |pty| {
        let text = pty.text();
        !text.contains(['║', '═', '│']) && text.chars().any(|c| !c.is_whitespace())
    });
    pty.resize(SMALLEST);
    pty.wait_for("the panels again", Reading::drawn);
}

#[test]
fn a_terminal_without_a_size_is_taken_as_80_by_25() {
    let mut pty = Pty::start(&PLAIN, Size { columns: 0, rows: 0 });
    pty.wait_for("the first picture", |pty| pty.size() == USUAL && pty.drawn());
}

#[test]
fn the_help_lists_the_keys_and_any_key_closes_it() {
    let mut pty = viewer(SMALLEST);
    for open in ["?", "\x1bOP"] {
        pty.send(open);
        pty.wait_for("the help", |pty| pty.text().contains(" KEYS ") && pty.text().contains("Ctrl-Z"));
        pty.send("q");
        pty.wait_for("no help", |pty| !pty.text().contains(" KEYS ") && pty.drawn());
    }
}

/// F2 and F8, and a click on the key bar's `10Quit`.
#[test]
fn another_scene_is_opened_and_its_picture_saved() {
    let picture = Path::new(env!("CARGO_TARGET_TMPDIR")).join("opened.txt");
    let _ = fs::remove_file(&picture);
    let mut pty = viewer(SMALLEST);
    pty.send("\x1bOQ\x1b[Zno such scene\r");
    pty.wait_for("why it is not opened", |pty| pty.text().contains("neither a file"));
    pty.send("\x15bolt\r");
    pty.wait_for("the other scene", |pty| pty.row(0).contains(" BOLT.SCENE ") && pty.drawn());
    let save = format!("\x1b[19~\x15{}\r", picture.display());
    pty.send(&save);
    pty.wait_for("that it is saved", |pty| pty.text().contains(" saved as "));
    assert!(fs::read_to_string(&picture).unwrap().lines().count() >= 18);
    pty.send(&save);
    pty.wait_for("that it is there", |pty| pty.text().contains("is there already"));
    pty.send("\x1b");
    pty.wait_for("no dialog", |pty| !pty.text().contains("is there already"));
    pty.send("\x1b[<0;76;24M");
    pty.wait_for_end(0);
}

#[test]
fn without_turbo_the_picture_comes_dot_by_dot() {
    let mut pty = Pty::start(&[VIEWER, SCENE, "--preset", "pcat", "--aa", "off"], SMALLEST);
    pty.wait_for("how far it is", |pty| pty.text().contains(" 8 MHz "));
    pty.wait_for("a ray's stage", |pty| pty.text().contains('►'));
    pty.send("\x1b[15~");
    pty.wait_for("all of it", |pty| pty.text().contains("Turbo is on") && !pty.text().contains('►'));
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_key_without_a_meaning_sends_nothing() {
    let mut pty = viewer(SMALLEST);
    pty.wait_for("the end of the picture", |pty| pty.log().ends_with(STATUS_REQUEST));
    let before = pty.log().len();
    pty.send("xq");
    pty.wait_for("the end", |pty| pty.text().contains("code=0"));
    // The first bytes after the picture already give the terminal back.
    let after = String::from_utf8_lossy(&pty.log()[before..]).into_owned();
    assert!(after.starts_with("\x1b[?2026l\x1b[0m\x1b[?25h\x1b[?1006l\x1b[?1000l\x1b[?1049l"), "{after:?}");
}

/// Something else may have written over the screen.
#[test]
fn control_l_sends_the_whole_screen_again() {
    let mut pty = viewer(SMALLEST);
    pty.wait_for("the end of the picture", |pty| pty.log().ends_with(STATUS_REQUEST));
    let (before, text) = (pty.log().len(), pty.text());
    pty.send("\x0c");
    pty.wait_for("the screen again", |pty| {
        pty.log().len() > before && pty.log().ends_with(STATUS_REQUEST) && pty.text() == text
    });
    let sent = String::from_utf8_lossy(&pty.log()[before..]).into_owned();
    assert!(sent.starts_with("\x1b[?2026h\x1b[m\x1b[2J") && sent.contains("RAY13"), "{sent:?}");
}

#[test]
fn every_key_that_quits_leaves_the_terminal_as_it_was() {
    for key in ["q", "\x1b[21~", "\x03"] {
        let mut pty = viewer(SMALLEST);
        pty.send(key);
        pty.wait_for_end(0);
    }
}

/// `ESC`, and `[C` up to half a second later, ended the program and left `[C` to the shell.
#[test]
fn an_arrow_in_two_pieces_is_an_arrow() {
    let mut pty = viewer(SMALLEST);
    for later in [0, 10, 60, 500] {
        let eye = pty.eye();
        pty.send("\x1b");
        thread::sleep(Duration::from_millis(later));
        pty.send("[C");
        pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye);
    }
    pty.send("q");
    pty.wait_for_end(0);
}

/// What is told beside a picture was sent before it, on its own.
#[test]
fn a_key_costs_one_write() {
    let mut pty = viewer(SMALLEST);
    pty.wait_for("the end of the picture", |pty| pty.log().ends_with(STATUS_REQUEST));
    for presses in 1..=5 {
        let (eye, before) = (pty.eye(), pty.log().len());
        pty.send("\x1b[C");
        pty.wait_for("another picture", |pty| pty.eye() != eye && pty.log().ends_with(STATUS_REQUEST));
        let sent = String::from_utf8_lossy(&pty.log()[before..]).into_owned();
        assert_eq!(sent.matches(BEGIN_UPDATE).count(), 1, "press {presses}: {sent:?}");
    }
}

/// Every write is an update of its own, so that the count above is that of writes.
#[test]
fn an_update_is_one_write() {
    if Command::new("strace").arg("-V").output().is_err() {
        eprintln!("skipped: strace is not installed");
        return;
    }
    let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join("writes");
    let trace = ["strace", "-f", "-qq", "-e", "trace=write", "-e", "write=none", "-s", "0", "-o"];
    let command: Vec<&str> = trace.into_iter().chain([log.to_str().unwrap()]).chain(PLAIN).collect();
    let mut pty = Pty::start(&command, SMALLEST);
    pty.wait_for("the first picture", |pty| pty.drawn() && pty.log().ends_with(STATUS_REQUEST));
    for _ in 0..5 {
        let eye = pty.eye();
        pty.send("\x1b[C");
        pty.wait_for("another picture", |pty| pty.eye() != eye && pty.log().ends_with(STATUS_REQUEST));
    }
    let updates = String::from_utf8_lossy(pty.log()).matches(BEGIN_UPDATE).count();
    pty.send("q");
    pty.wait_for_end(0);
    let writes = fs::read_to_string(log).unwrap();
    let to_terminal = writes.lines().filter(|line| line.contains("write(1,")).count();
    // The alternate screen, the question, and giving the terminal back are one each.
    assert_eq!(to_terminal, updates + 3, "{writes}");
}

/// At rest nothing is sent, though a question may have no answer; once the picture is refined, nothing is
/// computed either.
#[test]
fn at_rest_nothing_is_sent_and_nothing_computed() {
    for answers in [Some(Duration::ZERO), None] {
        let mut pty = Pty::start(&[VIEWER, SCENE], SMALLEST);
        pty.answer_after(answers);
        pty.wait_for("the refined picture", |pty| {
            pty.drawn() && pty.rays() == "adaptive" && pty.log().ends_with(STATUS_REQUEST)
        });
        let before = (pty.log().len(), pty.ticks());
        let end = Instant::now() + Duration::from_millis(1_500);
        while Instant::now() < end && pty.take_output(end) {}
        let after = (pty.log().len(), pty.ticks());
        assert_eq!(after.0, before.0);
        // What was begun with the last update may still have ended in this time: two hundredths of a second.
        assert!(after.1 <= before.1 + 2, "{before:?} {after:?}");
    }
}

/// The rays of each picture that was shown since a place in the log.
fn rays_shown(pty: &Pty, since: usize) -> Vec<String> {
    let mut all: Vec<String> =
        pty.screens(since).iter().map(|rows| rays(rows)).filter(|rays| !rays.is_empty()).collect();
    all.dedup();
    all
}

/// What the panel says of the rays.
fn rays(rows: &[String]) -> String {
    let said = rows.iter().find_map(|row| row.split("│ rays ").nth(1));
    said.and_then(|rest| rest.split('│').next()).unwrap_or_default().trim().to_owned()
}

/// With no time at all for a picture, each has the largest dots while the eye moves, and is refined at rest;
/// what was fixed by options is what there is at rest.
#[test]
fn a_picture_is_coarse_while_the_eye_moves_and_refined_at_rest() {
    for (options, at_rest) in [
        (&[][..], &["1 a dot", "adaptive"][..]),
        (&["--aa", "off"], &["1 a dot"]),
        (&["--samples", "2"], &["1 a dot", "4 a dot"]),
        (&["--error", "0.25"], &["1 a dot", "adaptive"]),
    ] {
        let last = *at_rest.last().unwrap();
        let command = [&[VIEWER, SCENE, "--fps", "1000000"][..], options].concat();
        let mut pty = Pty::start(&command, SMALLEST);
        pty.wait_for(last, |pty| pty.drawn() && pty.rays() == last && pty.log().ends_with(STATUS_REQUEST));
        // Nothing has moved yet.
        assert_eq!(rays_shown(&pty, 0), at_rest, "{options:?}");
        let (eye, picture, before) = (pty.eye(), pty.picture(), pty.log().len());
        pty.send("\x1b[C");
        pty.wait_for(last, |pty| {
            pty.eye() != eye && pty.rays() == last && pty.log().ends_with(STATUS_REQUEST)
        });
        let shown = rays_shown(&pty, before);
        assert_eq!(shown[..2], [last, "1 for 64 dots"], "{options:?}");
        assert_eq!(shown[2..], *at_rest, "{options:?}");
        // Back again it is the same picture.
        pty.send("\x1b[H");
        pty.wait_for("the first picture", |pty| {
            pty.rays() == last && pty.eye() == eye && pty.picture() == picture
        });
        pty.send("q");
        pty.wait_for_end(0);
    }
}

/// A key ends what is refined at once, and so does the end.
#[test]
fn a_key_does_not_wait_for_a_picture_that_is_refined() {
    // With an error so small every dot at an edge has all its rays.
    let mut pty = Pty::start(&[VIEWER, "glass", "--error", "1e-9", "--threads", "1"], SMALLEST);
    pty.wait_for("the first picture", |pty| pty.drawn() && pty.rays() == "1 a dot");
    for _ in 0..3 {
        let eye = pty.eye();
        pty.send("\x1b[C");
        pty.wait_for("the next", |pty| pty.eye() != eye);
    }
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn escape_closes_what_is_open_and_never_quits() {
    let mut pty = viewer(SMALLEST);
    let eye = pty.eye();
    pty.send("\x1b");
    thread::sleep(Duration::from_millis(100));
    pty.send("?");
    pty.wait_for("the help", |pty| pty.text().contains(" KEYS "));
    pty.send("\x1b");
    pty.wait_for("no help", |pty| !pty.text().contains(" KEYS ") && pty.drawn());
    assert_eq!(pty.eye(), eye);
    pty.send("\x1bl");
    pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye);
    pty.send("q");
    pty.wait_for_end(0);
}

/// What another program asked, or a terminal tells by itself, has letters that are keys.
#[test]
fn a_foreign_answer_is_no_key_in_any_pieces() {
    let mut pty = viewer(SMALLEST);
    let eye = pty.eye();
    pty.send("\x1b[C");
    pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye);
    let moved = pty.eye();
    pty.send("\x1b[H");
    pty.wait_for("the first picture", |pty| pty.eye() == eye);
    for answer in [
        "\x1b]11;rgb:ffff/dddd/aaaa\x07",
        "\x1b]4;9;rgb:ffff/dddd/aaaa\x1b\\",
        "\x1b[?62;1;6q",
        "\x1b_qqq\x1b\\",
    ] {
        let (begin, rest) = answer.split_at(answer.len() / 3);
        let (middle, end) = rest.split_at(rest.len() / 2);
        for piece in [begin, middle, end] {
            pty.send(piece);
            thread::sleep(Duration::from_millis(70));
        }
    }
    pty.send("\x1b[C");
    pty.wait_for("the picture of one arrow", |pty| pty.drawn() && pty.eye() == moved);
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_terminal_that_answers_nothing_shows_the_picture_all_the_same() {
    let mut pty = Pty::start(&PLAIN, SMALLEST);
    pty.answer_after(None);
    pty.wait_for("the first picture", Reading::drawn);
    pty.send("q");
    pty.wait_for_end(0);
}

/// An answer that is still on its way when the viewer ends is no input of the shell. One that took two
/// seconds, as behind a large picture on a thin link, was: they were waited for a second.
#[test]
fn late_answers_are_not_left_to_the_shell() {
    for delay in [150, 600, 2_000] {
        let mut pty = viewer(SMALLEST);
        pty.answer_after(Some(Duration::from_millis(delay)));
        let eye = pty.eye();
        pty.send("\x1b[C");
        pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye && pty.is_answering());
        pty.send("q");
        pty.wait_for_end(0);
        assert!(!pty.is_answering(), "after {delay} ms the shell gets an answer");
    }
}

/// What is typed while the viewer asks who draws its screen counts.
#[test]
fn keys_typed_before_the_first_picture_count() {
    let mut pty = Pty::start(&PLAIN, SMALLEST);
    pty.answer_after(None);
    pty.wait_for("the question", |pty| pty.log().ends_with(b"\x1b[5n"));
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn a_signal_leaves_the_terminal_as_it_was_and_ends_the_process_by_that_signal() {
    for (name, number) in [("TERM", 15), ("INT", 2), ("HUP", 1)] {
        let mut pty = viewer(SMALLEST);
        pty.signal(name);
        pty.wait_for_end(128 + number);
    }
}

#[test]
fn suspended_it_gives_the_terminal_back_and_continued_it_takes_it_again() {
    let mut pty = Pty::start_job(&PLAIN, SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);
    let picture = pty.picture();
    pty.send("\x1a");
    pty.wait_for("the shell", |pty| pty.text().contains("stopped modes=same") && pty.given_back());
    pty.resize(Size { columns: 100, rows: 30 });
    pty.send("\n");
    pty.wait_for("the viewer again", |pty| pty.drawn() && pty.picture() != picture);
    pty.signal("TSTP");
    pty.wait_for("the shell again", |pty| pty.text().matches("stopped modes=same").count() == 2);
    pty.send("\n");
    pty.wait_for("the viewer once more", Reading::drawn);
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn what_stops_only_the_process_does_not_spoil_the_screen() {
    let mut pty = Pty::start_job(&PLAIN, SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);
    // Nothing can give the terminal back before a SIGSTOP; the shell writes over the picture.
    pty.signal("STOP");
    pty.wait_for("the shell", |pty| pty.text().contains("modes=changed"));
    pty.send("\n");
    pty.wait_for("the viewer again", |pty| pty.drawn() && !pty.text().contains("modes="));
    pty.send("q");
    pty.wait_for_end(0);
}

#[test]
fn without_a_shell_to_continue_it_the_viewer_does_not_stop() {
    let mut pty = viewer(SMALLEST);
    let eye = pty.eye();
    pty.send("\x1a\x1b[C");
    pty.wait_for("another picture", |pty| pty.drawn() && pty.eye() != eye);
}

#[test]
fn a_lost_connection_leaves_no_process() {
    viewer(SMALLEST).hang_up();
    // In a session of its own the process gets no SIGHUP and has to notice by itself.
    let mut pty = Pty::start(&["setsid", "-w", VIEWER, SCENE], SMALLEST);
    pty.wait_for("the first picture", Reading::drawn);
    pty.hang_up();
}
