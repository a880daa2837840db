//! POV-Ray's own anti-aliasing, beside a picture of 256 of its rays a dot.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

use ray13::tone::Level;

use super::picture::{level, wrong_levels};

/// Dots across and down: scenes of the Standard Procedural Databases are square.
const SIDE: &str = "320";

/// What is measured, and what it is called with: `+A` takes so many rays more of a dot where it differs from
/// one beside it by more than that (`+AM1`: `+R` by `+R` of them; `+AM2`: as deep as `+R`, where they
/// differ).
const SETTINGS: [(&str, &[&str]); 3] =
    [("-A", &["-A"]), ("+A0.3", &["+A0.3"]), ("+A0.3 +AM2 +R3", &["+A0.3", "+AM2", "+R3"])];

/// 16 by 16 rays of every dot.
const REFERENCE: [&str; 3] = ["+A0.0", "+AM1", "+R16"];

pub fn measure(file: &str) -> Result<(), Box<dyn Error>> {
    let name = Path::new(file).file_name().unwrap_or_default().to_string_lossy();
    let (reference, _) = traced(file, &REFERENCE)?;
    for (what, options) in SETTINGS {
        let mut times = Vec::new();
        let mut picture = Vec::new();
        for _ in 0..3 {
            let (levels, seconds) = traced(file, options)?;
            times.push(seconds);
            picture = levels;
        }
        times.sort_by(f64::total_cmp);
        let wrong = 100.0 * wrong_levels(&picture, &reference);
        println!("| {name} | {what} | {wrong:.2} % | {:.0} ms |", times[1] * 1e3);
    }
    Ok(())
}

/// The levels of a picture without jitter, and the seconds that POV-Ray traced it for on one thread.
fn traced(file: &str, options: &[&str]) -> Result<(Vec<Level>, f64), Box<dyn Error>> {
    let picture = tempfile::Builder::new().suffix(".ppm").tempfile()?.into_temp_path();
    let output = Command::new("povray")
        .args([format!("+I{file}"), format!("+O{}", picture.display())])
        .args([format!("+W{SIDE}"), format!("+H{SIDE}")])
        .args(["-D", "+WT1", "-J", "+FP16", "File_Gamma=1.0"])
        .args(options)
        .output()
        .map_err(|error| format!("povray: {error} (Debian: povray povray-includes)"))?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() {
        return Err(said.into());
    }
    let time = said.split("Trace Time:").nth(1).and_then(|rest| rest.split_once('('));
    let seconds = time.and_then(|(_, rest)| rest.split_once(" seconds")).map(|(seconds, _)| seconds.parse());
    Ok((levels(&fs::read(&picture)?)?, seconds.ok_or("povray told no time")??))
}

/// Of a PPM of 16 bits a channel in linear light; by the luminance of its sRGB primaries.
fn levels(file: &[u8]) -> Result<Vec<Level>, Box<dyn Error>> {
    let dots = SIDE.parse::<usize>()?.pow(2);
    let values = file.len().checked_sub(6 * dots).ok_or("povray wrote no whole picture")?;
    let light = |bytes: &[u8]| f64::from(u16::from_be_bytes([bytes[0], bytes[1]])) / 65535.0;
    let dot = |dot: &[u8]| {
        level(0.2126 * light(&dot[0..2]) + 0.7152 * light(&dot[2..4]) + 0.0722 * light(&dot[4..6]))
    };
    Ok(file[values..].chunks_exact(6).map(dot).collect())
}
