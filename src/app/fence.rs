//! Status requests that the terminal has not answered yet: what comes of them after the end would be the
//! shell's.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::pacing::PATIENCE;

/// So long is an answer waited for where none has ever come: what a terminal across an ocean takes. A person
/// who waits for the first picture, or for the shell, hardly notices.
pub const UNKNOWN_PATIENCE: Duration = Duration::from_millis(200);

/// The numbers of the requests sent and answered, shared by the threads that write, read, and give the
/// terminal back.
#[derive(Clone, Default)]
pub struct Fence(Arc<Shared>);

#[derive(Default)]
struct Shared {
    requests: Mutex<Requests>,
    answered: Condvar,
}

#[derive(Clone, Copy, Debug, Default)]
struct Requests {
    /// The number of the last one that was sent; they count from 1.
    sent: u64,
    /// The number of the last one that was answered or is no longer expected to be.
    done: u64,
    /// When the last one was sent.
    last: Option<Instant>,
    /// Whether one ever was answered.
    answers: bool,
}

impl Requests {
    /// How long what is on its way is waited for at the end. Where the terminal has answered before, answers
    /// are certainly on their way, and the shell would take them for typed: as long as a picture may take.
    fn patience(&self, now: Instant) -> Duration {
        match self.last {
            Some(last) if self.answers => (last + PATIENCE).saturating_duration_since(now),
            _ => UNKNOWN_PATIENCE,
        }
    }

    const fn are_on_their_way(&self) -> bool {
        self.done < self.sent
    }
}

impl Fence {
    /// Notes that a request is sent; gives its number.
    pub fn sent(&self) -> u64 {
        let mut requests = self.lock();
        requests.sent += 1;
        requests.last = Some(Instant::now());
        requests.sent
    }

    /// Notes that one was answered; gives its number.
    pub fn answered(&self) -> u64 {
        let mut requests = self.lock();
        // One more than was asked for is the answer to somebody else.
        requests.done = requests.sent.min(requests.done + 1);
        requests.answers = true;
        self.0.answered.notify_all();
        requests.done
    }

    /// How many have no answer yet.
    pub fn unanswered(&self) -> usize {
        let requests = self.lock();
        usize::try_from(requests.sent - requests.done).unwrap_or(usize::MAX)
    }

    /// Waits for what is on its way, but not for ever, and no longer afterwards.
    pub fn wait(&self) {
        let requests = self.lock();
        let patience = requests.patience(Instant::now());
        let on_their_way = |requests: &mut Requests| requests.are_on_their_way();
        let waited = self.0.answered.wait_timeout_while(requests, patience, on_their_way);
        let mut requests = waited.unwrap_or_else(PoisonError::into_inner).0;
        requests.done = requests.sent;
    }

    /// Expects no answers any more: they have come to whoever had the terminal meanwhile, or the terminal is
    /// gone.
    pub fn forget(&self) {
        let mut requests = self.lock();
        requests.done = requests.sent;
        self.0.answered.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Requests> {
        // Numbers, a time and a flag are whole after any panic.
        self.0.requests.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::thread;

    use super::*;

    /// A terminal that has answered once.
    fn answering() -> Fence {
        let fence = Fence::default();
        assert_eq!((fence.sent(), fence.answered()), (1, 1));
        fence
    }

    #[test]
    fn what_is_on_its_way_is_waited_for() {
        let (order, events) = mpsc::channel();
        let fence = answering();
        assert_eq!([fence.sent(), fence.sent()], [2, 3]);
        let (reader, answer) = (fence.clone(), order.clone());
        let answers = thread::spawn(move || {
            for number in [2, 3] {
                // Time for a wait that does not last to come first.
                thread::sleep(Duration::from_millis(30));
                answer.send("answer").unwrap();
                assert_eq!(reader.answered(), number);
            }
        });
        fence.wait();
        order.send("waited").unwrap();
        answers.join().unwrap();
        drop(order);
        assert_eq!(events.iter().collect::<Vec<_>>(), ["answer", "answer", "waited"]);
    }

    #[test]
    fn what_never_comes_is_given_up() {
        let fence = Fence::default();
        fence.sent();
        fence.wait();
        assert_eq!(fence.unanswered(), 0);
        fence.answered();
        assert_eq!(fence.unanswered(), 0, "an answer that comes all the same");
        assert_eq!((fence.sent(), fence.unanswered(), fence.answered()), (2, 1, 2));
        fence.sent();
        fence.forget();
        assert_eq!(fence.unanswered(), 0);
    }

    /// It was a second, and a first picture alone takes four at 80 kbit/s.
    #[test]
    fn an_answer_may_take_as_long_as_a_picture_counted_from_its_request() {
        let fence = answering();
        fence.sent();
        let requests = *fence.lock();
        let sent = requests.last.unwrap();
        assert_eq!(requests.patience(sent), PATIENCE);
        assert_eq!(requests.patience(sent + PATIENCE / 2), PATIENCE / 2);
        assert_eq!(requests.patience(sent + PATIENCE), Duration::ZERO);
        let silent = Fence::default();
        silent.sent();
        assert_eq!(silent.lock().patience(sent), UNKNOWN_PATIENCE);
    }
}
