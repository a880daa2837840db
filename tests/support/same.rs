//! Two pictures, dot by dot.

use ray13::frame::{Frame, Request, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{EngineChoice, StructureChoice};
use ray13::scene::{Camera, ReadOptions, read};

use crate::support::request::request;

/// All that the dots of a picture hold, to the bit.
fn dots(frame: &Frame) -> Vec<Vec<u64>> {
    let light = frame.light.values().iter();
    let mut all: Vec<Vec<u64>> = light.map(|light| vec![light.to_bits()]).collect();
    if let Some(color) = &frame.color {
        for (dot, color) in all.iter_mut().zip(color.values()) {
            dot.extend(color.to_array().map(f64::to_bits));
        }
    }
    for (dot, depth) in all.iter_mut().zip(frame.depth.as_ref().unwrap().values()) {
        dot.push(depth.to_bits());
    }
    for (dot, normal) in all.iter_mut().zip(frame.normal.as_ref().unwrap().values()) {
        dot.extend(normal.to_array().map(f64::to_bits));
    }
    for (dot, object) in all.iter_mut().zip(frame.object.as_ref().unwrap().values()) {
        dot.push(u64::from(*object));
    }
    all
}

/// How many dots of two pictures differ, and what the first of them hold: light, colour, depth, normal,
/// object.
pub fn difference(a: &Frame, b: &Frame) -> Option<String> {
    let (one, other) = (dots(a), dots(b));
    assert_eq!(one.len(), other.len());
    let faults: Vec<usize> = (0..one.len()).filter(|&place| one[place] != other[place]).collect();
    let &first = faults.first()?;
    let width = a.light.size().width as usize;
    let say = |dot: &[u64]| {
        let (object, numbers) = dot.split_last().unwrap();
        let numbers: Vec<f64> = numbers.iter().map(|&bits| f64::from_bits(bits)).collect();
        format!("{numbers:?} {object}")
    };
    Some(format!(
        "{} of {} dots differ, the first at ({}, {}):\n  {}\n  {}",
        faults.len(),
        one.len(),
        first % width,
        first / width,
        say(&one[first]),
        say(&other[first])
    ))
}

/// The picture of the fast engine.
pub fn fast(studio: &Studio, request: &Request) -> Frame {
    let mut request = request.clone();
    (request.options.engine, request.options.structure) = (EngineChoice::Fast, StructureChoice::Auto);
    let frame = studio.draw_anew(&request);
    assert_eq!((frame.engine, frame.space.name()), (EngineChoice::Fast, "boxes"));
    frame
}

/// The picture of the exact engine by a structure.
pub fn exact(studio: &Studio, request: &Request, structure: StructureChoice) -> Frame {
    let mut request = request.clone();
    (request.options.engine, request.options.structure) = (EngineChoice::Exact, structure);
    let frame = studio.draw_anew(&request);
    assert_eq!(frame.engine, EngineChoice::Exact);
    frame
}

/// Checks that both engines give the same picture of a text in which something stands before a lamp: by its
/// own camera, and from some eyes.
#[track_caller]
pub fn same(name: &str, text: &str, dots: Size, eyes: &[DVec3]) {
    let scene = read(name, text.as_bytes(), &ReadOptions::default());
    let studio = Studio::new(scene.unwrap_or_else(|e| panic!("{e}"))).unwrap();
    let own = studio.camera(0, f64::from(dots.width) / f64::from(dots.height));
    let target = DVec3::new(0.1, 0.05, -0.07);
    let others = eyes.iter().map(|&eye| Camera { eye, target, ..own.clone() });
    for camera in others.chain([own.clone()]) {
        let request = request(camera, dots);
        let frame = fast(&studio, &request);
        assert!(frame.counts.shadow_hits > 0, "no light is stopped");
        if let Some(fault) = difference(&frame, &exact(&studio, &request, StructureChoice::None)) {
            panic!("from {}: {fault}", request.camera.eye);
        }
    }
}
