//! What a compiled terminfo entry says of a terminal: term(5), "STORAGE FORMAT".

/// As much of an entry as decides what is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Description {
    /// Whether the cursor is sent to a place as ECMA-48 has it, the only way that is used here.
    pub cursor: bool,
    /// The number of colours; 0 where there are none, or they are not set as ECMA-48 has it.
    pub colors: u32,
    /// Whether there is a second screen, entered by the private mode 1049.
    pub alternate_screen: bool,
}

/// The first bytes of an entry with numbers of 16 bits, and of one with numbers of 32.
const MAGIC: [(u16, usize); 2] = [(0o432, 2), (0o1036, 4)];

/// Bytes of the header: the magic number, then the sizes of names, booleans, numbers, strings and of their
/// table.
const HEADER: usize = 12;

/// The places of capabilities in their lists, in the order of term.h.
const GENERIC_TYPE: usize = 6;
const MAX_COLORS: usize = 13;
const CURSOR_ADDRESS: usize = 10;
const ENTER_CA_MODE: usize = 28;
const SET_A_FOREGROUND: usize = 359;

impl Description {
    /// Reads a compiled entry; nothing where it is none.
    pub fn read(entry: &[u8]) -> Option<Self> {
        let half = |place: usize| Some(u16::from_le_bytes([*entry.get(place)?, *entry.get(place + 1)?]));
        let magic = half(0)?;
        let (_, width) = *MAGIC.iter().find(|(number, _)| *number == magic)?;
        let size = |place: usize| half(2 * place).map(usize::from);
        let (names, booleans, numbers, strings) = (size(1)?, size(2)?, size(3)?, size(4)?);
        let booleans_at = HEADER + names;
        // Numbers begin at an even place.
        let numbers_at = (booleans_at + booleans).next_multiple_of(2);
        let strings_at = numbers_at + numbers * width;
        let table_at = strings_at + 2 * strings;

        let is = |n: usize| n < booleans && entry.get(booleans_at + n) == Some(&1);
        let number = |n: usize| {
            let place = numbers_at + n * width;
            let bytes = entry.get(place..place + width).filter(|_| n < numbers)?;
            // All bits set, and one less, stand for a number that is not there.
            let value = match *bytes {
                [a, b] => i32::from(i16::from_le_bytes([a, b])),
                [a, b, c, d] => i32::from_le_bytes([a, b, c, d]),
                _ => -1,
            };
            u32::try_from(value).ok()
        };
        let string = |n: usize| {
            let offset = half(strings_at + 2 * n).filter(|&offset| n < strings && offset < 0xFFFE)?;
            entry.get(table_at + usize::from(offset)..)?.split(|&byte| byte == 0).next()
        };
        let begins = |n: usize, with: &[u8]| string(n).is_some_and(|found| found.starts_with(with));
        let colored = begins(SET_A_FOREGROUND, b"\x1b[");
        Some(Self {
            cursor: !is(GENERIC_TYPE) && begins(CURSOR_ADDRESS, b"\x1b[%i%p1%d;%p2%dH"),
            colors: if colored { number(MAX_COLORS).unwrap_or(0) } else { 0 },
            alternate_screen: begins(ENTER_CA_MODE, b"\x1b[?1049h"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// An entry as tic writes it, with a few capabilities.
    fn entry(magic: u16, colors: &[u8], generic: u8, cursor: &[u8]) -> Vec<u8> {
        let names = b"strange|a test\0";
        let booleans = [0, 0, 0, 0, 0, 0, generic];
        let mut numbers = vec![0xFF; colors.len() * MAX_COLORS];
        numbers.extend(colors);
        let mut table = Vec::new();
        let mut strings = vec![0xFF; 2 * (SET_A_FOREGROUND + 1)];
        let all: [(usize, &[u8]); 3] = [
            (CURSOR_ADDRESS, cursor),
            (ENTER_CA_MODE, b"\x1b[?1049h\x1b[22;0;0t"),
            (SET_A_FOREGROUND, b"\x1b[3%p1%dm"),
        ];
        for (place, text) in all {
            strings[2 * place..2 * place + 2].copy_from_slice(&(table.len() as u16).to_le_bytes());
            table.extend(text);
            table.push(0);
        }
        let sizes = [names.len(), booleans.len(), MAX_COLORS + 1, SET_A_FOREGROUND + 1, table.len()];
        let mut entry = magic.to_le_bytes().to_vec();
        entry.extend(sizes.iter().flat_map(|&size| (size as u16).to_le_bytes()));
        entry.extend(names);
        entry.extend(booleans);
        if !entry.len().is_multiple_of(2) {
            entry.push(0);
        }
        entry.extend(numbers);
        entry.extend(strings);
        entry.extend(table);
        entry
    }

    const ANSI: &[u8] = b"\x1b[%i%p1%d;%p2%dH$<5>";

    #[test]
    fn both_widths_of_numbers_are_read() {
        for (magic, colors) in [(0o432, &[8, 0][..]), (0o1036, &[8, 0, 0, 0])] {
            let expected = Description { cursor: true, colors: 8, alternate_screen: true };
            assert_eq!(Description::read(&entry(magic, colors, 0, ANSI)), Some(expected));
        }
        let many = entry(0o1036, &[0, 0, 0, 1], 0, ANSI);
        assert_eq!(Description::read(&many).map(|found| found.colors), Some(1 << 24));
        let none = entry(0o432, &[0xFF, 0xFF], 0, ANSI);
        assert_eq!(Description::read(&none).map(|found| found.colors), Some(0));
    }

    #[test]
    fn a_generic_type_or_another_way_to_a_place_is_no_cursor() {
        let cursor =
            |generic, cursor| Description::read(&entry(0o432, &[8, 0], generic, cursor)).map(|d| d.cursor);
        assert_eq!(cursor(0, ANSI), Some(true));
        assert_eq!(cursor(1, ANSI), Some(false));
        assert_eq!(cursor(0, b"\x1bY%p1%' '%+%c%p2%' '%+%c"), Some(false), "a VT52");
    }

    #[test]
    fn what_is_cut_short_says_no_more_than_it_holds() {
        let whole = entry(0o432, &[8, 0], 0, ANSI);
        for length in 0..whole.len() {
            let _ = Description::read(&whole[..length]);
        }
        assert_eq!(Description::read(b""), None);
        assert_eq!(Description::read(b"#!/bin/sh\n"), None);
    }

    proptest! {
        #[test]
        fn any_bytes_at_all_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..64), long in any::<bool>()) {
            let mut entry = MAGIC[usize::from(long)].0.to_le_bytes().to_vec();
            entry.extend(bytes);
            let _ = Description::read(&entry);
        }
    }
}
