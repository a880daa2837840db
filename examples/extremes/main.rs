//! Measures the exact engine where numbers end, against arithmetic of 600 bits: prints the table of
//! `docs/numerics.md` and draws its picture: `cargo run --release --example extremes [docs/pictures/extremes.png]`.

#[allow(dead_code, reason = "the tests ask more of these than this example does")]
#[path = "../../tests/conformance/aim.rs"]
mod aim;
#[allow(dead_code, reason = "as above")]
#[path = "../../tests/conformance/chance.rs"]
mod chance;
mod chart;
#[allow(dead_code, reason = "as above")]
#[path = "../../tests/conformance/engine.rs"]
mod engine;
mod measure;
#[allow(dead_code, unused_imports, reason = "as above")]
#[path = "../../tests/oracle/mod.rs"]
mod oracle;
#[allow(dead_code, reason = "as above")]
#[path = "../../tests/conformance/solids.rs"]
mod solids;
#[allow(dead_code, reason = "as above")]
#[path = "../../tests/conformance/tally.rs"]
mod tally;

use std::error::Error;
use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};

use chart::{Chart, Line};
use measure::{Case, Subject, measured, subjects};
use ray13::output;

/// What is taken to its ends, and how far: powers of ten.
struct Series {
    title: &'static str,
    /// What stands before the power of ten in a row.
    unit: &'static str,
    decades: &'static [i32],
    case: fn(f64) -> Case,
}

const SERIES: [Series; 3] = [
    Series {
        title: "DISTANCE IN RADII",
        unit: "distance",
        decades: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9],
        case: |x| Case { distance: x, ..Case::PLAIN },
    },
    Series {
        title: "RADIUS",
        unit: "radius",
        decades: &[-150, -100, -50, -20, -10, -5, -2, 0, 2, 5, 10, 20, 50, 100, 150],
        case: |x| Case { scale: x, ..Case::PLAIN },
    },
    Series {
        title: "PLACE IN RADII",
        unit: "place",
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
    writeln!(
        out,
        "| | | rays | hits | wrong | wrong within the bound | error of t, ulps | of the stated error |"
    )?;
    writeln!(out, "|---|---|--:|--:|--:|--:|--:|--:|")?;
    for series in &SERIES {
        let mut lines: Vec<Line> =
            subjects.iter().map(|s| Line { name: s.name, points: Vec::new() }).collect();
        for &decade in series.decades {
            for (subject, line) in subjects.iter().zip(&mut lines) {
                progress(done, steps, series, subject, decade);
                done += 1;
                let tally = measured(subject, &(series.case)(libm::pow(10.0, f64::from(decade))), decade);
                line.points.push((decade, tally.ulps));
                writeln!(
                    out,
                    "| {} 1e{decade} | {} | {} | {} | {} | {:.2} % | {:.2} | {:.3} |",
                    series.unit,
                    subject.name.to_lowercase(),
                    tally.rays,
                    tally.hits,
                    tally.wrong.len() + tally.inexact.len(),
                    100.0 * tally.wrong_at_rim as f64 / tally.rays as f64,
                    tally.ulps,
                    tally.stated
                )?;
            }
        }
        charts.push(Chart { title: series.title, lines });
    }
    if io::stderr().is_terminal() {
        eprint!("\r\x1b[K");
    }
    if let Some(path) = path {
        output::png(&chart::drawn(&charts), &mut BufWriter::new(File::create(path)?))?;
    }
    Ok(())
}

/// One line that is written over, on a terminal only.
fn progress(done: usize, steps: usize, series: &Series, subject: &Subject, decade: i32) {
    if io::stderr().is_terminal() {
        eprint!(
            "\r\x1b[K{} % {} 1e{decade}, {}",
            100 * done / steps,
            series.unit,
            subject.name.to_lowercase()
        );
    }
}
