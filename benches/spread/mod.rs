//! One scene of many objects, measured in a process of its own: so its memory is its own.

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use ray13::frame::Studio;
use ray13::plan::Options;
use ray13::scene::{ReadOptions, read_file};

use super::scenery::Scenery;
use super::{DOTS, fastest, ms};

/// Writes the scene to a file and has another process measure it: the cells of a row of the table.
pub fn measured(scenery: &Scenery) -> Result<String, Box<dyn Error>> {
    let file = std::env::temp_dir().join(format!("ray13-growth-{}.nff", std::process::id()));
    let mut out = BufWriter::new(File::create(&file)?);
    scenery.write(&mut out)?;
    out.flush()?;
    let output = Command::new(std::env::current_exe()?).arg(&file).output();
    fs::remove_file(&file)?;
    let output = output?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let row = String::from_utf8(output.stdout)?;
    let (times, peak) = row.trim_end().rsplit_once(' ').ok_or("a row without an end")?;
    let each = peak
        .parse::<u64>()
        .map_or_else(|_| "not known".to_owned(), |peak| (peak / scenery.objects).to_string());
    Ok(format!("{times} {each}"))
}

/// Measures a file and prints the times as cells of the table, then the most memory held at a time.
pub fn measure(file: &str) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let scene = read_file(Path::new(file), &ReadOptions::default())?;
    let reading = start.elapsed();
    let studio = Studio::new(scene)?;
    let picture = fastest(&studio, DOTS, Options::default());
    let built = studio.built();
    let times = [reading, built.assembling, built.cutting, picture].map(ms);
    println!("{} | {}", times.join(" | "), peak_memory().map_or("?".to_owned(), |bytes| bytes.to_string()));
    Ok(())
}

/// The most memory that the process has held, in bytes, where the system tells.
fn peak_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}
