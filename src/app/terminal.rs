//! The terminal: taken, drawn on, and given back as it was, whatever ends the program.

use std::io;
#[cfg(not(unix))]
use std::io::Write;
use std::panic::{self, PanicHookInfo};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;
use ratatui::crossterm::Command;
use ratatui::crossterm::cursor::{Hide, MoveTo, Show};
use ratatui::crossterm::style::ResetColor;
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode, window_size,
};
use ratatui::layout::{Rect, Size};

use super::events::{Event, Inbox};
use super::fence::{self, Fence};
#[cfg(unix)]
use super::input;
use super::input::Answer;
use super::window::Window;
use crate::output::{Capabilities, Encoder};

/// Asks a terminal to say that it has come this far (DSR 5, ECMA-48): every terminal since the VT100 answers.
/// Where there is no Unix terminal to read, nothing is asked: what we read there has keys only, and takes an
/// answer for some.
const STATUS_REQUEST: &[u8] = if cfg!(unix) { b"\x1b[5n" } else { b"" };

type Hook = dyn Fn(&PanicHookInfo<'_>) + Send + Sync;

/// A terminal in raw mode on its alternate screen, where it has one, and what stands on it. Dropping it gives
/// it back.
pub struct Terminal {
    hold: Hold,
    hook: Arc<Hook>,
    /// What the terminal shows.
    screen: Buffer,
    /// What is to be sent.
    encoder: Encoder,
}

/// What is ours of the terminal at the moment; shared by all threads that may have to give it back. Nothing
/// is written to a screen that is not ours.
#[derive(Clone)]
pub struct Hold {
    ours: Arc<Mutex<Ours>>,
    fence: Fence,
}

#[derive(Clone, Copy, Debug, Default)]
struct Ours {
    screen: bool,
    modes: bool,
    /// Whether there is no other screen than the shell's: it is cleared at the end, and the shell goes on at
    /// its top.
    only_screen: bool,
}

/// What came back when a terminal was asked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replies {
    /// The answers, in their order.
    pub answers: Vec<Answer>,
    /// How long it took until the terminal had come to the end of the questions, so that what has not been
    /// answered never will be; absent where it has not come so far.
    pub took: Option<Duration>,
    /// How many status requests it has still to come to, those sent before the questions included.
    pub unanswered: usize,
}

impl Replies {
    /// Takes what arrives until the terminal comes to the status request of a number; those before it are
    /// other people's. What else happens meanwhile is put aside.
    fn up_to(number: u64, begun: Instant, inbox: &mut Inbox, mut unanswered: usize) -> Self {
        let mut replies = Self::default();
        while let Ok(Some(event)) = inbox.next_arrival(Some(begun + fence::UNKNOWN_PATIENCE)) {
            match event {
                Event::Reached(reached) if reached < number => {
                    unanswered = usize::try_from(number - reached).unwrap_or(usize::MAX);
                }
                Event::Reached(_) => {
                    return Self { took: Some(begun.elapsed()), unanswered: 0, ..replies };
                }
                Event::Answer(answer) => replies.answers.push(answer),
                event => {
                    let urgent = event.is_urgent();
                    inbox.put_aside(event);
                    if urgent {
                        break;
                    }
                }
            }
        }
        Self { unanswered, ..replies }
    }
}

impl Terminal {
    /// Takes the terminal. From now on a panic on any thread gives it back before its message is printed.
    pub fn take(capabilities: Capabilities) -> io::Result<Self> {
        let ours = Ours { only_screen: !capabilities.alternate_screen, ..Ours::default() };
        let hold = Hold { ours: Arc::new(Mutex::new(ours)), fence: Fence::default() };
        let hook: Arc<Hook> = Arc::from(panic::take_hook());
        panic::set_hook(Box::new({
            let (hold, hook) = (hold.clone(), hook.clone());
            move |info| {
                // A terminal that is gone cannot be given back; the message matters more.
                let _ = hold.release();
                hook(info);
            }
        }));
        let mut terminal =
            Self { hold, hook, screen: Buffer::empty(Rect::ZERO), encoder: Encoder::default() };
        terminal.retake()?;
        Ok(terminal)
    }

    /// What other threads need to give the terminal back.
    pub fn hold(&self) -> Hold {
        self.hold.clone()
    }

    /// Takes the terminal again, after [`Hold::release`] or after something else has used it.
    pub fn retake(&mut self) -> io::Result<()> {
        self.hold.acquire()?;
        self.forget();
        // What was on its way has come to whoever had the terminal.
        self.hold.fence.forget();
        Ok(())
    }

    /// Asks questions, with a status request behind them, and waits for the answers up to that. What else
    /// happens meanwhile is put aside.
    ///
    /// A terminal that does not know a question says nothing to it, but answers the status request, so that
    /// only one that answers nothing at all is waited for.
    pub fn ask(&mut self, questions: &[u8], inbox: &mut Inbox) -> io::Result<Replies> {
        let begun = Instant::now();
        let before = self.hold.fence.unanswered();
        Ok(match self.hold.ask(questions)? {
            Some(number) => Replies::up_to(number, begun, inbox, before + 1),
            None => Replies::default(),
        })
    }

    /// Trusts nothing that stands on the screen: the next picture is sent whole.
    pub fn forget(&mut self) {
        self.screen = Buffer::empty(Rect::ZERO);
    }

    /// Whether the terminal shows this screen already.
    pub fn shows(&self, screen: &Buffer) -> bool {
        self.screen == *screen
    }

    /// Queues what turns the screen into `next`; gives the number of bytes that are now to be sent.
    pub fn queue(&mut self, next: Buffer) -> usize {
        if self.screen.area != next.area {
            self.encoder.clear();
            self.screen = Buffer::empty(next.area);
        }
        self.encoder.turn(&self.screen, &next);
        self.screen = next;
        self.encoder.len()
    }

    /// Sends what is queued, in one write, for the terminal to show at once, and a status request behind it.
    /// Nothing queued, nothing sent; gives how many bytes were.
    pub fn send(&mut self) -> io::Result<usize> {
        let update = self.encoder.take();
        if update.is_empty() {
            return Ok(0);
        }
        let mut bytes = commands(&[&BeginSynchronizedUpdate]);
        bytes.extend(update.as_bytes());
        bytes.extend(commands(&[&EndSynchronizedUpdate]));
        let is_sent = self.hold.ask(&bytes)?.is_some();
        Ok(if is_sent { bytes.len() + STATUS_REQUEST.len() } else { 0 })
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // Nobody is left to tell.
        let _ = self.hold.release();
        // A panicking thread may not change the hook; the process is about to end anyway.
        if !thread::panicking() {
            let hook = self.hook.clone();
            panic::set_hook(Box::new(move |info| hook(info)));
        }
    }
}

impl Hold {
    /// Raw mode, alternate screen, no cursor.
    fn acquire(&self) -> io::Result<()> {
        let mut ours = self.lock();
        if ours.modes {
            // A shell may have changed the modes while we were stopped; crossterm believes they are still
            // raw.
            disable_raw_mode()?;
        }
        enable_raw_mode()?;
        (ours.screen, ours.modes) = (true, true);
        if ours.only_screen {
            return send(&[&commands(&[&ResetColor, &Hide]), MOUSE_ON].concat());
        }
        // The alternate screen keeps colours with the cursor, and gives them back: they may be those of our
        // last picture, after a stop that nobody could prepare.
        send(&[&commands(&[&ResetColor, &EnterAlternateScreen, &Hide]), MOUSE_ON].concat())
    }

    /// The status requests that have not been answered.
    pub fn fence(&self) -> Fence {
        self.fence.clone()
    }

    /// Gives the terminal back: the screen of before, the cursor and plain attributes at once; cooked mode
    /// when the answers have come that are on their way, for a shell would take them for typed.
    pub fn release(&self) -> io::Result<()> {
        let sent = self.lock().release_screen();
        if self.lock().modes {
            self.fence.wait();
        }
        self.lock().release().and(sent)
    }

    /// Gives the terminal back as far as this goes without waiting: while another thread hangs in a write to
    /// a terminal that takes nothing, only its modes can be.
    pub fn release_now(&self) {
        let _ = match self.ours.try_lock() {
            Ok(mut ours) => ours.release(),
            Err(TryLockError::Poisoned(poison)) => poison.into_inner().release(),
            Err(TryLockError::WouldBlock) => disable_raw_mode(),
        };
    }

    /// Writes, and a status request behind it, where the screen is ours; gives the number of the request.
    fn ask(&self, bytes: &[u8]) -> io::Result<Option<u64>> {
        let ours = self.lock();
        if !ours.screen {
            return Ok(None);
        }
        // Before it is written: a terminal nearby answers sooner than this thread goes on, and the answer to
        // what nobody has sent yet would not count.
        let number = if STATUS_REQUEST.is_empty() { 0 } else { self.fence.sent() };
        // What cannot be written is not answered.
        send(&[bytes, STATUS_REQUEST].concat()).inspect_err(|_| self.fence.forget())?;
        Ok(Some(number))
    }

    fn lock(&self) -> MutexGuard<'_, Ours> {
        // Flags are whole after any panic.
        self.ours.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Ours {
    fn release(&mut self) -> io::Result<()> {
        // The modes go back even if the screen cannot.
        let sent = self.release_screen();
        if !std::mem::take(&mut self.modes) {
            return sent;
        }
        let cooked = disable_raw_mode();
        // What the reading thread has not taken yet came while the terminal was ours. Where it cannot be
        // thrown away there is nobody to read it either.
        #[cfg(unix)]
        let _ = input::discard();
        cooked.and(sent)
    }

    fn release_screen(&mut self) -> io::Result<()> {
        if !std::mem::take(&mut self.screen) {
            return Ok(());
        }
        // A panic may have come in the middle of an update.
        let mut bytes = commands(&[&EndSynchronizedUpdate, &ResetColor, &Show]);
        bytes.extend(MOUSE_OFF);
        bytes.extend(if self.only_screen {
            commands(&[&Clear(ClearType::All), &MoveTo(0, 0)])
        } else {
            commands(&[&LeaveAlternateScreen, &ResetColor, &Show])
        });
        send(&bytes)
    }
}

fn commands(commands: &[&dyn AnsiCommand]) -> Vec<u8> {
    let mut text = String::new();
    for command in commands {
        // Writing to a string does not fail.
        let _ = command.write(&mut text);
    }
    text.into_bytes()
}

/// Presses and the wheel are told (1000), by places of any size (1006). Not more: each motion would be a
/// packet. What a terminal does not know of this it ignores.
const MOUSE_ON: &[u8] = b"\x1b[?1000h\x1b[?1006h";

/// The mouse is the terminal's own again.
const MOUSE_OFF: &[u8] = b"\x1b[?1006l\x1b[?1000l";

/// Commands of different types in one list.
trait AnsiCommand {
    fn write(&self, text: &mut String) -> std::fmt::Result;
}

impl<C: Command> AnsiCommand for C {
    fn write(&self, text: &mut String) -> std::fmt::Result {
        self.write_ansi(text)
    }
}

/// Writes past the buffer of standard output, which would part what has a line's end in it.
#[cfg(unix)]
fn send(mut bytes: &[u8]) -> io::Result<()> {
    let output = io::stdout().lock();
    while !bytes.is_empty() {
        match rustix::io::write(&output, bytes) {
            Ok(written) => bytes = &bytes[written..],
            Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

#[cfg(not(unix))]
fn send(bytes: &[u8]) -> io::Result<()> {
    let mut output = io::stdout().lock();
    output.write_all(bytes)?;
    output.flush()
}

/// The size of the terminal now; zeros where it does not say.
pub fn window() -> Window {
    window_size().map_or_else(
        |_| Window::default(),
        |size| Window {
            cells: Size::new(size.columns, size.rows),
            pixels: Size::new(size.width, size.height),
        },
    )
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    /// The answer to the status request of the loading screen ended the wait for the colours.
    #[test]
    fn what_was_asked_before_does_not_end_the_answers() {
        let identity = Answer::Identity { kind: 41, version: 388 };
        let (sender, events) = mpsc::channel();
        for event in [Event::Reached(6), Event::Resized, Event::Answer(identity), Event::Reached(7)] {
            sender.send(event).unwrap();
        }
        let mut inbox = Inbox::new(events);
        let replies = Replies::up_to(7, Instant::now(), &mut inbox, 2);
        assert_eq!((replies.answers, replies.unanswered), (vec![identity], 0));
        assert!(replies.took.is_some());
        assert!(matches!(inbox.try_next(), Some(Event::Resized)));
        assert!(inbox.try_next().is_none());
    }

    #[test]
    fn what_does_not_come_in_time_is_counted() {
        for (reached, unanswered) in [(None, 3), (Some(5), 2), (Some(6), 1)] {
            let (sender, events) = mpsc::channel();
            if let Some(reached) = reached {
                sender.send(Event::Reached(reached)).unwrap();
            }
            // Nobody is left to send: nothing is waited for.
            drop(sender);
            let replies = Replies::up_to(7, Instant::now(), &mut Inbox::new(events), 3);
            assert_eq!((replies.took, replies.unanswered), (None, unanswered));
        }
    }
}
