//! Memory of workers between two pictures: to ask the system for it anew, page by page, takes a twentieth of
//! a small one.

use std::any::Any;
use std::sync::{Mutex, PoisonError};

/// What workers have given back, of any type.
#[derive(Debug, Default)]
pub(super) struct ScratchPool(Mutex<Vec<Box<dyn Any + Send>>>);

impl ScratchPool {
    /// Memory of this type that was given back, or new.
    pub fn take<T: Any + Send + Default>(&self) -> T {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let found = all.iter().position(|one| one.is::<T>()).map(|place| all.swap_remove(place));
        found.and_then(|one| one.downcast().ok()).map(|one| *one).unwrap_or_default()
    }

    /// Takes memory back.
    pub fn give_back<T: Any + Send>(&self, one: T) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(Box::new(one));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_given_back_is_taken_again_by_its_type() {
        let spare = ScratchPool::default();
        spare.give_back(vec![7_u8]);
        assert!(spare.take::<Vec<u16>>().is_empty());
        assert_eq!(spare.take::<Vec<u8>>(), vec![7_u8]);
        assert!(spare.take::<Vec<u8>>().is_empty());
    }
}
