//! Signals that end the program while it waits for another one: that one is ended first.

use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
use signal_hook::consts::{SIGINT, SIGQUIT, SIGTERM};
#[cfg(unix)]
use signal_hook::{flag, low_level};

/// What the signals of the process do, which are the same for all of it: there is one of these.
///
/// A handler that is taken away leaves a signal without any effect, so these stay, and bring about what the
/// signal does by itself while nothing is waited for.
pub struct Interrupts {
    /// The signal that came; 0 while none has.
    came: Arc<AtomicUsize>,
    /// Whether nothing is waited for.
    is_idle: Arc<AtomicBool>,
}

impl Interrupts {
    /// Those of the process, and from now on something is waited for.
    pub fn begin() -> &'static Self {
        static ALL: OnceLock<Interrupts> = OnceLock::new();
        let all = ALL.get_or_init(Self::listen);
        all.is_idle.store(false, Ordering::SeqCst);
        all
    }

    fn listen() -> Self {
        let all = Self { came: Arc::default(), is_idle: Arc::default() };
        #[cfg(unix)]
        for signal in [SIGINT, SIGQUIT, SIGTERM] {
            // Where the system allows no handler, a signal ends the program as ever.
            let number = usize::try_from(signal).unwrap_or_default();
            let _ = flag::register_conditional_default(signal, Arc::clone(&all.is_idle))
                .and_then(|_| flag::register_usize(signal, Arc::clone(&all.came), number));
        }
        all
    }

    /// Whether a signal has come.
    pub fn came(&self) -> bool {
        self.came.load(Ordering::SeqCst) != 0
    }

    /// Nothing is waited for any more: ends the program by the signal that has come, if one has.
    pub fn end(&self) {
        self.is_idle.store(true, Ordering::SeqCst);
        #[cfg(unix)]
        if let Ok(signal @ 1..) = i32::try_from(self.came.load(Ordering::SeqCst)) {
            // It returns only for signals that end nothing, and none of those is listened to.
            let _ = low_level::emulate_default_handler(signal);
        }
    }
}
