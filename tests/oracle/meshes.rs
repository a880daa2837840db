//! The tracer against the oracle's calculation, on meshes that are hard on it: needles, fans, coplanar
//! neighbours, shells in one place, from outside, from inside, along edges and along faces.

use crate::support::nasty_meshes::nasty;
use crate::support::oracle::{Oracle, Wide};
use crate::support::oracle_agreement::compare;
use ray13::frame::Studio;
use ray13::math::Size;

#[test]
fn no_dot_of_a_nasty_mesh_is_wrong() {
    let (mut faults, mut hits) = (Vec::new(), 0);
    for nasty in nasty() {
        let studio = Studio::new(nasty.scene()).unwrap();
        let oracle = Oracle::<Wide>::new(studio.scene());
        for (view, camera) in nasty.cameras().iter().enumerate() {
            let comparison = compare(&studio, &oracle, camera, Size::new(nasty.dots, nasty.dots));
            hits += comparison.hits;
            if !comparison.faults.is_empty() {
                faults.push(format!("{}, view {view}: {}", nasty.name, comparison.first_faults()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(hits > 5000, "{hits}");
}
