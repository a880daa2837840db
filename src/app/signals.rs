//! Signals as events; and how to stop and to end by a signal.

use std::io;
use std::process;
use std::sync::mpsc::Sender;
use std::thread;
use std::time::Duration;

use rustix::process::{getpgrp, getsid};
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGSTOP, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::iterator::Signals;
use signal_hook::low_level;

use super::events::Event;
use super::terminal::Hold;

/// How long a signal that ends us waits for an orderly end. Only a terminal that takes nothing, whose write
/// hangs, needs longer; and a service manager that sends SIGTERM kills after ten seconds or more.
const GRACE: Duration = Duration::from_secs(2);

/// Starts to listen to signals.
pub fn listen(events: Sender<Event>, hold: Hold) -> io::Result<()> {
    let mut signals = Signals::new([SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGCONT, SIGWINCH])?;
    let wait = move || {
        for signal in signals.forever() {
            let event = match signal {
                SIGTSTP => Event::Stopped,
                SIGCONT => Event::Continued,
                SIGWINCH => Event::Resized,
                signal => Event::Terminated(signal),
            };
            let last = matches!(event, Event::Terminated(_));
            match (events.send(event), last) {
                (Ok(()), false) => {}
                (Ok(()), true) => {
                    // An orderly end ends the process, and this thread with it, before the grace is over.
                    thread::sleep(GRACE);
                    hold.release_now();
                    end_by(signal);
                }
                // The viewer has ended and the program goes on. A handler that is taken away leaves the
                // signal without any effect, not with that of before, so this thread stays and brings it
                // about.
                (Err(_), true) => end_by(signal),
                (Err(_), false) => {
                    if signal == SIGTSTP && can_stop() {
                        // It cannot fail for a signal that there is; and there is nobody to tell.
                        let _ = stop();
                    }
                }
            }
        }
    };
    thread::Builder::new().name("signals".to_owned()).spawn(wait).map(drop)
}

/// Whether someone could continue us if we stopped. A shell with job control gives each job a process group
/// of its own; in the group of the session's leader there is no such shell, and stopping would be for ever.
pub fn can_stop() -> bool {
    getsid(None).is_ok_and(|session| session != getpgrp())
}

/// Stops the process until SIGCONT.
pub fn stop() -> io::Result<()> {
    low_level::raise(SIGSTOP)
}

/// Ends the process by a signal's default action, so that who started us learns of it.
pub fn end_by(signal: i32) -> ! {
    // It returns only for signals that end nothing, and none of those comes here.
    let _ = low_level::emulate_default_handler(signal);
    // What a shell reports of a process that a signal has ended.
    process::exit(128 + signal)
}
