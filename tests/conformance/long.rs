//! How many cases: few in a usual run, many where `RAY13_LONG` is set, which prints figures too.

pub fn is_long() -> bool {
    std::env::var_os("RAY13_LONG").is_some()
}

/// So many cases, or `times` as many.
pub fn cases(usual: usize, times: usize) -> usize {
    if is_long() { usual * times } else { usual }
}

/// A line of figures of a long run.
pub fn report(line: impl FnOnce() -> String) {
    if is_long() {
        println!("{}", line());
    }
}

/// A word for a row that an engine does not claim.
pub fn skipped(what: &str) {
    println!("skipped, outside the engine's range: {what}");
}
