//! How much may be worked out for a scene: one measure for all of its words, so that many, or nested ones,
//! take no longer than one that is large.

/// So many steps a scene may take: hulls, sums, shadows, and what is carved, of a thousand parts as people
/// make them. All of them take five seconds or so.
const OF_SCENE: u64 = 6_000_000;

/// The steps that are left. A step is about what a sum of two corners takes on its way into a hull: a
/// microsecond, or less.
#[derive(Clone, Debug)]
pub struct WorkLeft {
    steps: u64,
}

/// There are not as many steps left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooMuchWork;

impl Default for WorkLeft {
    fn default() -> Self {
        Self { steps: OF_SCENE }
    }
}

impl WorkLeft {
    /// Takes steps, where there are as many.
    pub fn spend(&mut self, steps: usize) -> Result<(), TooMuchWork> {
        self.steps = self.steps.checked_sub(steps as u64).ok_or(TooMuchWork)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_refused_takes_nothing() {
        let mut work = WorkLeft { steps: 5 };
        assert_eq!(work.spend(3), Ok(()));
        assert_eq!(work.spend(3), Err(TooMuchWork));
        assert_eq!(work.spend(2), Ok(()));
        assert_eq!(work.spend(usize::MAX), Err(TooMuchWork));
    }
}
