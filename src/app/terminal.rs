//! The terminal: taken, drawn on, and given back as it was, whatever ends the program.

use std::io::{self, Write};
use std::panic::{self, PanicHookInfo};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use ratatui::backend::{Backend, CrosstermBackend};
use ratatui::buffer::Buffer;
use ratatui::crossterm::cursor::{Hide, MoveTo, Show};
use ratatui::crossterm::style::ResetColor;
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen,
    LeaveAlternateScreen, disable_raw_mode, enable_raw_mode, window_size,
};
use ratatui::crossterm::{Command, queue};
use ratatui::layout::{Rect, Size};

use super::events::{Event, Inbox};
use super::input::Answer;
use super::model::Window;
use crate::output::Capabilities;

/// Asks a terminal to say that it has come this far (DSR 5, ECMA-48): every terminal since the VT100 answers.
const STATUS_REQUEST: &[u8] = b"\x1b[5n";

/// So long is an answer waited for where none has ever come: what a terminal across an ocean takes. A person who waits
/// for the first picture, or for the shell, hardly notices.
const UNKNOWN_PATIENCE: Duration = Duration::from_millis(200);

/// So long are answers waited for at the end where the terminal has answered before, so that they are certainly on
/// their way: the shell would take them for typed.
const LAST_PATIENCE: Duration = Duration::from_secs(1);

type Hook = dyn Fn(&PanicHookInfo<'_>) + Send + Sync;

/// A terminal in raw mode on its alternate screen, where it has one, and what stands on it. Dropping it gives it back.
pub struct Terminal {
    hold: Hold,
    hook: Arc<Hook>,
    /// What the terminal shows.
    screen: Buffer,
    /// What is to be sent.
    queue: Vec<u8>,
    /// Status requests that have not been answered.
    awaited: usize,
    /// Whether one ever was.
    answers: bool,
}

/// What is ours of the terminal at the moment; shared by all threads that may have to give it back. Nothing is
/// written to a screen that is not ours.
#[derive(Clone)]
pub struct Hold(Arc<Mutex<Ours>>);

#[derive(Clone, Copy, Debug, Default)]
struct Ours {
    screen: bool,
    modes: bool,
    /// Whether there is no other screen than the shell's: it is cleared at the end, and the shell goes on at its top.
    only_screen: bool,
}

/// What came back when a terminal was asked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replies {
    /// The answers, in their order.
    pub answers: Vec<Answer>,
    /// Whether the terminal has come to the end of the questions: what has not been answered never will be.
    pub complete: bool,
}

impl Terminal {
    /// Takes the terminal. From now on a panic on any thread gives it back before its message is printed.
    pub fn take(capabilities: &Capabilities) -> io::Result<Self> {
        let ours = Ours { only_screen: !capabilities.alternate_screen, ..Ours::default() };
        let hold = Hold(Arc::new(Mutex::new(ours)));
        let hook: Arc<Hook> = Arc::from(panic::take_hook());
        panic::set_hook(Box::new({
            let (hold, hook) = (hold.clone(), hook.clone());
            move |info| {
                // A terminal that is gone cannot be given back; the message matters more.
                let _ = hold.release();
                hook(info);
            }
        }));
        let mut terminal = Self {
            hold,
            hook,
            screen: Buffer::empty(Rect::ZERO),
            queue: Vec::new(),
            awaited: 0,
            answers: false,
        };
        terminal.retake()?;
        Ok(terminal)
    }

    /// What other threads need to give the terminal back.
    pub fn hold(&self) -> Hold {
        self.hold.clone()
    }

    /// Takes the terminal again, after [`Self::give_back`] or after something else has used it.
    pub fn retake(&mut self) -> io::Result<()> {
        self.hold.acquire()?;
        self.forget();
        Ok(())
    }

    /// Asks questions, with a status request behind them, and waits for the answers up to that. What else happens
    /// meanwhile is put aside.
    ///
    /// A terminal that does not know a question says nothing to it, but answers the status request, so that only one
    /// that answers nothing at all is waited for.
    pub fn ask(&mut self, questions: &[u8], inbox: &mut Inbox) -> io::Result<Replies> {
        self.hold.write(&[questions, STATUS_REQUEST].concat())?;
        self.awaited += 1;
        let answers = self.wait_for_answers(UNKNOWN_PATIENCE, inbox);
        Ok(Replies { answers, complete: self.awaited == 0 })
    }

    /// Notes that a status request was answered.
    pub fn answered(&mut self) {
        self.awaited = self.awaited.saturating_sub(1);
        self.answers = true;
    }

    /// Gives the terminal back: the screen at once, its modes when the answers have come that are on their way, for
    /// a shell would take them for typed. Keys that come meanwhile are put aside.
    pub fn give_back(&mut self, inbox: &mut Inbox) -> io::Result<()> {
        let sent = self.hold.release_screen();
        let patience = if self.answers { LAST_PATIENCE } else { UNKNOWN_PATIENCE };
        self.wait_for_answers(patience, inbox);
        // Whatever comes later is no longer an answer to us.
        self.awaited = 0;
        self.hold.release().and(sent)
    }

    /// Waits for the answers to all status requests, and gives what was answered besides. All that happens meanwhile
    /// is put aside.
    fn wait_for_answers(&mut self, patience: Duration, inbox: &mut Inbox) -> Vec<Answer> {
        let deadline = Instant::now() + patience;
        let mut answers = Vec::new();
        while self.awaited > 0 {
            match inbox.next_arrival(Some(deadline)) {
                Ok(Some(Event::Answer(Answer::Status))) => self.answered(),
                Ok(Some(Event::Answer(answer))) => answers.push(answer),
                Ok(Some(event)) => {
                    let urgent = event.is_urgent();
                    inbox.put_aside(event);
                    if urgent {
                        break;
                    }
                }
                Ok(None) | Err(_) => break,
            }
        }
        answers
    }

    /// Trusts nothing that stands on the screen: the next picture is sent whole.
    pub fn forget(&mut self) {
        self.screen = Buffer::empty(Rect::ZERO);
    }

    /// Queues what turns the screen into `next`; gives the number of bytes that are now to be sent.
    pub fn queue(&mut self, next: Buffer) -> io::Result<usize> {
        let mut backend = CrosstermBackend::new(&mut self.queue);
        if self.screen.area != next.area {
            queue!(backend, ResetColor, Clear(ClearType::All))?;
            self.screen = Buffer::empty(next.area);
        }
        let changes = self.screen.diff(&next);
        if !changes.is_empty() {
            backend.draw(changes.into_iter())?;
        }
        self.screen = next;
        Ok(self.queue.len())
    }

    /// Sends what is queued, in one write, for the terminal to show at once. Nothing queued, nothing sent.
    pub fn send(&mut self) -> io::Result<()> {
        if self.queue.is_empty() {
            return Ok(());
        }
        let mut bytes = Vec::with_capacity(self.queue.len() + 16);
        queue!(bytes, BeginSynchronizedUpdate)?;
        bytes.append(&mut self.queue);
        queue!(bytes, EndSynchronizedUpdate)?;
        self.hold.write(&bytes)
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
            // A shell may have changed the modes while we were stopped; crossterm believes they are still raw.
            disable_raw_mode()?;
        }
        enable_raw_mode()?;
        (ours.screen, ours.modes) = (true, true);
        let enter =
            if ours.only_screen { commands(&[&Hide]) } else { commands(&[&EnterAlternateScreen, &Hide]) };
        send(&enter)
    }

    /// Gives the terminal back: cooked mode, the screen of before, the cursor, plain attributes.
    pub fn release(&self) -> io::Result<()> {
        self.lock().release()
    }

    /// Gives back the screen of before, the cursor and plain attributes, but not the modes.
    fn release_screen(&self) -> io::Result<()> {
        self.lock().release_screen()
    }

    /// Gives the terminal back as far as this goes without waiting: while another thread hangs in a write to a
    /// terminal that takes nothing, only its modes can be.
    pub fn release_now(&self) {
        let _ = match self.0.try_lock() {
            Ok(mut ours) => ours.release(),
            Err(TryLockError::Poisoned(poison)) => poison.into_inner().release(),
            Err(TryLockError::WouldBlock) => disable_raw_mode(),
        };
    }

    fn write(&self, bytes: &[u8]) -> io::Result<()> {
        let ours = self.lock();
        if ours.screen { send(bytes) } else { Ok(()) }
    }

    fn lock(&self) -> MutexGuard<'_, Ours> {
        // Flags are whole after any panic.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Ours {
    fn release(&mut self) -> io::Result<()> {
        // The modes go back even if the screen cannot.
        let sent = self.release_screen();
        if std::mem::take(&mut self.modes) { disable_raw_mode().and(sent) } else { sent }
    }

    fn release_screen(&mut self) -> io::Result<()> {
        if !std::mem::take(&mut self.screen) {
            return Ok(());
        }
        // A panic may have come in the middle of an update.
        let mut bytes = commands(&[&EndSynchronizedUpdate, &ResetColor, &Show]);
        bytes.extend(if self.only_screen {
            commands(&[&Clear(ClearType::All), &MoveTo(0, 0)])
        } else {
            commands(&[&LeaveAlternateScreen, &Show])
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

/// Commands of different types in one list.
trait AnsiCommand {
    fn write(&self, text: &mut String) -> std::fmt::Result;
}

impl<C: Command> AnsiCommand for C {
    fn write(&self, text: &mut String) -> std::fmt::Result {
        self.write_ansi(text)
    }
}

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
