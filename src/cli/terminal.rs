//! The terminal of this process: what the environment says of it, and what the terminfo database has of its
//! name.

use std::env;
use std::fs;
use std::io::IsTerminal;
use std::path::PathBuf;

use crate::output::{Capabilities, Description, Environment, is_known};

/// Where descriptions are kept, after `TERMINFO`, the person's own and `TERMINFO_DIRS`: ncurses' places on
/// Linux, the BSDs and macOS.
const FOLDERS: [&str; 5] = [
    "/etc/terminfo",
    "/lib/terminfo",
    "/usr/share/terminfo",
    "/usr/lib/terminfo",
    "/usr/local/share/terminfo",
];

/// What the terminal can do.
pub fn capabilities() -> Capabilities {
    Capabilities::of(&environment())
}

/// The same of standard output; nothing where that is no terminal.
pub fn of_output() -> Option<Capabilities> {
    std::io::stdout().is_terminal().then(capabilities)
}

/// Why there is no viewer on such a terminal.
pub fn why_a_still() -> String {
    let reason = match variable("TERM") {
        term if term.is_empty() => "TERM is not set".to_owned(),
        term if is_known(&term) => format!("a terminal of TERM={term} has no cursor to move"),
        term => format!("no description of TERM={term} tells how its cursor moves"),
    };
    format!("{reason}: a still in place of the viewer (TERM=xterm-256color suits most terminals)")
}

fn environment() -> Environment {
    let mut environment = Environment {
        term: variable("TERM"),
        colorterm: variable("COLORTERM"),
        locale: ["LC_ALL", "LC_CTYPE", "LANG"]
            .map(variable)
            .into_iter()
            .find(|v| !v.is_empty())
            .unwrap_or_default(),
        tmux: !variable("TMUX").is_empty(),
        description: None,
    };
    if cfg!(windows) && environment.term.is_empty() {
        // Its console knows neither variable, and takes UTF-8 and what xterm takes.
        "xterm-256color".clone_into(&mut environment.term);
        "C.UTF-8".clone_into(&mut environment.locale);
    }
    if !is_known(&environment.term) {
        environment.description = look_up(&environment.term);
    }
    environment
}

/// A variable; empty where it is not set or no text, which no value that matters is.
fn variable(name: &str) -> String {
    env::var(name).unwrap_or_default()
}

/// The first description of that name.
fn look_up(term: &str) -> Option<Description> {
    // The name becomes a part of a path.
    let first =
        term.chars().next().filter(|_| !term.contains(['/', '\\', '\0']) && !term.starts_with('.'))?;
    let own = env::var_os("TERMINFO").map(PathBuf::from);
    let home = env::home_dir().map(|home| home.join(".terminfo"));
    let listed = env::var_os("TERMINFO_DIRS").unwrap_or_default();
    let listed =
        env::split_paths(&listed).filter(|folder| !folder.as_os_str().is_empty()).collect::<Vec<_>>();
    let folders = own.into_iter().chain(home).chain(listed).chain(FOLDERS.map(PathBuf::from));
    // By the first letter, or by its number where letters of both cases are one (macOS).
    let below = |folder: PathBuf| {
        [first.to_string(), format!("{:x}", u32::from(first))].map(|letter| folder.join(letter).join(term))
    };
    folders.flat_map(below).find_map(|path| Description::read(&fs::read(path).ok()?))
}
