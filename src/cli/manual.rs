//! What the program says of itself to shells and to `man`.

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, bold, roman};

use crate::app;

use super::arguments::Arguments;
use super::error::CliError;
use super::write::print;

/// The script that makes a shell complete arguments.
pub fn completions(shell: Shell) -> Result<(), CliError> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), env!("CARGO_PKG_NAME"), &mut script);
    print(&script)
}

/// The page of the program, or of one of its commands.
pub fn page(command: Option<&str>) -> Result<(), CliError> {
    let mut program = Arguments::command();
    // Pages of commands are named and linked as git's are: ray13-render(1).
    program.build();
    let page = match command {
        None => program,
        Some(name) => {
            let names: Vec<String> = program.get_subcommands().map(|c| c.get_name().to_owned()).collect();
            let found = program.find_subcommand(name).ok_or_else(|| {
                CliError::Input(format!("there is no command `{name}`; there are {}", names.join(", ")))
            })?;
            found.clone()
        }
    };
    let mut text = Vec::new();
    let written = Man::new(page).render(&mut text);
    written.map_err(|e| CliError::Output(format!("the page could not be written: {e}")))?;
    if command.is_none() {
        keys()
            .to_writer(&mut text)
            .map_err(|e| CliError::Output(format!("the page could not be written: {e}")))?;
    }
    print(&text)
}

/// The section of the keys.
fn keys() -> Roff {
    let mut section = Roff::new();
    section.control("SH", ["KEYS"]);
    for (keys, sentence) in app::key_list() {
        section.control("TP", []).text([bold(keys)]).text([roman(format!("{sentence}."))]);
    }
    section
}
