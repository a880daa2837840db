//! Status requests that the terminal has not answered yet: what comes of them after the end would be the
//! shell's.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// So long is an answer waited for where none has ever come: what a terminal across an ocean takes. A person
/// who waits for the first picture, or for the shell, hardly notices.
pub const UNKNOWN_PATIENCE: Duration = Duration::from_millis(200);

/// So long are answers waited for at the end where the terminal has answered before, so that they are
/// certainly on their way: the shell would take them for typed.
const LAST_PATIENCE: Duration = Duration::from_secs(1);

/// The count of requests without an answer, shared by the threads that write, read, and give the terminal
/// back.
#[derive(Clone, Default)]
pub struct Fence(Arc<Shared>);

#[derive(Default)]
struct Shared {
    requests: Mutex<Requests>,
    answered: Condvar,
}

#[derive(Clone, Copy, Debug, Default)]
struct Requests {
    unanswered: usize,
    /// Whether one ever was answered.
    answers: bool,
}

impl Fence {
    /// Notes that a request was sent.
    pub fn sent(&self) {
        self.lock().unanswered += 1;
    }

    /// Notes that one was answered.
    pub fn answered(&self) {
        let mut requests = self.lock();
        requests.unanswered = requests.unanswered.saturating_sub(1);
        requests.answers = true;
        self.0.answered.notify_all();
    }

    /// Waits for what is on its way, but not for ever, and no longer afterwards.
    pub fn wait(&self) {
        let requests = self.lock();
        let patience = if requests.answers { LAST_PATIENCE } else { UNKNOWN_PATIENCE };
        let on_its_way = |requests: &mut Requests| requests.unanswered > 0;
        let waited = self.0.answered.wait_timeout_while(requests, patience, on_its_way);
        waited.unwrap_or_else(PoisonError::into_inner).0.unanswered = 0;
    }

    /// Expects no answers any more: they have come to whoever had the terminal meanwhile, or the terminal is
    /// gone.
    pub fn forget(&self) {
        self.lock().unanswered = 0;
        self.0.answered.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Requests> {
        // A count and a flag are whole after any panic.
        self.0.requests.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn what_is_on_its_way_is_waited_for_and_nothing_else() {
        let fence = Fence::default();
        fence.wait();
        fence.sent();
        let reader = fence.clone();
        let answer = thread::spawn(move || reader.answered());
        fence.wait();
        answer.join().unwrap();
        assert!(fence.lock().answers);
        fence.sent();
        fence.forget();
        fence.wait();
    }

    #[test]
    fn what_never_comes_is_given_up() {
        let fence = Fence::default();
        fence.sent();
        fence.wait();
        assert_eq!(fence.lock().unanswered, 0);
        fence.answered();
        assert_eq!(fence.lock().unanswered, 0, "an answer that comes all the same");
    }
}
