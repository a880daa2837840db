//! Tests of the decoder: sequences whole and in pieces, at any time.

use proptest::prelude::*;

use super::*;
use crate::app::input::{Answer, Colored};

/// What comes out of pieces that come at times in milliseconds, each key as crossterm writes it; at the end
/// everything is waited for.
fn out(pieces: &[(&str, u64)]) -> Vec<String> {
    let bytes: Vec<_> = pieces.iter().map(|&(text, at)| (text.as_bytes(), at)).collect();
    out_of_bytes(&bytes)
}

fn out_of_bytes(pieces: &[(&[u8], u64)]) -> Vec<String> {
    let begin = Instant::now();
    let mut decoder = Decoder::default();
    let mut inputs = Vec::new();
    for &(bytes, at) in pieces {
        let now = begin + Duration::from_millis(at);
        // The thread that reads wakes when patience ends.
        while let Some(end) = decoder.patience_ends().filter(|&end| end <= now) {
            inputs.extend(decoder.wait_no_longer(end));
        }
        inputs.extend(decoder.take(bytes, now));
    }
    while let Some(end) = decoder.patience_ends() {
        inputs.extend(decoder.wait_no_longer(end));
    }
    inputs.iter().map(name).collect()
}

fn name(input: &Input) -> String {
    match input {
        Input::Key(key) => {
            let held: String =
                [(KeyModifiers::CONTROL, "C-"), (KeyModifiers::ALT, "A-"), (KeyModifiers::SHIFT, "S-")]
                    .into_iter()
                    .filter(|&(modifier, _)| key.modifiers.contains(modifier))
                    .map(|(_, name)| name)
                    .collect();
            format!("{held}{}", key.code)
        }
        Input::Answer(Answer::Status) => "status".to_owned(),
        Input::Answer(answer) => format!("{answer:?}"),
        Input::Mouse(_) => "mouse".to_owned(),
        input => panic!("no decoder says {input:?}"),
    }
}

#[test]
fn whole_sequences_are_keys() {
    for (bytes, keys) in [
        ("q", "q"),
        ("é", "é"),
        ("\x1b[C", "Right"),
        ("\x1bOC", "Right"),
        ("\x1b[1;2C", "S-Right"),
        ("\x1b[[A", "F1"),
        ("\x1b[21~", "F10"),
        ("\x1b[7$", "S-Home"),
        ("\x1b[Z", "S-Back Tab"),
        ("\x1bOk", "+"),
        ("\x1bq", "A-q"),
        ("\x1b ", "A-Space"),
        ("\x1bü", "A-ü"),
        ("\x1b\x7f", "A-Backspace"),
        ("\x1b\x03", "C-A-c"),
        ("\x1b\x1b[A", "Esc Up"),
        ("\x1b[0n", "status"),
        ("\x1b[<0;10;10M", "mouse"),
        ("\x1b[C\x1b[Cl", "Right Right l"),
    ] {
        let expected: Vec<_> = if bytes == "\x1b[Z" { vec![keys] } else { keys.split(' ').collect() };
        assert_eq!(out(&[(bytes, 0)]), expected, "{bytes:?}");
        // After each, a key is a key: nothing hangs over.
        let more = format!("{bytes}x");
        assert_eq!(out(&[(&more, 0)]).last().unwrap(), "x", "{bytes:?}");
    }
}

/// `ESC`, then `[C` some time later, quit and left `[C` to the shell.
#[test]
fn a_split_arrow_is_an_arrow_and_never_characters() {
    for rest in ["[C", "OC", "[1;2C"] {
        for later in [0, 10, 49, 60, 500, 900] {
            let keys = out(&[("\x1b", 0), (rest, later)]);
            assert!(keys.last().unwrap().ends_with("Right"), "{later} ms: {keys:?}");
            let escapes = usize::from(later >= 50);
            assert_eq!(keys.len(), 1 + escapes, "{later} ms: {keys:?}");
        }
    }
    assert_eq!(out(&[("\x1b", 0), ("[", 30), ("C", 800)]), ["Right"]);
    assert_eq!(out(&[("\x1b", 0), ("[", 300), ("C", 330)]), ["Esc", "Right"]);
    assert_eq!(out(&[("\x1b[", 0), ("C", 900)]), ["Right"]);
    assert_eq!(out(&[("\x1b[1", 0), (";2", 2_000), ("C", 6_000)]), ["S-Right"]);
}

#[test]
fn a_lone_escape_is_believed_and_what_is_typed_later_is_typed() {
    assert_eq!(out(&[("\x1b", 0)]), ["Esc"]);
    assert_eq!(out(&[("\x1b", 0), ("[", 300)]), ["Esc", "["]);
    assert_eq!(out(&[("\x1b", 0), ("]", 300), ("]", 333), ("]", 366)]), ["Esc", "]", "]", "]"]);
    assert_eq!(out(&[("\x1b", 0), ("[", 300), ("[", 333), ("[", 366)]), ["Esc", "[", "[", "["]);
    assert_eq!(out(&[("\x1b", 0), ("[", 300), ("q", 600)]), ["Esc", "[", "q"]);
    assert_eq!(out(&[("\x1b", 0), ("[C", 1_200)]), ["Esc", "[", "S-C"], "too late for an arrow");
    assert_eq!(out(&[("\x1b", 0), ("q", 20)]), ["A-q"]);
    assert_eq!(out(&[("\x1b", 0), ("q", 70)]), ["Esc", "q"]);
    assert_eq!(out(&[("\x1b", 0), ("\x1b", 10)]), ["Esc", "Esc"]);
}

#[test]
fn what_is_foreign_is_swallowed_whole() {
    for foreign in [
        "\x1b]52;c;cXFxcQ==\x07",
        "\x1b]11;?\x1b\\",
        "\x1bP1$r0m\x1b\\",
        "\x1bP>|XTerm(388)\x1b\\",
        "\x1b_Gi=31;OK\x1b\\",
        "\x1b^private\x1b\\",
        "\x1bXq\x1b\\",
        "\x1b[?62;22c",
        "\x1b[?2026;2$y",
        "\x1b[4;1$y",
        "\x1b[12;40R",
        "\x1b[<0;10;10m",
        "\x1b[Mqqq",
        "\x1b[?1u",
        "\x1b\\",
    ] {
        assert_eq!(out(&[(foreign, 0)]), [""; 0], "{foreign:?}");
        for at in 1..foreign.len() {
            let (head, rest) = foreign.split_at(at);
            for later in [0, 40, 500, 900] {
                let keys = out(&[(head, 0), (rest, later), ("x", later + 2_000)]);
                // An ESC alone is believed; what belongs to it is swallowed all the same, except that a lone
                // backslash cannot be told from the key.
                let escape = ["Esc".to_owned()];
                let keys = if head == "\x1b" { keys.strip_prefix(&escape).unwrap_or(&keys) } else { &keys };
                let keys =
                    if rest == "\\" { keys.strip_prefix(&["\\".to_owned()]).unwrap_or(keys) } else { keys };
                assert_eq!(keys, ["x"], "{head:?}, {later} ms later {rest:?}");
            }
        }
    }
    assert_eq!(out(&[("\x1b[I\x1b[O", 0)]), [""; 0]);
    let long = format!("\x1b]52;c;{}\x07x", "q".repeat(100_000));
    assert_eq!(out(&[(&long, 0)]), ["x"]);
}

#[test]
fn colours_are_answers_with_either_end() {
    let color = format!("{:?}", Answer::Color { of: Colored::Index(7), rgb: [0xe5e5; 3] });
    for end in ["\x07", "\x1b\\"] {
        let text = format!("\x1b]4;7;rgb:e5e5/e5e5/e5e5{end}\x1b[0n");
        for at in 0..text.len() {
            let (head, rest) = text.split_at(at);
            for later in [0, 40, 900] {
                let inputs = out(&[(head, 0), (rest, later)]);
                let inputs: Vec<_> = inputs.into_iter().filter(|input| input != "Esc").collect();
                assert_eq!(inputs, [color.as_str(), "status"], "{head:?}, {later} ms later {rest:?}");
            }
        }
    }
}

#[test]
fn control_c_counts_in_whatever_was_begun() {
    for begun in ["\x1b", "\x1b[", "\x1b[1", "\x1b]", "\x1b]4;", "\x1bP", "\x1bO", "\x1b[["] {
        assert!(
            out(&[(begun, 0), ("\x03", 10)]).last().unwrap().ends_with("C-c")
                || out(&[(begun, 0), ("\x03", 10)]).last().unwrap() == "C-A-c",
            "{begun:?}"
        );
    }
}

#[test]
fn what_was_begun_with_alt_is_given_up() {
    for begun in ["\x1b[", "\x1b]", "\x1bO", "\x1bP"] {
        assert_eq!(out(&[(begun, 0), ("x", 1_100)]), ["x"], "{begun:?}");
    }
}

#[test]
fn bytes_that_are_no_text_are_no_keys() {
    assert_eq!(
        out_of_bytes(&[(b"\xffa\xc3", 0), (b"b", 10), (b"\xc3", 20), (b"\xa9", 3_000)]),
        ["a", "b", "é"]
    );
    assert_eq!(out_of_bytes(&[(b"\x1b[\xc3\xa9x", 0)]), ["é", "x"]);
    assert_eq!(out_of_bytes(&[(b"\xe2\x82\x1b[C", 0)]), ["Right"]);
}

proptest! {
    /// However bytes are cut, soon after each other they mean the same.
    #[test]
    fn pieces_mean_what_the_whole_means(
        parts in prop::collection::vec(prop::sample::select(vec![
            "q", "é", "\x1b[C", "\x1bOA", "\x1b[1;5D", "\x1b[[B", "\x1b[0n", "\x1b]11;rgb:0/0/0\x07",
            "\x1b]4;1;rgb:ff/ff/ff\x1b\\", "\x1b_x\x1b\\", "\x1bx", "\x03", "\x1b[Mabc", "\x1b[?1;2c",
        ]), 1..8),
        cuts in prop::collection::vec(any::<prop::sample::Index>(), 0..8),
    ) {
        let bytes = parts.concat().into_bytes();
        let mut places: Vec<_> = cuts.iter().map(|cut| cut.index(bytes.len())).chain([0, bytes.len()]).collect();
        places.sort_unstable();
        let pieces: Vec<_> = places
            .windows(2)
            .zip(0..)
            .map(|(ends, at)| (&bytes[ends[0]..ends[1]], at * 5))
            .collect();
        prop_assert_eq!(out_of_bytes(&pieces), out_of_bytes(&[(&bytes, 0)]));
    }

    #[test]
    fn no_bytes_are_too_odd(
        pieces in prop::collection::vec((prop::collection::vec(any::<u8>(), 0..40), 0_u64..3_000), 0..8),
    ) {
        let mut at = 0;
        let pieces: Vec<_> = pieces.iter().map(|(bytes, later)| { at += later; (bytes.as_slice(), at) }).collect();
        out_of_bytes(&pieces);
    }
}
