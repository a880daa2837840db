//! A program in a pseudo-terminal, and the screen that it draws.

use std::fs::File;
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};
use std::{fs, process, thread};

use expectrl::process::Process;
use expectrl::process::unix::UnixProcess;
use rustix::event::{PollFd, PollFlags, poll};

/// Far longer than anything takes on a loaded machine; only a test that fails waits for it.
const DEADLINE: Duration = Duration::from_secs(60);

/// Columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub columns: u16,
    pub rows: u16,
}

/// A shell script around the program: it waits for a line, sets the size before the program looks, and reports
/// the program's number, how it ended, and whether it left the modes of the terminal as they were. The named
/// pipe ends with the last process.
const SCRIPT: &str = r#"
    read -r line; exec 9>"$1"; stty cols "$2" rows "$3"; shift 3
    before=$(stty -g)
    modes() { [ "$before" = "$(stty -g)" ] && echo modes=same || echo modes=changed; }
    sh -c 'echo "pid=$$."; exec "$0" "$@"' "$@"
    code=$?
    while [ $code -eq 147 ]; do echo "stopped $(modes)"; read -r line; fg >/dev/null; code=$?; done
    echo "code=$code $(modes)"
"#;

/// A program in a pseudo-terminal.
pub struct Pty {
    process: UnixProcess,
    line: File,
    all_ended: Receiver<()>,
    parser: vt100::Parser,
    log: Vec<u8>,
}

impl Pty {
    /// Starts a command in a terminal that reports `size`; the screen itself has 80 × 25 where that is 0.
    pub fn start(command: &[&str], size: Size) -> Self {
        Self::start_script(SCRIPT.to_owned(), command, size)
    }

    /// Starts a command as a job of a shell that waits for a line when the job stops, and then continues it.
    pub fn start_job(command: &[&str], size: Size) -> Self {
        Self::start_script(format!("set -m; {SCRIPT}"), command, size)
    }

    fn start_script(script: String, command: &[&str], size: Size) -> Self {
        static STARTED: AtomicU32 = AtomicU32::new(0);
        let name = format!("pty-{}-{}", process::id(), STARTED.fetch_add(1, Ordering::Relaxed));
        let pipe = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let (ended, all_ended) = mpsc::channel();
        let alive = pipe.clone();
        thread::spawn(move || {
            let mut pipe = File::open(&alive).unwrap();
            // Both ends are open: the name has served.
            fs::remove_file(alive).unwrap();
            pipe.read_to_end(&mut Vec::new()).unwrap();
            // A test that has failed no longer listens.
            let _ = ended.send(());
        });

        let mut shell = Command::new("sh");
        shell.env_remove("NO_COLOR").env_remove("RUST_BACKTRACE").env("TERM", "xterm-256color");
        shell.arg("-c").arg(script).arg("sh").arg(&pipe);
        shell.arg(size.columns.to_string()).arg(size.rows.to_string()).args(command);
        let process = UnixProcess::spawn_command(shell).unwrap();
        let mut line = process.get_raw_handle().unwrap();
        // Only now is the size of a new terminal left alone.
        line.write_all(b"\n").unwrap();
        let size = if size.columns == 0 { Size { columns: 80, rows: 25 } } else { size };
        let [rows, columns] = sides(size);
        let parser = vt100::Parser::new(rows, columns, 0);
        Self { process, line, all_ended, parser, log: Vec::new() }
    }

    /// The size of the screen.
    pub fn size(&self) -> Size {
        let (rows, columns) = self.parser.screen().size();
        Size { columns: columns.get(), rows: rows.get() }
    }

    /// The character at a place.
    pub fn symbol(&self, column: u16, row: u16) -> &str {
        self.parser.screen().cell(row, column).map_or("", vt100::Cell::contents)
    }

    /// A row of the screen.
    pub fn row(&self, row: u16) -> String {
        (0..self.size().columns)
            .map(|column| match self.symbol(column, row) {
                "" => " ",
                symbol => symbol,
            })
            .collect()
    }

    /// All rows.
    pub fn text(&self) -> String {
        (0..self.size().rows).map(|row| self.row(row) + "\n").collect()
    }

    /// Every byte that came so far.
    pub fn log(&self) -> &[u8] {
        &self.log
    }

    /// Whether the first screen shows again, with a cursor and plain attributes.
    pub fn given_back(&self) -> bool {
        let screen = self.parser.screen();
        let plain = screen.fgcolor() == vt100::Color::Default && screen.bgcolor() == vt100::Color::Default;
        !screen.alternate_screen() && !screen.hide_cursor() && plain && !screen.inverse() && !screen.bold()
    }

    /// Types.
    pub fn send(&mut self, keys: &str) {
        self.line.write_all(keys.as_bytes()).unwrap();
    }

    /// Gives the terminal another size, as a window does.
    pub fn resize(&mut self, size: Size) {
        let [rows, columns] = sides(size);
        self.parser.screen_mut().set_size(rows, columns);
        self.process.set_window_size(size.columns, size.rows).unwrap();
    }

    /// Sends a signal to the program.
    pub fn signal(&mut self, name: &str) {
        let log = String::from_utf8_lossy(&self.log);
        let pid = log.split("pid=").nth(1).and_then(|rest| rest.split('.').next()).unwrap();
        assert!(Command::new("kill").args(["-s", name, pid]).status().unwrap().success());
    }

    /// Takes output until the condition holds; fails with the screen at the deadline.
    pub fn wait_for(&mut self, what: &str, mut condition: impl FnMut(&Self) -> bool) {
        let deadline = Instant::now() + DEADLINE;
        while !condition(self) {
            let bytes = self.read_before(deadline);
            assert!(!bytes.is_empty(), "no {what} on the screen:\n{}", self.text());
            self.parser.process(&bytes);
            self.log.extend(bytes);
        }
    }

    /// The next output; nothing at the deadline or after the last process.
    fn read_before(&mut self, deadline: Instant) -> Vec<u8> {
        let left = deadline.saturating_duration_since(Instant::now());
        let mut line = [PollFd::new(&self.line, PollFlags::IN)];
        poll(&mut line, Some(&left.try_into().unwrap())).unwrap();
        let ready = line[0].revents().contains(PollFlags::IN);
        let mut bytes = vec![0; 65_536];
        // Linux reports the end of the last process as an error.
        let n = if ready { self.line.read(&mut bytes).unwrap_or(0) } else { 0 };
        bytes.truncate(n);
        bytes
    }

    /// Waits for the program's end, with this code and the terminal as it was.
    pub fn wait_for_end(&mut self, code: i32) {
        let report = format!("code={code} modes=same");
        self.wait_for(&report, |pty| pty.text().contains(&report) && pty.given_back());
    }

    /// Takes the terminal away, as a lost connection does, and waits until no process is left.
    pub fn hang_up(self) {
        let Self { process, line, all_ended, .. } = self;
        drop((process, line));
        all_ended.recv_timeout(DEADLINE).expect("a process is left");
    }
}

fn sides(size: Size) -> [NonZeroU16; 2] {
    [size.rows, size.columns].map(|side| NonZeroU16::new(side).unwrap())
}
