//! The tracer against the oracle's calculation on meshes that are hard on both.
//!
//! The rule at edges. Of the triangles around an edge or a corner a ray meets exactly as many as the rays
//! beside it: none slips between two, and none meets an edge alone. Which of them it meets, where it passes
//! an edge so near that rounding decides, or runs along a face, is not known: what is shown then must be what
//! the oracle sees along the ray or along one beside it, no farther off than rounding could have moved it.

use crate::support::nasty_meshes::{Extent, Nasty, nasty};
use crate::support::oracle::{Hit, Oracle, Wide};
use crate::support::oracle_agreement::agrees;
use crate::support::rays::directions;
use crate::support::request::request;
use ray13::frame::Studio;
use ray13::math::{DVec3, Size};
use ray13::scene::Scene;

/// How far rounding may move a ray or a corner, as a share of the way between them, and of their coordinates:
/// the bound on thickness of `docs/numerics.md`.
const OFF: f64 = 4e-14;

/// So many rays beside one are asked.
const BESIDE: u32 = 64;

/// What a dot shows.
#[derive(Clone, Copy, Debug)]
struct Shown {
    depth: f64,
    object: u32,
    normal: DVec3,
}

/// Whether the oracle sees what is shown along one of the rays around a ray; coordinates reach as far as
/// `far`.
fn is_seen_beside(oracle: &Oracle, (eye, toward): (DVec3, DVec3), far: f64, shown: &Shown) -> bool {
    let (across, up) = toward.any_orthonormal_pair();
    (0..BESIDE).any(|i| {
        let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / f64::from(BESIDE));
        let hit = oracle.hit(eye, toward + OFF * (cos * across + sin * up)).map(|hit| {
            // Where a face is crossed is off by as much, over the sine of the angle.
            let slack = OFF * (hit.t + far) / hit.normal.dot(toward).abs();
            let is_near = (shown.depth - hit.t).abs() <= slack;
            Hit { t: if is_near { shown.depth } else { hit.t }, ..hit }
        });
        agrees(shown.depth, shown.object, shown.normal, hit)
    })
}

/// What a mesh's pictures hold.
#[derive(Debug, Default)]
struct Count {
    hits: usize,
    misses: usize,
    /// Dots where only a ray beside it shows the same.
    undecided: usize,
    wrong: Vec<String>,
}

fn look(nasty: &Nasty, scene: Scene, across: u32, count: &mut Count) {
    let studio = Studio::new(scene).unwrap();
    let oracle = Oracle::<Wide>::new(studio.scene());
    // A ray that runs along a face crosses it within an interval as long as the scene: beside it numbers are
    // taken at their word.
    let strict = Oracle::<Wide>::with_tolerance(studio.scene(), 0.0);
    let Extent { middle, size } = nasty.extent();
    let dots = Size::new(across, across);
    for (view, camera) in nasty.cameras().into_iter().enumerate() {
        let far = size + middle.length();
        let frame = studio.draw(&request(camera.clone(), dots));
        for (place, toward) in directions(&camera, dots).into_iter().enumerate() {
            let shown = Shown {
                depth: frame.depth.as_ref().unwrap().values()[place],
                object: frame.object.as_ref().unwrap().values()[place],
                normal: frame.normal.as_ref().unwrap().values()[place],
            };
            let expected = oracle.hit(camera.eye, toward);
            if agrees(shown.depth, shown.object, shown.normal, expected) {
                *(if expected.is_some() { &mut count.hits } else { &mut count.misses }) += 1;
            } else if is_seen_beside(&strict, (camera.eye, toward), far, &shown) {
                count.undecided += 1;
            } else {
                count.wrong.push(format!(
                    "{}, view {view}, dot {place}: {shown:?}, expected {expected:?}",
                    nasty.name
                ));
            }
        }
    }
}

#[test]
fn no_dot_of_a_nasty_mesh_is_wrong() {
    let mut count = Count::default();
    for nasty in nasty() {
        // Each ray asks every triangle. An odd number: the middle dot is one.
        look(&nasty, nasty.scene(), (3 * nasty.dots / 4) | 1, &mut count);
    }
    assert!(count.wrong.is_empty(), "{} of them:\n{}", count.wrong.len(), count.wrong.join("\n"));
    // The middle dot of a view looks at a corner, or along an edge or a face: seldom another does.
    assert!(count.undecided <= 30 && count.hits > 5000 && count.misses > 9000, "{count:?}");
}

#[test]
fn no_dot_of_an_open_mesh_is_wrong() {
    let mut count = Count::default();
    for nasty in nasty().iter().filter(|nasty| nasty.mesh.triangles.len() < 700) {
        // An even number: where a ray meets a corner of a surface several triangles are in one place, front
        // ones and back ones, and any of them shows.
        look(nasty, nasty.open_scene(), 12, &mut count);
    }
    assert!(count.wrong.is_empty(), "{} of them:\n{}", count.wrong.len(), count.wrong.join("\n"));
    assert!(count.undecided <= 30 && count.hits > 4000 && count.misses > 5000, "{count:?}");
}
