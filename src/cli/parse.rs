//! From the words of the command line to arguments. Help and version are written as everything else is, so
//! that a full disk is an error there too; clap itself would be silent.

use std::ffi::OsString;
use std::io::IsTerminal;

use clap::error::{ContextKind, ContextValue, Error, ErrorKind};
use clap::{CommandFactory, Parser};

use super::arguments::Arguments;
use super::error::CliError;
use super::input;
use super::settings_file::with_settings;
use super::write::print;

/// The commands whose word more is no scene.
const NO_SCENE: [&str; 2] = ["completions", "man"];

/// The arguments; nothing where help or the version was asked for, and is written.
pub fn parse() -> Result<Option<Arguments>, CliError> {
    let words: Vec<OsString> = std::env::args_os().collect();
    let error = match Arguments::try_parse_from(&words) {
        Ok(mut arguments) => {
            // Of the person's own settings a still is told nothing.
            if arguments.command.is_none() && std::io::stdout().is_terminal() {
                let colour = std::io::stderr().is_terminal() && colours_are_wanted();
                arguments = with_settings(&words, colour)?.unwrap_or(arguments);
            }
            arguments.settle_up();
            return Ok(Some(arguments));
        }
        Err(error) => error,
    };
    if !error.use_stderr() {
        let colour = std::io::stdout().is_terminal() && colours_are_wanted();
        return print(text(&error, colour).as_bytes()).map(|()| None);
    }
    if let Some(message) = one_at_a_time(&error) {
        return Err(CliError::Input(message));
    }
    let colour = std::io::stderr().is_terminal() && colours_are_wanted();
    Err(CliError::Arguments(text(&error, colour).trim_end().to_owned()))
}

fn text(error: &Error, colour: bool) -> String {
    let text = error.render();
    if colour { text.ansi().to_string() } else { text.to_string() }
}

fn colours_are_wanted() -> bool {
    let forbidden = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    !forbidden && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// Of a second scene clap says that it was unexpected, or the other way about: that a command can not stand
/// behind a file.
fn one_at_a_time(error: &Error) -> Option<String> {
    if !matches!(error.kind(), ErrorKind::UnknownArgument | ErrorKind::ArgumentConflict) {
        return None;
    }
    let word =
        [ContextKind::InvalidSubcommand, ContextKind::InvalidArg].into_iter().find_map(|kind| match error
            .get(kind)
        {
            Some(ContextValue::String(word)) => Some(word.as_str()),
            _ => None,
        })?;
    let first = std::env::args_os().nth(1)?.to_string_lossy().into_owned();
    if word.starts_with('-') || NO_SCENE.contains(&first.as_str()) {
        return None;
    }
    let commands: Vec<String> =
        Arguments::command().get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let is_command = |word: &str| commands.iter().any(|command| command == word);
    Some(if is_command(word) {
        format!("a command comes first: ray13 {word} FILE")
    } else if is_command(&first) || first.starts_with('-') || input::is_scene(&first) {
        format!("one scene at a time: `{word}` is one too many")
    } else {
        format!(
            "one scene at a time: `{word}` is one too many; if `{first}` is meant as a command, there are {}",
            commands.join(", ")
        )
    })
}
