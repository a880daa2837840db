//! What can go wrong, and the exit code that says so.

use std::io::Write;
use std::process::ExitCode;

use crate::app::AppError;

/// An error of the command line.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// Bad input or arguments: exit code 2.
    #[error("error: {0}")]
    Input(String),
    /// Arguments that clap refuses, in its words: exit code 2.
    #[error("{0}")]
    Arguments(String),
    /// A scene that is no scene, already rendered with its places: exit code 2.
    #[error("{0}")]
    Scene(String),
    /// Pictures that were to be the same are not: exit code 1, which `diff` and `snapshot` have for nothing
    /// else.
    #[error("{0}")]
    Different(String),
    /// Something could not be written: exit code 1.
    #[error("error: {0}")]
    Output(String),
    /// Ctrl-C came before there was anything to tell: the exit code of a program that it has ended.
    #[error("{0}")]
    Interrupted(String),
    /// The viewer ended other than by a key: exit code 1.
    #[error("error: {0}")]
    Viewer(#[from] AppError),
}

/// What a shell reports of a program that Ctrl-C has ended: 128, and 2 of SIGINT.
pub const INTERRUPTED: u8 = 130;

impl CliError {
    /// The exit code.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Input(_) | Self::Arguments(_) | Self::Scene(_) => ExitCode::from(2),
            Self::Interrupted(_) => ExitCode::from(INTERRUPTED),
            Self::Different(_) | Self::Output(_) | Self::Viewer(_) => ExitCode::from(1),
        }
    }

    /// What could not be written as an error of exit code 2, as diff(1) has it: 1 says that pictures differ.
    pub fn apart_from_differences(self) -> Self {
        match self {
            Self::Output(what) => Self::Input(what),
            other => other,
        }
    }

    /// Says it on standard error.
    pub fn report(&self) {
        match self {
            // Its own colours are escape sequences, and what is others' in it was made visible with them.
            Self::Scene(rendered) => say(rendered),
            _ => tell(&self.to_string()),
        }
    }
}

/// Says a line on standard error. Where even that fails, as after a hang-up, there is nobody to tell.
pub fn tell(line: &str) {
    say(&visible(line));
}

fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A text whose control characters are seen and not obeyed: names of files and views are other people's, and
/// a terminal does what an escape sequence says.
pub fn visible(text: &str) -> String {
    let is_harmless = |c: char| !c.is_control() || matches!(c, '\n' | '\t');
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if is_harmless(c) { shown.push(c) } else { shown.extend(c.escape_default()) }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From a view named `ESC ]0;EVIL BEL`, which set the title of the terminal.
    #[test]
    fn escape_sequences_are_seen() {
        assert_eq!(visible("a\u{1b}]0;x\u{7}b\n\u{9b}c é"), "a\\u{1b}]0;x\\u{7}b\n\\u{9b}c é");
    }
}
