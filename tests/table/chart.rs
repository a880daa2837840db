//! A chart of lines, pixel by pixel: decades across, errors upwards, both by powers of ten.

use ray13::math::{Grid, Size};
use ray13::output::Pixels;

/// One panel.
pub struct Chart {
    /// In capitals.
    pub title: &'static str,
    pub lines: Vec<Line>,
}

/// One line of it: by decade, the largest error in ulps.
pub struct Line {
    /// In capitals.
    pub name: &'static str,
    pub points: Vec<(i32, f64)>,
}

/// A panel and what lies around its frame, in pixels.
const PANEL: Size = Size::new(420, 300);
const LEFT: u32 = 52;
const RIGHT: u32 = 14;
const TOP: u32 = 34;
const BOTTOM: u32 = 34;
/// The strip of names above the panels.
const LEGEND: u32 = 34;

/// The exponents of ten at the lower and the upper edge of a panel, in ulps; below the lower one stands 0.
const LEAST: i32 = -2;
const MOST: i32 = 2;

/// What no error may pass, in ulps: the bound of the tests.
const BOUND: f64 = crate::conformance::tally::MOST_ULPS;

const PAPER: [u8; 3] = [255, 255, 255];
const INK: [u8; 3] = [60, 60, 60];
const RULE: [u8; 3] = [226, 226, 226];
const LIMIT: [u8; 3] = [200, 80, 80];
/// Okabe and Ito's colours, which those can tell apart who see fewer (Color Universal Design, 2008).
const COLORS: [[u8; 3]; 6] =
    [[0, 114, 178], [230, 159, 0], [0, 158, 115], [213, 94, 0], [86, 180, 233], [204, 121, 167]];

/// The characters of the labels, five rows of three bits each, the highest bit at the left.
const FONT: [(char, [u8; 5]); 36] = [
    ('0', [7, 5, 5, 5, 7]),
    ('1', [2, 6, 2, 2, 7]),
    ('2', [7, 1, 7, 4, 7]),
    ('3', [7, 1, 3, 1, 7]),
    ('4', [5, 5, 7, 1, 1]),
    ('5', [7, 4, 7, 1, 7]),
    ('6', [7, 4, 7, 5, 7]),
    ('7', [7, 1, 1, 2, 2]),
    ('8', [7, 5, 7, 5, 7]),
    ('9', [7, 5, 7, 1, 7]),
    ('A', [2, 5, 7, 5, 5]),
    ('B', [6, 5, 6, 5, 6]),
    ('C', [3, 4, 4, 4, 3]),
    ('D', [6, 5, 5, 5, 6]),
    ('E', [7, 4, 6, 4, 7]),
    ('F', [7, 4, 6, 4, 4]),
    ('G', [3, 4, 5, 5, 3]),
    ('H', [5, 5, 7, 5, 5]),
    ('I', [7, 2, 2, 2, 7]),
    ('K', [5, 5, 6, 5, 5]),
    ('L', [4, 4, 4, 4, 7]),
    ('M', [5, 7, 7, 5, 5]),
    ('N', [6, 5, 5, 5, 5]),
    ('O', [2, 5, 5, 5, 2]),
    ('P', [6, 5, 6, 4, 4]),
    ('R', [6, 5, 6, 5, 5]),
    ('S', [3, 4, 2, 1, 6]),
    ('T', [7, 2, 2, 2, 2]),
    ('U', [5, 5, 5, 5, 7]),
    ('V', [5, 5, 5, 5, 2]),
    ('W', [5, 5, 7, 7, 5]),
    ('X', [5, 5, 2, 5, 5]),
    ('Y', [5, 5, 2, 2, 2]),
    ('-', [0, 0, 7, 0, 0]),
    ('.', [0, 0, 0, 0, 2]),
    (' ', [0, 0, 0, 0, 0]),
];
/// Pixels of a bit of the font, and from one character to the next.
const BIT: u32 = 2;
const STEP: u32 = 4 * BIT;

type Picture = Grid<[u8; 3]>;

/// The panels side by side, the names of the lines above them.
pub fn drawn(charts: &[Chart]) -> Pixels {
    let size = Size::new(PANEL.width * charts.len() as u32, PANEL.height + LEGEND);
    let mut picture = Grid::filled(size, PAPER);
    legend(&mut picture, charts);
    for (place, chart) in charts.iter().enumerate() {
        panel(&mut picture, chart, place as u32 * PANEL.width);
    }
    Pixels::Color(picture)
}

fn legend(picture: &mut Picture, charts: &[Chart]) {
    let mut x = LEFT;
    let title = "LARGEST ERROR OF T IN ULPS";
    write(picture, (x, 12), title, INK);
    x += STEP * (title.len() as u32 + 4);
    for (line, color) in charts.iter().flat_map(|chart| &chart.lines).zip(COLORS) {
        fill(picture, (x, 14), Size::new(24, 4), color);
        write(picture, (x + 32, 12), line.name, INK);
        x += 32 + STEP * (line.name.len() as u32 + 3);
    }
}

fn panel(picture: &mut Picture, chart: &Chart, left: u32) {
    let decades: Vec<i32> = chart.lines[0].points.iter().map(|(decade, _)| *decade).collect();
    let (width, height) = (PANEL.width - LEFT - RIGHT, PANEL.height - TOP - BOTTOM);
    let (x0, y0) = (left + LEFT, LEGEND + TOP);
    // Measured decades stand at even steps, whatever lies between them.
    let across = |place: usize| x0 + (place as u32 * width) / (decades.len() as u32 - 1);
    let upward = |ulps: f64| {
        let exponent = libm::log10(ulps).clamp(f64::from(LEAST), f64::from(MOST));
        let share = (f64::from(MOST) - exponent) / f64::from(MOST - LEAST);
        y0 + (share * f64::from(height)).round() as u32
    };
    write(picture, (x0, y0 - 18), chart.title, INK);
    for exponent in LEAST..=MOST {
        let y = upward(libm::pow(10.0, f64::from(exponent)));
        fill(picture, (x0, y), Size::new(width, 1), RULE);
        let label = ["0.01", "0.1", "1", "10", "100"][(exponent - LEAST) as usize];
        write(picture, (x0 - 6 - STEP * label.len() as u32, y - 4), label, INK);
    }
    for (place, decade) in decades.iter().enumerate() {
        let x = across(place);
        fill(picture, (x, y0), Size::new(1, height), RULE);
        // Every label is as wide as two or three steps.
        if place % 2 == 0 {
            let label = format!("1E{decade}");
            let half = STEP * label.len() as u32 / 2;
            write(
                picture,
                (x.saturating_sub(half).min(left + PANEL.width - 2 * half), y0 + height + 8),
                &label,
                INK,
            );
        }
    }
    fill(picture, (x0, upward(BOUND)), Size::new(width, 2), LIMIT);
    for (line, color) in chart.lines.iter().zip(COLORS) {
        let points: Vec<(u32, u32)> =
            line.points.iter().enumerate().map(|(place, (_, ulps))| (across(place), upward(*ulps))).collect();
        for pair in points.windows(2) {
            stroke(picture, pair[0], pair[1], color);
        }
        for (x, y) in points {
            fill(picture, (x - 2, y - 2), Size::new(5, 5), color);
        }
    }
}

fn fill(picture: &mut Picture, (x, y): (u32, u32), size: Size, color: [u8; 3]) {
    let all = picture.size();
    for row in y..(y + size.height).min(all.height) {
        for column in x..(x + size.width).min(all.width) {
            picture[(column, row)] = color;
        }
    }
}

/// A line two pixels thick.
fn stroke(picture: &mut Picture, from: (u32, u32), to: (u32, u32), color: [u8; 3]) {
    let steps = from.0.abs_diff(to.0).max(from.1.abs_diff(to.1)).max(1);
    let between = |a: u32, b: u32, step: u32| {
        let share = f64::from(step) / f64::from(steps);
        (f64::from(a) + (f64::from(b) - f64::from(a)) * share).round() as u32
    };
    for step in 0..=steps {
        fill(picture, (between(from.0, to.0, step), between(from.1, to.1, step)), Size::new(2, 2), color);
    }
}

fn write(picture: &mut Picture, (x, y): (u32, u32), text: &str, color: [u8; 3]) {
    for (place, character) in text.chars().enumerate() {
        let Some((_, rows)) = FONT.iter().find(|(known, _)| *known == character) else { continue };
        for (row, bits) in rows.iter().enumerate() {
            for column in (0..3).filter(|column| bits & (4 >> column) != 0) {
                let at = (x + place as u32 * STEP + column * BIT, y + row as u32 * BIT);
                fill(picture, at, Size::new(BIT, BIT), color);
            }
        }
    }
}
