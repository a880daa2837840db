//! How far a long piece of work is: written by the threads that do it, read by one that shows it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};

use super::Stage;

/// A piece of work that may take long enough to be watched, in the order in which a picture needs them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Task {
    /// Text to solids, by the bytes of the text.
    Reading,
    /// Solids to objects, by their number.
    Assembling,
    /// Objects to lattice or boxes, by the number of what is built.
    Cutting,
    /// Rays to dots, by tiles.
    Tracing,
}

impl Task {
    /// All tasks.
    pub const ALL: [Self; 4] = [Self::Reading, Self::Assembling, Self::Cutting, Self::Tracing];

    /// The stage of the flow chart that it belongs to. Tracing passes through all from RAY to SHADE.
    pub const fn stage(self) -> Stage {
        match self {
            Self::Reading | Self::Assembling => Stage::Objects,
            Self::Cutting => Stage::Lattice,
            Self::Tracing => Stage::Ray,
        }
    }

    /// What is done.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reading => "reading",
            Self::Assembling => "assembling",
            Self::Cutting => "building",
            Self::Tracing => "tracing",
        }
    }
}

/// How far the work of a thread, or of several, is. Clones share it. Written once an object or a tile, not
/// once a ray.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<State>);

#[derive(Debug, Default)]
struct State {
    task: AtomicU8,
    done: AtomicU64,
    total: AtomicU64,
}

/// How far a task was at some time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkStep {
    /// What is at work.
    pub task: Task,
    /// What of it is done, in 0 to 100 of a hundred; absent where it is not known how much there is.
    pub percent: Option<u8>,
}

impl Progress {
    /// Begins a task of `total` parts, 0 where it is not known how many there are.
    pub fn begin(&self, task: Task, total: u64) {
        // A reader between these sees a step of neither task; it is right the next time.
        self.0.done.store(0, Ordering::Relaxed);
        self.0.total.store(total, Ordering::Relaxed);
        self.0.task.store(task as u8, Ordering::Relaxed);
    }

    /// Some parts more are done.
    pub fn advance(&self, parts: u64) {
        self.0.done.fetch_add(parts, Ordering::Relaxed);
    }

    /// So many parts are done, in all.
    pub fn reach(&self, parts: u64) {
        self.0.done.store(parts, Ordering::Relaxed);
    }

    /// How far it is now.
    pub fn now(&self) -> WorkStep {
        let [done, total] = [&self.0.done, &self.0.total].map(|count| count.load(Ordering::Relaxed));
        let task = Task::ALL.get(usize::from(self.0.task.load(Ordering::Relaxed)));
        WorkStep {
            task: task.copied().unwrap_or(Task::Reading),
            // In 128 bits no number of parts overflows.
            percent: (total > 0).then(|| (u128::from(done.min(total)) * 100 / u128::from(total)) as u8),
        }
    }
}

/// Two are equal where they are one: what is watched is no part of what is asked for.
impl PartialEq for Progress {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Progress {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_goes_from_nothing_to_all() {
        let progress = Progress::default();
        assert_eq!(progress.now(), WorkStep { task: Task::Reading, percent: None });
        progress.begin(Task::Cutting, 3);
        let steps = [1, 1, 1, 1].map(|parts| {
            progress.clone().advance(parts);
            progress.now().percent
        });
        assert_eq!(steps, [33, 66, 100, 100].map(Some));
        progress.begin(Task::Tracing, u64::MAX);
        progress.reach(u64::MAX / 2);
        assert_eq!(progress.now(), WorkStep { task: Task::Tracing, percent: Some(49) });
    }

    #[test]
    fn tasks_are_numbered_in_their_order() {
        for (number, task) in Task::ALL.into_iter().enumerate() {
            assert_eq!(task as usize, number);
        }
        assert!(Task::ALL.windows(2).all(|pair| pair[0].stage() <= pair[1].stage()));
    }
}
