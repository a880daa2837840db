//! Measures what `docs/trade.md` shows, and puts it there: each table between its marks, each plot beside the
//! page's other pictures. Takes about ten minutes:
//!
//! ```sh
//! cargo run --release --example trade-off -- docs/trade.md
//! cargo run --release --example trade-off -- docs/trade.md curves    # one of the tables alone
//! ```
//!
//! The scenes of the Standard Procedural Databases are taken from ../shared/scenes/spd, and left out where
//! they are not there.

mod curves;
mod losses;
#[path = "../../benches/scenery/mod.rs"]
#[expect(
    dead_code,
    reason = "of its shapes and spreads one is measured here, the others in benches/growth.rs"
)]
mod scenery;
mod structures;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Duration;

use ray13::frame::Studio;
use ray13::scene::{self, ReadOptions, embedded};

/// A table of the page, by the name of its marks.
type Table = (&'static str, fn(&Path) -> Result<String, Box<dyn Error>>);

const TABLES: [Table; 4] = [
    ("curves", curves::tables),
    ("losses", |_| losses::table()),
    ("glass", |_| losses::nested_glass()),
    ("structures", |_| structures::table()),
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (page, only) = match &arguments[..] {
        [measure, file, structure] if measure == structures::MEASURE => {
            return structures::measure(file, structure);
        }
        [page] => (page, None),
        [page, only] => (page, Some(only.as_str())),
        _ => return Err("expected the page, and the name of a table if only one is to be made".into()),
    };
    let pictures = Path::new(page).parent().unwrap_or(Path::new("")).join("pictures");
    for (name, table) in TABLES.into_iter().filter(|(name, _)| only.is_none_or(|only| only == *name)) {
        eprintln!("{name} …");
        let table = table(&pictures)?;
        // Read again for each: an hour of measuring is not lost by a fault in the last.
        let text = fs::read_to_string(page)?;
        let (begin, end) = (format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->"));
        let (before, rest) = text.split_once(&begin).ok_or_else(|| format!("{page} has no {begin}"))?;
        let (_, after) = rest.split_once(&end).ok_or_else(|| format!("{page} has no {end}"))?;
        fs::write(page, format!("{before}{begin}\n{}\n{end}{after}", table.trim_end().to_owned() + "\n"))?;
    }
    Ok(())
}

/// A scene inside.
fn inside(name: &str) -> Result<Studio, Box<dyn Error>> {
    let found = embedded().iter().find(|scene| scene.name == name).ok_or("no such scene")?;
    Ok(Studio::new(scene::read(found.name, found.text.as_bytes(), &ReadOptions::default())?)?)
}

/// A time to three digits.
fn ms(time: Duration) -> String {
    let ms = time.as_secs_f64() * 1e3;
    match ms {
        _ if ms < 10.0 => format!("{ms:.2} ms"),
        _ if ms < 100.0 => format!("{ms:.1} ms"),
        _ => format!("{ms:.0} ms"),
    }
}
