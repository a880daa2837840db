//! (to be written)

use std::process::ExitCode;

use crate::app::{self, Settings};
use crate::frame::Studio;
use crate::scene::Scene;

/// Runs the command line.
pub fn run() -> ExitCode {
    let settings = Settings { title: "empty.scene".to_owned(), ..Settings::default() };
    match app::run(Studio::new(Scene::default()), settings) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("ray13: {error}");
            ExitCode::FAILURE
        }
    }
}
