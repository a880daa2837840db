//! What is sent to which terminal, byte by byte: the rows of docs/terminals.md.

use super::pty::{Pty, Size};
use crate::VIEWER;

const SCREEN: Size = Size { columns: 80, rows: 24 };

/// What the viewer sends, from its start to its end by `q`, and what then stands on the screen.
struct Session {
    sent: String,
    left: String,
}

/// Runs the viewer in an environment of the given variables.
fn session(variables: &[&str], arguments: &[&str]) -> Session {
    let mut pty = start(variables, arguments);
    pty.wait_for("the first picture", |pty| pty.text().contains(" fps "));
    // The same again with a key that changes what is drawn.
    pty.send("g");
    pty.send("q");
    pty.wait_for("the end", |pty| pty.text().contains("code="));
    assert!(pty.text().contains("code=0 modes=same"), "{}", pty.text());
    Session { sent: String::from_utf8_lossy(pty.log()).into_owned(), left: pty.text() }
}

fn start(variables: &[&str], arguments: &[&str]) -> Pty {
    let unset = ["LANG", "LC_CTYPE", "LC_ALL", "COLORTERM", "TERM", "TMUX"];
    let mut command = vec!["env"];
    command.extend(unset.iter().flat_map(|variable| ["-u", variable]));
    command.extend(variables);
    command.extend([VIEWER, "die"]);
    command.extend(arguments);
    Pty::start(&command, SCREEN)
}

impl Session {
    fn has(&self, sequence: &str) -> bool {
        self.sent.contains(sequence)
    }

    /// The parameters of every SGR sequence.
    fn attributes(&self) -> Vec<u32> {
        let sequences = self.sent.split("\x1b[").skip(1).filter_map(|rest| {
            let end = rest.find(|c: char| !c.is_ascii_digit() && c != ';')?;
            rest[end..].starts_with('m').then(|| &rest[..end])
        });
        sequences.flat_map(|parameters| parameters.split(';').map(|p| p.parse().unwrap_or(0))).collect()
    }

    /// Whether a colour is set, other than back to the terminal's own.
    fn has_colors(&self) -> bool {
        self.attributes().iter().any(|p| matches!(p, 30..=38 | 40..=48 | 90..=107))
    }

    /// Whether a paper of 8 to 15 is set, by its attribute.
    fn has_bright_papers(&self) -> bool {
        self.attributes().iter().any(|p| matches!(p, 100..=107))
    }

    fn has_quadrants(&self) -> bool {
        self.sent.contains(['▘', '▝', '▖', '▗', '▙', '▟', '▛', '▜', '▚', '▞'])
    }
}

#[test]
fn emulators_get_a_second_screen_colours_and_quadrants() {
    for term in [
        "xterm",
        "xterm-256color",
        "rxvt",
        "tmux-256color",
        "screen-256color",
        "alacritty",
        "foot",
        "st-256color",
    ] {
        let session = session(&[&format!("TERM={term}"), "LANG=C.UTF-8"], &[]);
        assert!(session.has("\x1b[?1049h") && session.has("\x1b[?1049l"), "{term}");
        assert!(session.has_colors() && session.has_quadrants() && session.has("╔═"), "{term}");
    }
}

#[test]
fn the_linux_console_gets_the_dos_set_papers_0_to_7_and_a_clear_screen_at_the_end() {
    let session = session(&["TERM=linux", "COLORTERM=truecolor", "LANG=C.UTF-8"], &["--shading", "3"]);
    assert!(!session.has("\x1b[?1049"), "it has one screen");
    assert!(session.has_colors() && !session.has_bright_papers() && session.has("╔═"));
    assert!(session.left.starts_with("code=0"), "{}", session.left);
}

#[test]
fn screen_and_putty_get_the_dos_set() {
    for term in ["screen", "putty"] {
        let mut pty = start(&[&format!("TERM={term}"), "LANG=C.UTF-8"], &[]);
        pty.wait_for("the glyphs", |pty| pty.text().contains(" glyphs   cp437 "));
        assert!(!String::from_utf8_lossy(pty.log()).contains(['▘', '▝', '▖', '▗', '▚', '▞']), "{term}");
    }
}

#[test]
fn a_vt_gets_no_colours_and_no_second_screen() {
    for term in ["vt100", "vt220"] {
        let session = session(&[&format!("TERM={term}"), "LANG=C.UTF-8"], &[]);
        assert!(!session.has("\x1b[?1049") && !session.has_colors(), "{term} {:?}", session.attributes());
        assert!(session.left.starts_with("code=0"), "{term}: {}", session.left);
    }
}

#[test]
fn without_utf_8_every_byte_is_ascii() {
    for locale in ["LANG=C", "LANG=", "LC_ALL=POSIX", "LC_CTYPE=de_DE.ISO-8859-1"] {
        for term in ["TERM=xterm-256color", "TERM=linux"] {
            let session = session(&[term, locale], &[]);
            let strange: String = session.sent.chars().filter(|c| !c.is_ascii()).collect();
            assert_eq!(strange, "", "{term} {locale}");
            assert!(session.has("+=") && session.has_colors(), "{term} {locale}");
        }
    }
    // The first that is set decides.
    let session = session(&["TERM=xterm", "LC_ALL=C.UTF-8", "LC_CTYPE=C", "LANG=C"], &[]);
    assert!(session.has("╔═"));
}

#[test]
fn what_is_asked_for_by_name_has_the_last_word() {
    let blocks = session(&["TERM=vt100", "LANG=C"], &["--glyphs", "half", "--palette", "dos"]);
    assert!(blocks.has("▀") && blocks.has_colors() && blocks.has("+="));
    let plain =
        session(&["TERM=xterm-256color", "LANG=C.UTF-8"], &["--glyphs", "ascii", "--palette", "mono"]);
    assert!(!plain.has_quadrants() && !plain.has_colors() && plain.has("╔═"));
}

/// What is in the file of settings counts, what is typed counts more, and what is wrong in it has a place.
#[test]
fn the_viewer_starts_with_the_person_s_settings() {
    let home = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("settings");
    std::fs::create_dir_all(home.join("ray13")).unwrap();
    let variables = [&format!("XDG_CONFIG_HOME={}", home.display()), "TERM=xterm-256color", "LANG=C.UTF-8"];
    let write = |text: &str| std::fs::write(home.join("ray13/config.toml"), text).unwrap();
    write("glyphs = \"half\"\nshading = 3\n");
    for (arguments, shown) in [(&[][..], " glyphs   half "), (&["--glyphs", "shade"], " glyphs   shade ")] {
        let mut pty = start(&variables, arguments);
        pty.wait_for("what is set", |pty| pty.text().contains(shown) && pty.text().contains("(3) highlight"));
    }
    write("glyphs = \"half\"\nshadin = 3\n");
    let mut pty = start(&variables, &[]);
    pty.wait_for("the end", |pty| pty.text().contains("code=2 modes=same"));
    let text = pty.text();
    assert!(text.contains("config.toml:2:1") && text.contains("is `shading` meant?"), "{text}");
    assert!(!String::from_utf8_lossy(pty.log()).contains("\x1b[?1049h"), "{text}");
}

#[test]
fn without_a_cursor_there_is_a_still_and_a_word_why() {
    for (term, why) in [
        ("TERM=dumb", "a terminal of TERM=dumb has no cursor to move"),
        ("TERM=", "TERM is not set"),
        ("NOTERM=", "TERM is not set"),
        ("TERM=no-such-terminal", "no description of TERM=no-such-terminal"),
        ("TERM=../../etc/passwd", "no description of TERM=../../etc/passwd"),
    ] {
        for locale in ["LANG=C.UTF-8", "LANG=C"] {
            let mut pty = start(&[term, locale], &[]);
            pty.wait_for("the end", |pty| pty.text().contains("code=0 modes=same"));
            let sent = String::from_utf8_lossy(pty.log()).into_owned();
            assert!(sent.contains(why), "{term}: {sent}");
            assert!(!sent.contains('\x1b'), "{term}: {sent:?}");
            assert_eq!(sent.is_ascii(), locale == "LANG=C", "{term} {locale}: {sent}");
        }
    }
}

#[test]
fn a_still_on_a_terminal_follows_the_terminal_and_one_in_a_file_follows_nothing() {
    let still = |variables: &[&str], more: &[&str]| {
        let unset = ["LANG", "LC_CTYPE", "LC_ALL", "COLORTERM", "TERM"];
        let mut command = vec!["env"];
        command.extend(unset.iter().flat_map(|variable| ["-u", variable]));
        command.extend(variables);
        command.extend([VIEWER, "render", "die", "--cells", "40x12"]);
        command.extend(more);
        let mut pty = Pty::start(&command, SCREEN);
        pty.wait_for("the end", |pty| pty.text().contains("code=0"));
        String::from_utf8_lossy(pty.log()).into_owned()
    };
    assert!(still(&["TERM=xterm", "LANG=C"], &[]).is_ascii());
    assert!(still(&["TERM=xterm", "LANG=C.UTF-8"], &[]).contains("\x1b[9"));
    assert!(!still(&["TERM=vt100", "LANG=C.UTF-8"], &[]).contains('\x1b'));
    assert!(!still(&["TERM=dumb", "LANG=C.UTF-8"], &[]).contains('\x1b'));

    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("terminals-still.txt");
    let name = file.to_str().unwrap();
    let written = [&["TERM=xterm", "LANG=C.UTF-8"], &["TERM=dumb", "LANG=C"]].map(|variables| {
        still(variables, &["-o", name]);
        std::fs::read_to_string(&file).unwrap()
    });
    assert_eq!(written[0], written[1]);
    assert!(written[0].contains(['▄', '▌', '▀', '▐']));
}
