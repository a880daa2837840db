//! What is sent to a terminal, read back by one: the cells that were meant, in stills and frame by frame.

use std::fs;
use std::num::NonZeroU16;
use std::path::Path;
use std::process::{Command, Output};

use proptest::prelude::*;
use ray13::glyph::{Cell, FourGrays, Paint, Palette};
use ray13::math::{Grid, Size};
use ray13::output::{Encoder, ansi};

use crate::support::seen::Seen;

/// What a terminal should show of a cell.
fn meant(cell: Cell) -> Seen {
    Seen::new(cell.glyph, color(cell.ink), color(cell.paper))
}

fn color(paint: Paint) -> vt100::Color {
    match paint {
        Paint::Terminal => vt100::Color::Default,
        Paint::Black => vt100::Color::Idx(0),
        Paint::DarkGray => vt100::Color::Idx(8),
        Paint::LightGray => vt100::Color::Idx(7),
        Paint::White => vt100::Color::Idx(15),
        Paint::Indexed(index) => vt100::Color::Idx(index),
        Paint::Rgb([r, g, b]) => vt100::Color::Rgb(r, g, b),
    }
}

fn terminal(size: Size) -> vt100::Parser {
    let [rows, columns] = [size.height, size.width].map(|side| NonZeroU16::new(side as u16).unwrap());
    vt100::Parser::new(rows, columns, 0)
}

/// Fails with the first place where another cell is shown than was meant.
fn check(terminal: &vt100::Parser, meant: &Grid<Cell>) -> Result<(), TestCaseError> {
    let Size { width, height } = meant.size();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let shown = terminal.screen().cell(y as u16, x as u16).unwrap();
        // Pictures need no attributes beside their colours.
        prop_assert!(!(shown.bold() || shown.dim() || shown.inverse() || shown.underline()));
        let shown = Seen::shown(shown);
        prop_assert_eq!(shown, self::meant(meant[(x, y)]), "column {} row {}", x, y);
    }
    Ok(())
}

/// Colours of each palette.
fn paints() -> Vec<Vec<Paint>> {
    let grays = |count: u8| (0..count).map(|k| Paint::Rgb([k * 21; 3])).collect::<Vec<_>>();
    vec![
        FourGrays::VGA.paints().to_vec(),
        FourGrays::Indexed.paints().to_vec(),
        Palette::MONO.inks(),
        grays(13),
        (232..245).map(Paint::Indexed).collect(),
        vec![Paint::Rgb([255, 0, 9]), Paint::Rgb([10, 200, 30]), Paint::Rgb([0; 3]), Paint::Rgb([0, 0, 99])],
        vec![Paint::Terminal, Paint::Black, Paint::White, Paint::Indexed(16), Paint::Rgb([1, 2, 3])],
    ]
}

const GLYPHS: &str = "    ░▒▓█▀▄▌▐▘▝▖▗▙▟▛▜▚▞▂▆.-:*x@⠁⢈⣿";

/// Numbers that follow each other by a rule (Knuth's MMIX): a sequence that is short to tell.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }

    fn of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }
}

/// A sequence of screens, each the one before with some runs of cells in its place.
fn screens(seed: u64, size: Size, paints: &[Paint], count: usize) -> Vec<Grid<Cell>> {
    let mut numbers = Numbers(seed);
    let glyphs: Vec<char> = GLYPHS.chars().collect();
    let cell = |numbers: &mut Numbers| Cell {
        glyph: numbers.of(&glyphs),
        ink: numbers.of(paints),
        paper: numbers.of(paints),
    };
    let mut now = Grid::from_fn(size, |_, _| cell(&mut numbers));
    let mut all = vec![now.clone()];
    while all.len() < count {
        for _ in 0..numbers.below(size.area() / 4 + 2) {
            let begin = numbers.below(size.area());
            let (fill, length) = (cell(&mut numbers), 1 + numbers.below(6));
            let end = size.area().min(begin + length);
            now.values_mut()[begin..end].fill(fill);
        }
        all.push(now.clone());
    }
    all
}

/// A palette's colours, a size, small or wide, and a seed.
fn cases() -> impl Strategy<Value = (Vec<Paint>, Size, u64)> {
    let sizes = prop_oneof![
        (1_u32..12, 1_u32..6).prop_map(|(width, height)| Size::new(width, height)),
        (90_u32..400, 1_u32..4).prop_map(|(width, height)| Size::new(width, height)),
    ];
    (prop::sample::select(paints()), sizes, any::<u64>())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_terminal_shows_each_screen_of_a_sequence((paints, size, seed) in cases()) {
        let screens = screens(seed, size, &paints, 4);
        let mut terminal = terminal(size);
        let mut encoder = Encoder::default();
        encoder.clear();
        encoder.draw(&screens[0]);
        terminal.process(encoder.take().as_bytes());
        check(&terminal, &screens[0])?;
        for pair in screens.windows(2) {
            encoder.turn(&pair[0], &pair[1]);
            terminal.process(encoder.take().as_bytes());
            check(&terminal, &pair[1])?;
        }
    }

    #[test]
    fn a_terminal_shows_a_still_and_nothing_beyond_it((paints, size, seed) in cases()) {
        let cells = &screens(seed, size, &paints, 1)[0];
        let mut still = Vec::new();
        ansi(cells, &mut still).unwrap();
        let still = String::from_utf8(still).unwrap();
        // One column and row more than the picture.
        let mut terminal = terminal(Size::new(size.width + 1, size.height + 1));
        terminal.process(still.replace('\n', "\r\n").as_bytes());
        check(&terminal, cells)?;
        let beyond = (0..=size.width).map(|x| (x, size.height)).chain((0..size.height).map(|y| (size.width, y)));
        for (x, y) in beyond {
            let shown = terminal.screen().cell(y as u16, x as u16).unwrap();
            prop_assert!(!shown.has_contents() && shown.bgcolor() == vt100::Color::Default);
        }
    }
}

/// A tmux of its own.
struct Tmux<'a> {
    socket: &'a str,
}

impl Tmux<'_> {
    fn run(&self, arguments: &[&str]) -> Option<Output> {
        let mut command = Command::new("tmux");
        command.env("LC_ALL", "C.UTF-8").env_remove("TMUX").args([
            "-u",
            "-f",
            "/dev/null",
            "-S",
            self.socket,
        ]);
        command.args(arguments).output().ok().filter(|output| output.status.success())
    }
}

/// The whole sequence goes to a real terminal emulator, which tells what it shows at the end.
#[test]
fn tmux_shows_the_last_screen_of_a_sequence() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("read-back");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    // A socket's name has a limit of some hundred letters, which a target folder may be near to.
    let socket = std::env::temp_dir().join(format!("ray13-read-back-{}", std::process::id()));
    let tmux = Tmux { socket: socket.to_str().unwrap() };
    if tmux.run(&["-V"]).is_none() {
        eprintln!("skipped: tmux is not installed");
        return;
    }
    let size = Size::new(200, 24);
    for (number, paints) in paints().iter().enumerate() {
        let screens = screens(number as u64, size, paints, 5);
        let mut encoder = Encoder::default();
        encoder.clear();
        encoder.draw(&screens[0]);
        for pair in screens.windows(2) {
            encoder.turn(&pair[0], &pair[1]);
        }
        let bytes = folder.join(format!("bytes-{number}"));
        fs::write(&bytes, encoder.take()).unwrap();
        let shell =
            format!("stty raw; cat {}; tmux -S {} wait-for -S shown; sleep 60", bytes.display(), tmux.socket);
        let started = tmux.run(&["new-session", "-d", "-x", "200", "-y", "24", &shell]);
        assert!(started.is_some(), "tmux starts");
        tmux.run(&["wait-for", "shown"]).expect("tmux has read it all");
        let told = tmux.run(&["capture-pane", "-p", "-e", "-N"]).expect("tmux tells what it shows");
        tmux.run(&["kill-server"]);
        let mut terminal = terminal(size);
        let told = String::from_utf8(told.stdout).unwrap();
        terminal.process(told.trim_end_matches('\n').replace('\n', "\r\n").as_bytes());
        check(&terminal, screens.last().unwrap()).unwrap_or_else(|error| panic!("palette {number}: {error}"));
    }
    let _ = fs::remove_file(socket);
}
