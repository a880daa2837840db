//! What both sets of measurements start from: how they are taken, and scenes.

use std::time::Duration;

use criterion::Criterion;
use ray13::scene::{self, Format, ReadOptions, Scene};
use ray13::solid::Assembly;

use super::scenery::{Scenery, Shape, Spread};

/// Few samples for a short time each: together the benches take about a minute, and what is asked is a
/// factor, not a percent.
pub fn criterion() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .configure_from_args()
}

/// A scene of one of the texts here.
///
/// # Panics
/// Where the text is no scene.
pub fn scene(name: &str, text: &str, format: Format) -> Scene {
    let options = ReadOptions { format: Some(format), ..ReadOptions::default() };
    scene::read(name, text.as_bytes(), &options).unwrap_or_else(|e| panic!("{e}"))
}

/// The solids of a scene, put together.
///
/// # Panics
/// Where they can not be.
pub fn assembled(scene: &Scene) -> Assembly {
    Assembly::new(scene).unwrap_or_else(|e| panic!("{e}"))
}

/// Objects evenly spread over a cube, as NFF.
///
/// # Panics
/// Never: memory takes all that is written.
pub fn spread(objects: u64, shape: Shape) -> String {
    let mut text = Vec::new();
    let scenery = Scenery { objects, shape, spread: Spread::Even, seed: 1 };
    scenery.write(&mut text).expect("memory takes all that is written");
    String::from_utf8(text).expect("digits and blanks")
}
