//! How long pictures take.

use std::time::Instant;

use serde_json::{Value, json};

use crate::frame::{Request, Studio, Wants};
use crate::math::DVec3;
use crate::output::Encoder;
use crate::trade::{Effort, Timing, peak_memory};

use super::arguments::BenchArguments;
use super::error::CliError;
use super::picture::Unsized;
use super::write::print;
use super::{effects, input, stats};

/// The turn between two frames whose difference is sent, in degrees: a press of an arrow key.
const TURN: f64 = 5.0;

/// Measures a scene and prints the figures.
pub fn run(arguments: &BenchArguments) -> Result<(), CliError> {
    input::say(&effects::check(&arguments.picture, effects::Presentation::Cells)?);
    let reading = Instant::now();
    let scene = input::read(&arguments.scene.file, &arguments.scene.reading)?;
    input::say(&scene.notes);
    let read = reading.elapsed();
    let studio = input::studio(scene)?;
    // A size in dots is that of a picture without characters.
    let wants = if arguments.picture.dots.is_some() { Wants::LIGHT } else { Wants::CELLS };
    let request = arguments.picture.request(&studio, arguments.picture.look(None), wants, Unsized::Screen)?;

    let timing = Timing::new(&studio, &request, Effort::default());
    let sent = Sent::new(&studio, &Request { wants: Wants::CELLS, ..request });

    let mut figures = stats::figures(&timing.frame, &studio.built());
    let mut put = |key: &str, value: Value| figures.insert(key.to_owned(), value);
    put("frames", json!(timing.times().len()));
    put("frame_ms_min", json!(stats::ms(timing.least())));
    put("frame_ms_median", json!(stats::ms(timing.median())));
    put("read_ms", json!(stats::ms(read)));
    put("rays_per_second", json!(timing.rays_per_second().round()));
    put("bytes_first_frame", json!(sent.first));
    put("bytes_per_frame", json!(sent.next));
    put("peak_rss_bytes", json!(peak_memory()));
    let text = if arguments.json { format!("{}\n", Value::Object(figures)) } else { stats::lines(&figures) };
    print(text.as_bytes())
}

/// What a terminal is sent, in bytes.
struct Sent {
    /// For a picture on a blank screen.
    first: usize,
    /// For the same from a little farther round, in its place.
    next: usize,
}

impl Sent {
    fn new(studio: &Studio, request: &Request) -> Self {
        let [shown, next] = [request, &turned(request)].map(|request| studio.draw(request).cells);
        let (Some(shown), Some(next)) = (shown, next) else { return Self { first: 0, next: 0 } };
        let mut encoder = Encoder::default();
        encoder.draw(&*shown);
        let first = encoder.take().len();
        encoder.turn(&*shown, &*next);
        Self { first, next: encoder.len() }
    }
}

/// The same picture from a little farther round.
fn turned(request: &Request) -> Request {
    let mut request = request.clone();
    let camera = &mut request.camera;
    let (sin, cos) = libm::sincos(TURN.to_radians());
    let axis = camera.up.normalize_or(DVec3::Z);
    let sight = camera.eye - camera.target;
    // Rodrigues' rotation about the axis.
    let turned = sight * cos + axis.cross(sight) * sin + axis * axis.dot(sight) * (1.0 - cos);
    camera.eye = camera.target + turned;
    request
}
