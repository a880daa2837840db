//! How a box lies to a solid: what an expression is pruned by.

/// How a box lies to a primitive, or to what an expression is true of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Classification {
    /// The whole box is certainly inside.
    Inside,
    /// The whole box is certainly outside.
    Outside,
    /// Neither is certain.
    Mixed,
}

impl Classification {
    /// Outside where the box misses the solid, inside where the solid covers it, which is asked only then.
    #[inline(always)]
    pub(super) fn of(misses: bool, covers: impl FnOnce() -> bool) -> Self {
        if misses {
            Self::Outside
        } else if covers() {
            Self::Inside
        } else {
            Self::Mixed
        }
    }

    /// Whether the box is inside, where that is certain.
    #[inline(always)]
    pub(super) fn value(self) -> Option<bool> {
        match self {
            Self::Inside => Some(true),
            Self::Outside => Some(false),
            Self::Mixed => None,
        }
    }
}
