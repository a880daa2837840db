//! Whether the tracer and the oracle's calculation see the same: the same dots hit, depths to nine digits,
//! the same object, the same normal.

use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::Camera;

use crate::support::oracle::{Hit, Oracle};
use crate::support::rays::directions;
use crate::support::request::request;

/// What a picture agreed on, and where it did not.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Dots where both meet the scene in the same place.
    pub hits: usize,
    /// A line for each dot where they differ.
    pub faults: Vec<String>,
}

/// The share by which two depths may differ.
const DEPTH: f64 = 1e-9;

/// Maps and directions are rounded to 53 bits, and a needle's map multiplies that: what is left of a normal
/// is far more than a gray level needs, and a wrong face or a missing square would differ by far more than
/// this.
const NORMAL: f64 = 1e-6;

/// Draws one picture by every structure, all alike to the bit, and works it out again.
pub fn compare(studio: &Studio, oracle: &Oracle, camera: &Camera, dots: Size) -> Comparison {
    const EVERY: [StructureChoice; 4] =
        [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree, StructureChoice::Boxes];
    let frames = EVERY.map(|structure| {
        let mut request = request(camera.clone(), dots);
        request.options.structure = structure;
        (structure, studio.draw(&request))
    });
    let mut comparison = Comparison::default();
    for (structure, frame) in &frames[1..] {
        let to_none = frame.compare(&frames[0].1).unwrap();
        if !to_none.is_same() {
            let fault = format!("structure {structure:?} shows another picture than none: {to_none}");
            comparison.faults.push(fault);
        }
    }
    for (place, toward) in directions(camera, dots).into_iter().enumerate() {
        let expected = oracle.hit(camera.eye, toward);
        let faults = comparison.faults.len();
        for (structure, frame) in &frames {
            let depth = frame.depth.as_ref().unwrap().values()[place];
            let (object, normal) = (
                frame.object.as_ref().unwrap().values()[place],
                frame.normal.as_ref().unwrap().values()[place],
            );
            if !agrees(depth, object, normal, expected) {
                let dot = (place as u32 % dots.width, place as u32 / dots.width);
                comparison.faults.push(format!(
                    "dot {dot:?}, structure {structure:?}: traced {depth} {object} {normal}, expected {expected:?}"
                ));
            }
        }
        comparison.hits += usize::from(expected.is_some() && faults == comparison.faults.len());
    }
    comparison
}

/// Whether a dot shows what is expected.
pub fn agrees(depth: f64, object: u32, normal: DVec3, expected: Option<Hit>) -> bool {
    match expected {
        None => depth == f64::INFINITY && object == 0 && normal == DVec3::ZERO,
        Some(hit) => {
            // The tip of a cone has no normal to compare.
            let normals = hit.normal == DVec3::ZERO || hit.normal.abs_diff_eq(normal, NORMAL);
            (depth - hit.t).abs() <= DEPTH * hit.t && object == hit.object && normals
        }
    }
}

impl Comparison {
    /// The first faults, a line each.
    pub fn first_faults(&self) -> String {
        format!(
            "{} disagreements:\n{}",
            self.faults.len(),
            self.faults[..self.faults.len().min(5)].join("\n")
        )
    }
}
