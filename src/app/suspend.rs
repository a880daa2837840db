//! Stopping for a while, as Ctrl-Z asks for.

use super::AppError;
#[cfg(unix)]
use super::signals;
use super::terminal::Terminal;

/// Gives the terminal back and stops; `Event::Continued` says when to take it again.
#[cfg(unix)]
pub fn suspend(terminal: &Terminal) -> Result<(), AppError> {
    if signals::can_stop() {
        terminal.hold().release()?;
        signals::stop()?;
    }
    Ok(())
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "one signature for all systems")]
pub fn suspend(_: &Terminal) -> Result<(), AppError> {
    Ok(())
}
