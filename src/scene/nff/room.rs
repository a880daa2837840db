//! How much memory a scene will take, counted before it is read: stretches are read by many threads, which
//! have no count in common.

use crate::scene::memory::{ASSEMBLED, ASSEMBLED_FACES, ASSEMBLED_TRIANGLE, too_little};
use crate::scene::{Diagnostic, Object};

/// Bytes that any shape takes.
const SHAPE: u64 = size_of::<Object>() as u64 + ASSEMBLED;

/// Bytes that a text takes at most for each of its own: the shortest sphere, `s 0 0 0 1` and a blank, has
/// ten.
const MOST: u64 = 1 + SHAPE / 10;

/// The error of a text whose scene takes more than `limit` bytes, where it does.
pub fn check(text: &str, limit: u64) -> Result<(), Diagnostic> {
    if (text.len() as u64).saturating_mul(MOST) <= limit {
        return Ok(());
    }
    let needed = needed(text);
    if needed > limit { Err(too_little(limit, needed)) } else { Ok(()) }
}

/// Bytes that reading and showing a text takes. A texture's name that is an entity's word counts as that.
fn needed(text: &str) -> u64 {
    let mut words = text.split_ascii_whitespace();
    let mut bytes = text.len() as u64;
    while let Some(word) = words.next() {
        bytes += match word {
            "s" | "c" => SHAPE,
            "p" | "pp" => {
                // What no text has room for is an error of its own.
                let corners = words.next().and_then(|count| count.parse::<u32>().ok()).unwrap_or(0);
                let corners = u64::from(corners).min(text.len() as u64);
                SHAPE + ASSEMBLED_FACES + ASSEMBLED_TRIANGLE * corners.saturating_sub(2)
            }
            _ => 0,
        };
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 20 MiB of spheres took 646 MB where 30 MiB were allowed.
    #[test]
    fn shapes_are_counted_before_they_are_read() {
        let text = "s 1 2 3 1\n".repeat(1000);
        let whole = 1000 * (SHAPE + 10);
        assert_eq!(needed(&text), whole);
        assert!(check(&text, whole).is_ok());
        assert!(check(&text, whole - 1).is_err());
        assert!(needed(&text) <= text.len() as u64 * MOST);
        let polygon = "p 4 0 0 0 1 0 0 1 1 0 0 1 0\n";
        assert_eq!(needed(polygon), polygon.len() as u64 + SHAPE + ASSEMBLED_FACES + 2 * ASSEMBLED_TRIANGLE);
    }
}
