//! Reading what may have no end.

use std::io::{self, Read};

/// Bytes that are asked for first.
const FIRST: u64 = 64 << 10;

/// Reads to the end, or `most` bytes. No more memory is taken than for those, and twice of what is there.
pub fn read_at_most(from: impl Read, most: u64, into: &mut Vec<u8>) -> io::Result<()> {
    let mut from = from.take(most);
    loop {
        let length = into.len() as u64;
        let room = length.max(FIRST).min(most.saturating_sub(length));
        if room == 0 {
            return Ok(());
        }
        into.try_reserve_exact(room as usize).map_err(io::Error::other)?;
        if from.by_ref().take(room).read_to_end(into)? < room as usize {
            return Ok(());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_ends_where_it_must() {
        for (there, most) in [(0, 10), (10, 10), (11, 10), (300_000, 1 << 20), (1 << 20, 300_000)] {
            let mut bytes = Vec::new();
            read_at_most(io::repeat(7).take(there), most, &mut bytes).unwrap();
            assert_eq!(bytes.len() as u64, there.min(most));
            assert!(bytes.capacity() as u64 <= most.max(FIRST));
        }
    }
}
