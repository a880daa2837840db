//! Answers of a terminal to what a program may ask of it.

/// What a terminal says of itself when it is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It has come as far as a status request (`ESC[5n`): everything sent before that is on its screen.
    Status,
    /// A colour that it shows (OSC 4, 10 and 11).
    Color {
        /// Which one.
        of: Colored,
        /// Red, green and blue, 0 to 65 535, as X11 has them.
        rgb: [u16; 3],
    },
    /// Its secondary device attributes (`ESC[>c`).
    Identity {
        /// The kind of terminal, a number that it has chosen.
        kind: u32,
        /// Its version, in a form of its own.
        version: u32,
    },
}

/// What a colour is that of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colored {
    /// A number of the palette of 256.
    Index(u8),
    /// Text in the terminal's own colour.
    Foreground,
    /// What is behind it.
    Background,
}

/// The answer in a control sequence, given without its `ESC [`: private marks and parameters, and the final
/// byte.
pub fn in_sequence(parameters: &str, last: u8) -> Option<Answer> {
    match (parameters, last) {
        // 0 is "ready", 3 is "malfunction": either way it has come this far.
        ("0" | "3", b'n') => Some(Answer::Status),
        (_, b'c') => {
            let mut numbers = parameters.strip_prefix('>')?.split(';').map(|number| number.parse().ok());
            Some(Answer::Identity { kind: numbers.next()??, version: numbers.next().flatten().unwrap_or(0) })
        }
        _ => None,
    }
}

/// The answers in an operating system command, given without its `ESC ]` and its end.
pub fn in_command(text: &str) -> Vec<Answer> {
    let mut fields = text.split(';');
    match fields.next() {
        // Some terminals put the answers to several questions into one.
        Some("4") => {
            let mut answers = Vec::new();
            while let (Some(index), Some(rgb)) = (fields.next(), fields.next()) {
                if let (Ok(index), Some(rgb)) = (index.parse(), color(rgb)) {
                    answers.push(Answer::Color { of: Colored::Index(index), rgb });
                }
            }
            answers
        }
        Some(command @ ("10" | "11")) => {
            let of = if command == "10" { Colored::Foreground } else { Colored::Background };
            fields.next().and_then(color).map(|rgb| Answer::Color { of, rgb }).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

/// A colour as X11 writes it: `rgb:` and three numbers of one to four hexadecimal digits, of which the
/// highest is full light; `rgba:` has a fourth for opacity.
fn color(text: &str) -> Option<[u16; 3]> {
    let numbers = text.strip_prefix("rgb:").or_else(|| text.strip_prefix("rgba:"))?;
    let mut channels = numbers.split('/').map(channel);
    let rgb = [channels.next()??, channels.next()??, channels.next()??];
    (channels.count() <= 1).then_some(rgb)
}

fn channel(digits: &str) -> Option<u16> {
    if !matches!(digits.len(), 1..=4) || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let full = (1_u32 << (4 * digits.len())) - 1;
    let value = u32::from_str_radix(digits, 16).ok()?;
    u16::try_from(value * 0xffff / full).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_an_answer_in_either_case() {
        assert_eq!(in_sequence("0", b'n'), Some(Answer::Status));
        assert_eq!(in_sequence("3", b'n'), Some(Answer::Status));
        assert_eq!(in_sequence("5", b'n'), None);
        assert_eq!(in_sequence("?0", b'n'), None);
    }

    #[test]
    fn terminals_tell_who_they_are() {
        let kinds = |text| in_sequence(text, b'c');
        assert_eq!(kinds(">1;10;0"), Some(Answer::Identity { kind: 1, version: 10 }), "mosh");
        assert_eq!(kinds(">84;0;0"), Some(Answer::Identity { kind: 84, version: 0 }), "tmux");
        assert_eq!(kinds(">83;40900;0"), Some(Answer::Identity { kind: 83, version: 40900 }), "screen");
        assert_eq!(kinds(">41"), Some(Answer::Identity { kind: 41, version: 0 }));
        assert_eq!(kinds("?62;c"), None, "primary attributes");
        assert_eq!(kinds(">"), None);
    }

    #[test]
    fn colours_come_in_one_to_four_digits() {
        let gray = |rgb| vec![Answer::Color { of: Colored::Index(7), rgb: [rgb; 3] }];
        assert_eq!(in_command("4;7;rgb:e5e5/e5e5/e5e5"), gray(0xe5e5));
        assert_eq!(in_command("4;7;rgb:e5/e5/e5"), gray(0xe5e5));
        assert_eq!(in_command("4;7;rgb:f/f/f"), gray(0xffff));
        assert_eq!(in_command("4;7;rgb:fff/fff/fff"), gray(0xffff));
        assert_eq!(in_command("4;7;rgba:0000/0000/0000/ffff"), gray(0));
        let background = Answer::Color { of: Colored::Background, rgb: [0, 0x2b2b, 0x3636] };
        assert_eq!(in_command("11;rgb:0000/2b2b/3636"), [background]);
        assert_eq!(in_command("4;0;rgb:0/0/0;7;rgb:f/f/f").len(), 2);
    }

    #[test]
    fn what_is_no_colour_is_no_answer() {
        for text in [
            "",
            "4",
            "4;7",
            "4;7;?",
            "4;256;rgb:0/0/0",
            "4;7;rgb:0/0",
            "4;7;rgb:0/0/0/0/0",
            "4;7;rgb://",
            "4;7;rgb:12345/0/0",
            "4;7;rgb:+1/0/0",
            "52;c;rgb:0/0/0",
            "11",
            "10;#000000",
        ] {
            assert_eq!(in_command(text), [], "{text}");
        }
    }
}
