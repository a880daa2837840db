//! OpenSCAD's programs: OpenSCAD itself writes what one makes as `.csg`, which needs no display, and the list
//! of the files that it read.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::scene::MAX_FILE_BYTES;

use super::arguments::OpenScadArguments;
use super::error::{CliError, visible};
use super::interrupts::Interrupts;

/// The name of the program.
const PROGRAM: &str = "openscad";

/// How long it may work where nobody says: fifty times what the slowest of its own examples takes.
const TIME: Duration = Duration::from_secs(60);

/// How often it is looked at while it works. It is known at once when it ends; a file that grows without end
/// is some megabytes too large by then.
const TICK: Duration = Duration::from_millis(20);

/// So much of what it says is read: a loop may say something each time around.
const MOST_SAID: u64 = 64 << 10;

/// So many lines of it are told.
const MOST_LINES: usize = 40;

/// What OpenSCAD made of a program.
#[derive(Debug)]
pub struct Conversion {
    /// The text of the `.csg`.
    pub csg: Vec<u8>,
    /// The files that it read, the program itself included.
    pub files: Vec<PathBuf>,
    /// What it said, line by line.
    pub said: Vec<String>,
}

/// Where a program is.
#[derive(Clone, Copy, Debug)]
pub enum Program<'a> {
    /// In a file.
    File(&'a Path),
    /// Read already, as from standard input; what it names lies in the working folder.
    Text(&'a [u8]),
}

/// A run of OpenSCAD that another thread can end.
#[derive(Clone, Debug, Default)]
pub struct OpenScadRun {
    run: Arc<Mutex<Run>>,
    /// Whether a run comes or goes.
    changed: Arc<Condvar>,
    /// Whether signals that end the program end it too: where nobody else minds them.
    minds_signals: bool,
}

#[derive(Debug, Default)]
struct Run {
    child: Option<Child>,
    /// Whether there is something to be cleared away behind it.
    is_begun: bool,
    is_ended: bool,
}

/// Why a run came to no end of its own.
enum Ended {
    TooLong(Duration),
    TooLarge,
    Stopped,
    Failed(io::Error),
}

/// Whether a name is that of a program; or a name that says nothing, and OpenSCAD is told something.
pub fn is_program(file: &str, arguments: &OpenScadArguments) -> Result<bool, CliError> {
    let is_told = !arguments.define.is_empty() || arguments.parameters.is_some() || arguments.set.is_some();
    match Path::new(file).extension() {
        Some(ending) if ending.eq_ignore_ascii_case("scad") => Ok(true),
        Some(_) if is_told => Err(CliError::Input(format!(
            "{file} is no program of OpenSCAD (.scad): `-D`, `-p` and `-P` are for those"
        ))),
        _ => Ok(is_told),
    }
}

/// Has OpenSCAD write the `.csg` of a program; `name` is what messages call it.
pub fn convert(
    name: &str,
    program: Program<'_>,
    arguments: &OpenScadArguments,
    run: &OpenScadRun,
) -> Result<Conversion, CliError> {
    let folder = tempfile::Builder::new().prefix("ray13-").tempdir();
    let folder = folder.map_err(|e| CliError::Input(format!("no temporary folder could be made: {e}")))?;
    run.set_begun(true);
    let interrupts = run.minds_signals.then(Interrupts::begin);
    let result = Job { name, program, arguments, run, interrupts, folder: &folder }.result();
    drop(folder);
    run.set_begun(false);
    if let Some(interrupts) = interrupts {
        interrupts.end();
    }
    result
}

struct Job<'j> {
    name: &'j str,
    program: Program<'j>,
    arguments: &'j OpenScadArguments,
    run: &'j OpenScadRun,
    interrupts: Option<&'static Interrupts>,
    folder: &'j TempDir,
}

impl Job<'_> {
    fn result(&self) -> Result<Conversion, CliError> {
        let [csg, list] = ["out.csg", "files"].map(|name| self.folder.path().join(name));
        let mut said = Vec::new();
        let status = self.work(&csg, &list, &mut said);
        let said = lines(&said);
        let refuse = |why: &str| {
            let said: String = said.iter().map(|line| format!("\n  {line}")).collect();
            Err(CliError::Input(format!("{}: {why}{said}", self.name)))
        };
        let success = match status {
            Ok(success) => success,
            Err(Ended::TooLong(time)) => {
                let time = time.as_secs_f64();
                return refuse(&format!(
                    "OpenSCAD took longer than {time} s, and was ended: --openscad-time allows more"
                ));
            }
            Err(Ended::TooLarge) => {
                let most = MAX_FILE_BYTES >> 20;
                return refuse(&format!("OpenSCAD wrote more than {most} MiB, and was ended"));
            }
            Err(Ended::Stopped) => return refuse("OpenSCAD was ended"),
            Err(Ended::Failed(e)) if e.kind() == io::ErrorKind::NotFound => {
                return refuse(
                    "this is a program of OpenSCAD, which has to be installed for that, as `openscad` on the path: \
                     `apt install openscad`, `brew install openscad`, or from openscad.org",
                );
            }
            Err(Ended::Failed(e)) => return refuse(&format!("OpenSCAD could not be run: {e}")),
        };
        // Of a failed `assert` some versions tell, and end as if all were well.
        if !success || said.iter().any(|line| line.starts_with("ERROR:")) {
            return refuse("OpenSCAD makes nothing of it");
        }
        match read_limited(&csg) {
            Ok(csg) => Ok(Conversion { csg, files: self.files(&list), said }),
            Err(_) => refuse("OpenSCAD wrote nothing"),
        }
    }

    fn command(&self, csg: &Path, list: &Path) -> Command {
        let mut command = Command::new(PROGRAM);
        command.arg("-o").arg(csg).arg("-d").arg(list);
        for define in &self.arguments.define {
            command.arg("-D").arg(define);
        }
        if let Some(file) = &self.arguments.parameters {
            command.arg("-p").arg(file);
        }
        if let Some(set) = &self.arguments.set {
            command.arg("-P").arg(set);
        }
        match self.program {
            // A name that begins with a hyphen is no option.
            Program::File(path) if path.is_relative() => command.arg(Path::new(".").join(path)),
            Program::File(path) => command.arg(path),
            Program::Text(_) => command.arg("-"),
        };
        let input = if matches!(self.program, Program::Text(_)) { Stdio::piped() } else { Stdio::null() };
        command.stdin(input).stdout(Stdio::null()).stderr(Stdio::piped());
        // On some systems `openscad` is a script: what that starts ends with it.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        command
    }

    /// Runs it to its end; gives whether that is one of success, and what it said.
    fn work(&self, csg: &Path, list: &Path, said: &mut Vec<u8>) -> Result<bool, Ended> {
        let deadline = Instant::now() + self.arguments.openscad_time.unwrap_or(TIME);
        let mut child = self.command(csg, list).spawn().map_err(Ended::Failed)?;
        let (input, output) = (child.stdin.take(), child.stderr.take());
        self.run.take(child);
        if let (Some(mut input), Program::Text(text)) = (input, self.program) {
            let text = text.to_vec();
            // Who does not read it to its end says why.
            spawn("openscad-in", move || drop(input.write_all(&text)))?;
        }
        let (words, heard) = mpsc::channel();
        if let Some(output) = output {
            spawn("openscad-out", move || {
                let mut output = output;
                let mut text = Vec::new();
                let _ = output.by_ref().take(MOST_SAID).read_to_end(&mut text);
                let _ = io::copy(&mut output, &mut io::sink());
                // Nobody waits for the words of a run that was ended.
                let _ = words.send(text);
            })?;
        }
        let result = self.wait(csg, deadline, &heard, said);
        if result.is_err() {
            self.run.kill();
            if said.is_empty() {
                *said = heard.recv_timeout(TICK).unwrap_or_default();
            }
        }
        result
    }

    fn wait(
        &self,
        csg: &Path,
        deadline: Instant,
        heard: &Receiver<Vec<u8>>,
        said: &mut Vec<u8>,
    ) -> Result<bool, Ended> {
        let mut tick = TICK;
        loop {
            match heard.recv_timeout(tick) {
                Ok(text) => {
                    *said = text;
                    // It is about to end: what it says ends with it.
                    tick = Duration::from_millis(1);
                }
                Err(RecvTimeoutError::Disconnected) => thread::sleep(tick),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if fs::metadata(csg).is_ok_and(|found| found.len() > MAX_FILE_BYTES) {
                return Err(Ended::TooLarge);
            }
            if let Some(success) = self.run.ended()? {
                if said.is_empty() {
                    *said = heard.recv_timeout(TICK).unwrap_or_default();
                }
                return Ok(success);
            }
            if self.interrupts.is_some_and(Interrupts::came) {
                return Err(Ended::Stopped);
            }
            if Instant::now() > deadline {
                return Err(Ended::TooLong(self.arguments.openscad_time.unwrap_or(TIME)));
            }
        }
    }

    /// The files that OpenSCAD read, as its list of dependencies for `make` names them.
    fn files(&self, list: &Path) -> Vec<PathBuf> {
        let text = read_limited(list).unwrap_or_default();
        let mut files = dependencies(&String::from_utf8_lossy(&text));
        if let Program::File(path) = self.program {
            files.push(path.to_owned());
        }
        files.extend(self.arguments.parameters.clone());
        files
    }
}

fn spawn(name: &str, work: impl FnOnce() + Send + 'static) -> Result<(), Ended> {
    thread::Builder::new().name(name.to_owned()).spawn(work).map(drop).map_err(Ended::Failed)
}

impl OpenScadRun {
    /// One that ends by signals, before they end the program.
    pub fn minding_signals() -> Self {
        Self { minds_signals: true, ..Self::default() }
    }

    /// Ends it, and any that is begun later; nothing of it is left when this returns.
    pub fn end(&self) {
        self.lock().is_ended = true;
        self.kill();
        // Long enough for its thread to notice on any machine; and no reason not to end.
        let begun = |run: &mut Run| run.is_begun;
        drop(self.changed.wait_timeout_while(self.lock(), Duration::from_secs(1), begun));
    }

    fn set_begun(&self, is_begun: bool) {
        self.lock().is_begun = is_begun;
        self.changed.notify_all();
    }

    fn take(&self, child: Child) {
        let mut run = self.lock();
        run.child = Some(child);
        let is_ended = run.is_ended;
        drop(run);
        if is_ended {
            self.kill();
        }
    }

    /// Whether it has ended by itself, and then whether with success.
    fn ended(&self) -> Result<Option<bool>, Ended> {
        let mut run = self.lock();
        let Some(child) = &mut run.child else { return Err(Ended::Stopped) };
        let status = child.try_wait().map_err(Ended::Failed)?;
        if status.is_some() {
            run.child = None;
        }
        if run.is_ended { Err(Ended::Stopped) } else { Ok(status.map(|status| status.success())) }
    }

    /// Ends what is running, if anything is.
    fn kill(&self) {
        let Some(mut child) = self.lock().child.take() else { return };
        // Until it is waited for, its number is nobody else's.
        #[cfg(unix)]
        let _ = rustix::process::kill_process_group(
            rustix::process::Pid::from_child(&child),
            rustix::process::Signal::KILL,
        );
        let _ = child.kill();
        let _ = child.wait();
    }

    fn lock(&self) -> MutexGuard<'_, Run> {
        // Each change is a single assignment: the state is whole after any panic.
        self.run.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn read_limited(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The lines of what was said, without empty ones, and not too many.
fn lines(said: &[u8]) -> Vec<String> {
    let text = String::from_utf8_lossy(said);
    let mut all = text.lines().map(str::trim_end).filter(|line| !line.is_empty());
    let mut lines: Vec<String> = all.by_ref().take(MOST_LINES).map(visible).collect();
    match all.count() {
        0 => {}
        more => lines.push(format!("and {more} lines more")),
    }
    lines
}

/// The files behind the colon of a rule for `make`: they are parted by blanks and by ends of lines with a
/// backslash before them; any other character behind a backslash is itself.
fn dependencies(rule: &str) -> Vec<PathBuf> {
    let list = rule.split_once(": ").or_else(|| rule.split_once(":\t")).map_or("", |(_, list)| list);
    let mut files = Vec::new();
    let mut file = String::new();
    let mut characters = list.chars();
    while let Some(character) = characters.next() {
        match character {
            '\\' => match characters.next() {
                Some('\n' | '\r') | None => {}
                Some(other) => file.push(other),
            },
            ' ' | '\t' | '\n' | '\r' => {
                if !file.is_empty() {
                    files.push(PathBuf::from(std::mem::take(&mut file)));
                }
            }
            other => file.push(other),
        }
    }
    if !file.is_empty() {
        files.push(PathBuf::from(file));
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As OpenSCAD 2021.01 writes it, blanks and all.
    #[test]
    fn dependencies_are_read_as_openscad_writes_them() {
        let rule =
            "/tmp/x y.csg: \\\n\t/home/a\\ b/part.stl \\\n\t/usr/share/q\"#$.scad \\\n\ta\\ b/pa\\ rt.scad\n";
        let files = dependencies(rule);
        let expected = ["/home/a b/part.stl", "/usr/share/q\"#$.scad", "a b/pa rt.scad"];
        assert_eq!(files, expected.map(PathBuf::from));
        assert!(dependencies("").is_empty() && dependencies("x.csg:").is_empty());
    }

    #[test]
    fn not_all_that_is_said_is_told() {
        let said = "WARNING: a\u{1b}[2J\n\n".repeat(100);
        let lines = lines(said.as_bytes());
        assert_eq!(lines.len(), MOST_LINES + 1);
        assert_eq!(
            (lines[0].as_str(), lines[MOST_LINES].as_str()),
            ("WARNING: a\\u{1b}[2J", "and 60 lines more")
        );
    }
}
