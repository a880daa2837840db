//! Measures what anti-aliasing costs and brings, and prints the tables of `docs/performance.md`:
//! `cargo run --release --example antialiasing`, or of other scenes:
//! `… --example antialiasing -- glass ../shared/scenes/spd/balls.nff`. A file of POV-Ray among them is traced
//! by the program `povray`, beside its own reference.

mod by_need;
mod picture;
mod povray;

use std::error::Error;
use std::path::Path;

use ray13::frame::Studio;
use ray13::scene::{ReadOptions, embedded, read};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut scenes: Vec<(String, Vec<u8>)> = Vec::new();
    for scene in embedded() {
        if arguments.is_empty() || arguments.iter().any(|name| name == scene.name) {
            scenes.push((scene.name.to_owned(), scene.text.as_bytes().to_vec()));
        }
    }
    let files = arguments.iter().filter(|name| embedded().iter().all(|scene| scene.name != **name));
    let (theirs, own): (Vec<_>, Vec<_>) =
        files.partition(|file| Path::new(file).extension().is_some_and(|ending| ending == "pov"));
    for file in own {
        scenes.push((file.rsplit('/').next().unwrap_or(file).to_owned(), std::fs::read(file)?));
    }
    if !scenes.is_empty() {
        println!(
            "| scene | fixed rays | wrong levels | time | `--error` with no more | rays | time | share |"
        );
        println!("|---|---|---|---|---|---|---|---|");
    }
    for (name, text) in scenes {
        let options = ReadOptions { skip_unsupported: true, ..ReadOptions::default() };
        by_need::measure(&name, &Studio::new(read(&name, &text, &options)?)?);
    }
    if !theirs.is_empty() {
        println!("| scene | POV-Ray | wrong levels | time |");
        println!("|---|---|---|---|");
    }
    for file in theirs {
        povray::measure(file)?;
    }
    Ok(())
}
