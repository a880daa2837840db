//! Measures the exact engine where numbers end, against arithmetic of 600 bits: prints the table of
//! `docs/numerics.md` and draws its picture:
//! `cargo run --release --example extremes [docs/pictures/extremes.png]`.

#[expect(dead_code, unused_imports, reason = "the tests ask more of it than this example does")]
mod support {
    pub mod oracle;
}

#[expect(dead_code, reason = "as above")]
mod conformance {
    pub mod aim;
    pub mod chance;
    pub mod engine;
    pub mod solids;
    pub mod tally;
}

mod table {
    pub mod chart;
    pub mod measure;
}

use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};

use conformance::tally::Tally;
use ray13::output;
use table::chart::{Chart, Line, drawn};
use table::measure::{Case, Subject, measured, subjects};

/// What is taken to its ends, and how far: powers of ten.
struct Series {
    title: &'static str,
    decades: &'static [i32],
    case: fn(f64) -> Case,
}

const SERIES: [Series; 3] = [
    Series {
        title: "DISTANCE IN RADII",
        decades: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
        case: |x| Case { distance: x, ..Case::PLAIN },
    },
    Series {
        title: "RADIUS",
        decades: &[-150, -100, -50, -20, -10, -5, 0, 5, 10, 20, 50, 100, 150],
        case: |x| Case { scale: x, ..Case::PLAIN },
    },
    Series {
        title: "PLACE IN RADII",
        decades: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12],
        case: |x| Case { place: x, ..Case::PLAIN },
    },
];

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1);
    let subjects = subjects();
    let steps: usize = SERIES.iter().map(|series| series.decades.len() * subjects.len()).sum();
    let mut done = 0;
    let mut charts = Vec::new();
    let mut out = io::stdout().lock();
    for series in &SERIES {
        let names: Vec<String> = subjects.iter().map(|subject| subject.name.to_lowercase()).collect();
        writeln!(out, "| {} | rays | {} |", series.title.to_lowercase(), names.join(" | "))?;
        writeln!(out, "|--:|--:|{}", "--:|".repeat(subjects.len()))?;
        let mut lines: Vec<Line> =
            subjects.iter().map(|s| Line { name: s.name, points: Vec::new() }).collect();
        for &decade in series.decades {
            let (mut rays, mut cells) = (0, Vec::new());
            for (subject, line) in subjects.iter().zip(&mut lines) {
                progress(done, steps, series, subject, decade);
                done += 1;
                let tally = measured(subject, &(series.case)(libm::pow(10.0, f64::from(decade))), decade);
                line.points.push((decade, tally.ulps));
                rays += tally.rays;
                cells.push(said(&tally));
            }
            writeln!(out, "| 1e{decade} | {rays} | {} |", cells.join(" | "))?;
        }
        writeln!(out)?;
        charts.push(Chart { title: series.title, lines });
    }
    if io::stderr().is_terminal() {
        eprint!("\r\x1b[K");
    }
    if let Some(path) = path {
        output::png(&drawn(&charts), &mut BufWriter::new(File::create(path)?))?;
    }
    Ok(())
}

/// Wrong beyond the bound, in rays; wrong within it, of all rays; the largest error of `t` in ulps; and of
/// what the engine says itself.
fn said(tally: &Tally) -> String {
    for ray in tally.wrong.iter().chain(&tally.inexact) {
        eprintln!("{ray}");
    }
    let share = 100.0 * tally.wrong_at_rim as f64 / tally.rays as f64;
    let wrong = tally.wrong.len() + tally.inexact.len();
    format!("{wrong}, {share:.1} %, {:.2}, {:.2}", tally.ulps, tally.stated)
}

/// One line that is written over, on a terminal only.
fn progress(done: usize, steps: usize, series: &Series, subject: &Subject, decade: i32) {
    if io::stderr().is_terminal() {
        let (title, name) = (series.title.to_lowercase(), subject.name.to_lowercase());
        eprint!("\r\x1b[K{} %, {title} 1e{decade}, {name}", 100 * done / steps);
    }
}
