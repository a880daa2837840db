//! How many cases a property draws.

use proptest::prelude::*;

/// So many cases, and a hundred times as many where `RAY13_LONG` is set. Each case that is found wanting
/// becomes a test of its own with a name, so that none is kept beside the code.
pub fn cases(bounded: u32) -> ProptestConfig {
    let times = if std::env::var_os("RAY13_LONG").is_some() { 100 } else { 1 };
    ProptestConfig { cases: bounded * times, failure_persistence: None, ..ProptestConfig::default() }
}
