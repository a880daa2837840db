//! Stopping for a while, as Ctrl-Z asks for.

use super::AppError;
use super::events::Inbox;
#[cfg(unix)]
use super::signals;
use super::terminal::Terminal;

/// Gives the terminal back and stops; `Event::Continued` says when to take it again.
#[cfg(unix)]
pub fn suspend(terminal: &mut Terminal, inbox: &mut Inbox) -> Result<(), AppError> {
    if signals::can_stop() {
        terminal.give_back(inbox)?;
        signals::stop()?;
    }
    Ok(())
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "one signature for all systems")]
pub fn suspend(_: &mut Terminal, _: &mut Inbox) -> Result<(), AppError> {
    Ok(())
}
