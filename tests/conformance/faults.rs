//! What an engine got wrong, told at the end of a test.

/// Panics with the first faults, a line each, of so many answers, if there are any.
#[track_caller]
pub fn assert_none(faults: &[String], answers: usize) {
    let first = &faults[..faults.len().min(4)];
    assert!(faults.is_empty(), "{} of {answers}:\n{}", faults.len(), first.join("\n"));
}
