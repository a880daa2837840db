//! ANSI art as DOS had it.

use std::num::NonZeroU16;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::str;

/// The characters of code page 437 that pictures are made of, beside ASCII.
const CP437: [(u8, char); 8] =
    [(0xB0, '░'), (0xB1, '▒'), (0xB2, '▓'), (0xDB, '█'), (0xDC, '▄'), (0xDD, '▌'), (0xDE, '▐'), (0xDF, '▀')];

fn render(arguments: &[&str]) -> Output {
    let mut ray13 = Command::new(env!("CARGO_BIN_EXE_ray13"));
    ray13.arg("render").args(arguments).env_remove("NO_COLOR").env("TERM", "xterm-256color");
    ray13.stdin(Stdio::null()).output().unwrap()
}

/// What the quarters of a cell show: how much of which colour.
type Quarters = [Vec<(u8, u8)>; 4];

/// A cell whichever of the equal characters it is, with the number of a bright colour where bold makes it
/// one.
fn quarters(cell: &vt100::Cell) -> Quarters {
    let number = |color, own| match color {
        vt100::Color::Idx(number) => number,
        vt100::Color::Default => own,
        vt100::Color::Rgb(..) => panic!("a colour that a PC has not"),
    };
    let ink = number(cell.fgcolor(), 7) + if cell.bold() && number(cell.fgcolor(), 7) < 8 { 8 } else { 0 };
    let paper = number(cell.bgcolor(), 0);
    let of_ink = match cell.contents() {
        "░" => [1; 4],
        "▒" => [2; 4],
        "▓" => [3; 4],
        "█" => [4; 4],
        "▀" => [4, 4, 0, 0],
        "▄" => [0, 0, 4, 4],
        "▌" => [4, 0, 4, 0],
        "▐" => [0, 4, 0, 4],
        _ => [0; 4],
    };
    of_ink.map(|share| {
        let mut both = vec![(ink, share), (paper, 4 - share)];
        both.retain(|&(_, share)| share > 0);
        both.sort_unstable();
        both
    })
}

/// What a screen of 80 columns shows of a text.
fn screen(text: &str, rows: u16) -> Vec<Quarters> {
    let mut parser = vt100::Parser::new(NonZeroU16::new(rows).unwrap(), NonZeroU16::new(80).unwrap(), 0);
    parser.process(text.replace('\n', "\r\n").as_bytes());
    let places = (0..rows).flat_map(|y| (0..80).map(move |x| (y, x)));
    places.map(|(y, x)| quarters(parser.screen().cell(y, x).unwrap())).collect()
}

#[test]
fn a_dos_viewer_shows_the_picture_and_knows_its_size() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("die-dos.ans");
    let name = file.to_str().unwrap();
    let done = render(&["die", "--format", "ans-dos", "-o", name]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let bytes = std::fs::read(&file).unwrap();
    let (text, record) = bytes.split_at(bytes.len() - 128);
    assert_eq!(&record[..7], b"SAUCE00");
    assert_eq!([record[96], record[97], record[98], record[99]], [80, 0, 25, 0]);
    let (end, text) = text.split_last().unwrap();
    assert_eq!(*end, 0x1A);
    assert!(!text.contains(end));
    let letter = |&byte: &u8| match CP437.iter().find(|(own, _)| *own == byte) {
        Some(&(_, letter)) => letter,
        None => char::from(byte),
    };
    let shown = screen(&text.iter().map(letter).collect::<String>().replace("\r\n", "\n"), 26);
    let as_ansi =
        render(&["die", "--format", "ans", "--glyphs", "cp437", "--palette", "dos16", "--cells", "80x25"]);
    assert!(shown == screen(str::from_utf8(&as_ansi.stdout).unwrap(), 26), "the same picture");
    assert!(shown.iter().flatten().filter(|quarter| quarter[..] != [(0, 4)]).count() > 4000);
    // No date and no name: the same picture is the same bytes.
    assert_eq!(render(&["die", "--format", "ans-dos"]).stdout, bytes);
}

#[test]
fn parts_join_to_the_same_file_under_its_usual_ending() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [part, joined] = ["dos.part", "dos-joined.ans"].map(|name| folder.join(name));
    let [part, joined] = [&part, &joined].map(|path| path.to_str().unwrap());
    let done = render(&["die", "--format", "ans-dos", "--part", "1/1", "-o", part]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let done = Command::new(env!("CARGO_BIN_EXE_ray13")).args(["join", part, "-o", joined]).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let whole = render(&["die", "--format", "ans-dos", "--glyphs", "auto"]).stdout;
    assert!(std::fs::read(joined).unwrap() == whole && !whole.is_empty());
}

#[test]
fn what_a_dos_screen_has_not_is_refused() {
    for (arguments, why) in [(["--glyphs", "braille"], "characters"), (["--palette", "gray"], "colours")] {
        let refused = render(&[&["die", "--format", "ans-dos"], &arguments[..]].concat());
        assert_eq!(refused.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&refused.stderr).contains(why));
        assert!(refused.stdout.is_empty());
    }
}
