//! A program in a pseudo-terminal, and the screen that it draws.

use std::collections::VecDeque;
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

use crate::support::seen::Seen;

/// Far longer than anything takes on a loaded machine; only a test that fails waits for it.
const DEADLINE: Duration = Duration::from_secs(60);

/// Columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    pub columns: u16,
    pub rows: u16,
}

/// A shell script around the program: it waits for a line, sets the size before the program looks, and
/// reports the program's number, how it ended, whether it left the modes of the terminal as they were, and
/// what it left to be read, now or a little later. The named pipe ends with the last process.
const SCRIPT: &str = r#"
    read -r line; exec 9>"$1"; stty cols "$2" rows "$3"; shift 3
    before=$(stty -g)
    modes() { [ "$before" = "$(stty -g)" ] && echo modes=same || echo modes=changed; }
    sh -c 'echo "pid=$$."; exec "$0" "$@"' "$@"
    code=$?
    while [ $code -eq 147 ]; do echo "stopped $(modes)"; read -r line; fg >/dev/null; code=$?; done
    is=$(modes); stty -icanon -echo min 0 time 2
    left=$(dd bs=999 count=1 2>/dev/null | od -An -c | tr -d ' \n'); stty "$before"
    echo "code=$code $is left=[$left]"
"#;

/// A program in a pseudo-terminal.
pub struct Pty {
    process: UnixProcess,
    line: File,
    all_ended: Receiver<()>,
    parser: vt100::Parser,
    log: Vec<u8>,
    answers: Answers,
}

/// How the terminal answers.
#[derive(Default)]
struct Answers {
    /// How long an answer is on its way; absent where there is none.
    delay: Option<Duration>,
    /// The bytes that have been looked through for questions.
    read: usize,
    /// What is on its way, and when it arrives.
    sent: VecDeque<(Instant, &'static str)>,
}

/// Questions, and what xterm answers.
const QUESTIONS: [(&str, &str); 2] = [("\x1b[5n", "\x1b[0n"), ("\x1b[>c", "\x1b[>41;388;0c")];

impl Answers {
    /// Looks for questions in what came since.
    fn look(&mut self, log: &[u8]) {
        while let Some(rest) = log.get(self.read..).filter(|rest| !rest.is_empty()) {
            let question = |(question, _): &&(&str, &str)| rest.starts_with(question.as_bytes());
            if let Some(&(question, answer)) = QUESTIONS.iter().find(question) {
                self.sent.extend(self.delay.map(|delay| (Instant::now() + delay, answer)));
                self.read += question.len();
            } else if QUESTIONS.iter().any(|(question, _)| question.as_bytes().starts_with(rest)) {
                return;
            } else {
                self.read += 1;
            }
        }
    }
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
        for variable in ["NO_COLOR", "RUST_BACKTRACE", "TMUX", "STY", "COLORTERM"] {
            shell.env_remove(variable);
        }
        shell.env("TERM", "xterm-256color").env("LC_ALL", "C.UTF-8");
        shell.arg("-c").arg(script).arg("sh").arg(&pipe);
        shell.arg(size.columns.to_string()).arg(size.rows.to_string()).args(command);
        let process = UnixProcess::spawn_command(shell).unwrap();
        let mut line = process.get_raw_handle().unwrap();
        // Only now is the size of a new terminal left alone.
        line.write_all(b"\n").unwrap();
        let size = if size.columns == 0 { Size { columns: 80, rows: 25 } } else { size };
        let [rows, columns] = sides(size);
        let parser = vt100::Parser::new(rows, columns, 0);
        let answers = Answers { delay: Some(Duration::ZERO), ..Answers::default() };
        Self { process, line, all_ended, parser, log: Vec::new(), answers }
    }

    /// From now on the terminal answers questions after a time, or not at all.
    pub fn answer_after(&mut self, delay: Option<Duration>) {
        self.answers.delay = delay;
    }

    /// Whether an answer is on its way.
    pub fn is_answering(&self) -> bool {
        !self.answers.sent.is_empty()
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

    /// What is seen at a place.
    pub fn seen(&self, column: u16, row: u16) -> Seen {
        self.parser.screen().cell(row, column).map(Seen::shown).expect("a place on the screen")
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

    /// The screen of the present size after each update since a place in the log, and before the first of
    /// them, as rows.
    pub fn screens(&self, since: usize) -> Vec<Vec<String>> {
        const END_UPDATE: &[u8] = b"\x1b[?2026l";
        let [rows, columns] = sides(self.size());
        let mut parser = vt100::Parser::new(rows, columns, 0);
        parser.process(&self.log[..since]);
        let text = |parser: &vt100::Parser| parser.screen().rows(0, columns.get()).collect::<Vec<_>>();
        let mut screens = vec![text(&parser)];
        let mut from = since;
        for to in since..=self.log.len() {
            if self.log[from..to].ends_with(END_UPDATE) {
                parser.process(&self.log[from..to]);
                screens.push(text(&parser));
                from = to;
            }
        }
        screens
    }

    /// How long the program has computed, in hundredths of a second; 0 where the system does not say.
    pub fn ticks(&self) -> u64 {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.pid())).unwrap_or_default();
        // Behind the name, which stands in brackets, the 12th and the 13th: proc(5).
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
        [11, 12].iter().filter_map(|&place| fields.get(place)?.parse::<u64>().ok()).sum()
    }

    fn pid(&self) -> String {
        let log = String::from_utf8_lossy(&self.log);
        log.split("pid=").nth(1).and_then(|rest| rest.split('.').next()).unwrap().to_owned()
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
        assert!(Command::new("kill").args(["-s", name, &self.pid()]).status().unwrap().success());
    }

    /// Takes output until the condition holds; fails with the screen at the deadline.
    pub fn wait_for(&mut self, what: &str, mut condition: impl FnMut(&Self) -> bool) {
        let deadline = Instant::now() + DEADLINE;
        while !condition(self) {
            assert!(
                self.take_output(deadline) && Instant::now() < deadline,
                "no {what} on the screen:\n{}",
                self.text()
            );
        }
    }

    /// Takes what comes next, or sends the answer that is due; `false` after the last process.
    pub fn take_output(&mut self, deadline: Instant) -> bool {
        let due = self.answers.sent.front().map(|&(due, _)| due);
        let until = due.map_or(deadline, |due| due.min(deadline));
        let left = until.saturating_duration_since(Instant::now());
        let mut line = [PollFd::new(&self.line, PollFlags::IN)];
        poll(&mut line, Some(&left.try_into().unwrap())).unwrap();
        let come = line[0].revents();
        if come.contains(PollFlags::IN) {
            let mut bytes = vec![0; 65_536];
            // Linux reports the end of the last process as an error.
            let n = self.line.read(&mut bytes).unwrap_or(0);
            self.parser.process(&bytes[..n]);
            self.log.extend(&bytes[..n]);
            self.answers.look(&self.log);
            return n > 0;
        }
        while self.answers.sent.front().is_some_and(|&(due, _)| due <= Instant::now()) {
            let (_, answer) = self.answers.sent.pop_front().unwrap();
            self.line.write_all(answer.as_bytes()).unwrap();
        }
        !come.contains(PollFlags::HUP)
    }

    /// Waits for the program's end, with this code, the terminal as it was, and nothing left to be read by
    /// the shell.
    pub fn wait_for_end(&mut self, code: i32) {
        let report = format!("code={code} modes=same left=[]");
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
