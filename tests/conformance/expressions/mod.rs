//! Expressions of many solids: against the oracle, and against others that mean the same.

pub mod laws;
pub mod random;
