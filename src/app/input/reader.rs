//! The thread that reads the terminal.

use std::fs::File;
use std::io::{self, IsTerminal};
use std::os::fd::{AsFd, OwnedFd};
use std::thread;
use std::time::Instant;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{Errno, read};
use rustix::termios::{QueueSelector, tcflush};

use super::Input;
use super::decoder::Decoder;

/// Starts to read, until the terminal is gone, and to tell what came. It wakes for bytes only, and by
/// the clock only while a sequence is unfinished.
pub fn start(tell: impl FnMut(Input) + Send + 'static) -> io::Result<()> {
    let line = line()?;
    thread::Builder::new().name("keys".to_owned()).spawn(move || read_to_end(&line, tell)).map(drop)
}

/// The terminal: standard input, or the controlling terminal where that is something else.
fn line() -> io::Result<OwnedFd> {
    let input = io::stdin();
    if input.is_terminal() { input.as_fd().try_clone_to_owned() } else { Ok(File::open("/dev/tty")?.into()) }
}

/// Throws away what has come and nobody has read.
pub fn discard() -> io::Result<()> {
    Ok(tcflush(line()?, QueueSelector::IFlush)?)
}

fn read_to_end(line: &OwnedFd, mut tell: impl FnMut(Input)) {
    let mut decoder = Decoder::default();
    loop {
        let inputs = match next_inputs(line, &mut decoder) {
            Ok(Some(inputs)) => inputs,
            Ok(None) => vec![Input::HungUp],
            Err(error) => vec![Input::Failed(error)],
        };
        for input in inputs {
            let last = matches!(input, Input::HungUp | Input::Failed(_));
            tell(input);
            if last {
                return;
            }
        }
    }
}

/// Waits for bytes, or until the patience for an unfinished sequence ends; absent once the terminal is gone.
fn next_inputs(line: &OwnedFd, decoder: &mut Decoder) -> io::Result<Option<Vec<Input>>> {
    let left = decoder.patience_ends().map(|end| end.saturating_duration_since(Instant::now()));
    // Longer than any patience, a time-out would not fit; none is.
    let left = left.map(|left| Timespec::try_from(left).unwrap_or_default());
    let mut waiting = [PollFd::new(line, PollFlags::IN)];
    let come = match poll(&mut waiting, left.as_ref()) {
        Ok(_) => waiting[0].revents(),
        Err(Errno::INTR) => return Ok(Some(Vec::new())),
        Err(error) => return Err(error.into()),
    };
    if !come.contains(PollFlags::IN) {
        // A terminal that hung up has nothing to read, for ever.
        let gone = come.intersects(PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL);
        return Ok((!gone).then(|| decoder.wait_no_longer(Instant::now())));
    }
    let mut bytes = [0; 4096];
    match read(line, &mut bytes) {
        // What a terminal that hung up says where it still says that there is something.
        Ok(0) | Err(Errno::IO) => Ok(None),
        Ok(n) => Ok(Some(decoder.take(&bytes[..n], Instant::now()))),
        Err(Errno::INTR | Errno::AGAIN) => Ok(Some(Vec::new())),
        Err(error) => Err(error.into()),
    }
}
