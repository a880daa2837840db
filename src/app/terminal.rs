//! The terminal: taken, drawn on, and given back as it was, whatever ends the program.

use std::io::{self, Write};
use std::panic::{self, PanicHookInfo};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;

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

use super::model::Window;
use crate::output::Capabilities;

type Hook = dyn Fn(&PanicHookInfo<'_>) + Send + Sync;

/// A terminal in raw mode on its alternate screen, where it has one, and what stands on it. Dropping it gives it back.
pub struct Terminal {
    hold: Hold,
    hook: Arc<Hook>,
    /// What the terminal shows.
    screen: Buffer,
    /// What is to be sent.
    queue: Vec<u8>,
}

/// Whether the terminal is ours at the moment; shared by all threads that may have to give it back. Nothing is
/// written to a terminal that is not ours.
#[derive(Clone)]
pub struct Hold {
    ours: Arc<Mutex<bool>>,
    /// Whether there is a second screen. Where there is none, the one that there is is cleared at the end: the
    /// shell goes on at its top.
    alternate_screen: bool,
}

impl Terminal {
    /// Takes the terminal. From now on a panic on any thread gives it back before its message is printed.
    pub fn take(capabilities: &Capabilities) -> io::Result<Self> {
        let hold = Hold { ours: Arc::default(), alternate_screen: capabilities.alternate_screen };
        let hook: Arc<Hook> = Arc::from(panic::take_hook());
        panic::set_hook(Box::new({
            let (hold, hook) = (hold.clone(), hook.clone());
            move |info| {
                // A terminal that is gone cannot be given back; the message matters more.
                let _ = hold.release();
                hook(info);
            }
        }));
        let mut terminal = Self { hold, hook, screen: Buffer::empty(Rect::ZERO), queue: Vec::new() };
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
        Ok(())
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
        if *ours {
            // A shell may have changed the modes while we were stopped; crossterm believes they are still raw.
            disable_raw_mode()?;
        }
        enable_raw_mode()?;
        *ours = true;
        if self.alternate_screen {
            send(&commands(&[&EnterAlternateScreen, &Hide]))
        } else {
            send(&commands(&[&Hide]))
        }
    }

    /// Gives the terminal back: cooked mode, the screen of before, the cursor, plain attributes.
    pub fn release(&self) -> io::Result<()> {
        let mut ours = self.lock();
        self.give_back(&mut ours)
    }

    /// Gives the terminal back as far as this goes without waiting: while another thread hangs in a write to a
    /// terminal that takes nothing, only its modes can be.
    pub fn release_now(&self) {
        let _ = match self.ours.try_lock() {
            Ok(mut ours) => self.give_back(&mut ours),
            Err(TryLockError::Poisoned(poison)) => self.give_back(&mut poison.into_inner()),
            Err(TryLockError::WouldBlock) => disable_raw_mode(),
        };
    }

    fn write(&self, bytes: &[u8]) -> io::Result<()> {
        let ours = self.lock();
        if *ours { send(bytes) } else { Ok(()) }
    }

    fn lock(&self) -> MutexGuard<'_, bool> {
        // A flag is whole after any panic.
        self.ours.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn give_back(&self, ours: &mut bool) -> io::Result<()> {
        if !std::mem::take(ours) {
            return Ok(());
        }
        // A panic may have come in the middle of an update. The modes go back even if the screen cannot.
        let sent = if self.alternate_screen {
            send(&commands(&[&EndSynchronizedUpdate, &ResetColor, &Show, &LeaveAlternateScreen, &Show]))
        } else {
            let clear = Clear(ClearType::All);
            send(&commands(&[&EndSynchronizedUpdate, &ResetColor, &clear, &MoveTo(0, 0), &Show]))
        };
        disable_raw_mode().and(sent)
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
