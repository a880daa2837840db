//! When a long piece of work is to be given up: asked between its parts, by the threads that do it.

use std::fmt::{self, Debug, Formatter};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether work is to be given up. Once it is, it stays so: of a work whose parts ask, either all have been
/// done or it is known that some were not.
pub struct GiveUp<'a> {
    when: Option<&'a (dyn Fn() -> bool + Sync)>,
    was_due: AtomicBool,
}

impl<'a> GiveUp<'a> {
    /// For work that is done whatever it takes.
    pub const fn never() -> Self {
        Self { when: None, was_due: AtomicBool::new(false) }
    }

    /// Gives up from the time on when `when` first holds.
    pub const fn when(when: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { when: Some(when), was_due: AtomicBool::new(false) }
    }

    /// Whether the rest is to be left undone.
    pub fn is_due(&self) -> bool {
        let Some(when) = self.when else { return false };
        let due = self.was_due() || when();
        if due {
            self.was_due.store(true, Ordering::Relaxed);
        }
        due
    }

    /// Whether anybody who asked was told so.
    pub fn was_due(&self) -> bool {
        self.was_due.load(Ordering::Relaxed)
    }
}

impl Debug for GiveUp<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("GiveUp").field("was_due", &self.was_due()).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_given_up_stays_so() {
        let wanted = AtomicBool::new(true);
        let when = || !wanted.load(Ordering::Relaxed);
        let give_up = GiveUp::when(&when);
        assert!(!give_up.is_due());
        wanted.store(false, Ordering::Relaxed);
        // Nobody has been told yet.
        assert!(!give_up.was_due());
        assert!(give_up.is_due() && give_up.was_due());
        wanted.store(true, Ordering::Relaxed);
        assert!(give_up.is_due());
        assert!(!GiveUp::never().is_due());
    }
}
