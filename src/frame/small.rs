//! Solids so small in the picture that the rays through the middles of dots may all miss them.

use crate::math::{DVec3, Grid, Size};
use crate::solid::Assembly;
use crate::view::PinholeCamera;

/// A solid that is so many dots wide and high has the middle of a dot before it, if it is as thick as its
/// box: a disc of this diameter, the diagonal of a dot, covers one wherever it lies.
const SURELY_SEEN: f64 = std::f64::consts::SQRT_2;

/// Marks the dots before which there is a primitive that the rays through the middles of dots may all miss.
/// Its box says so: a thin rod that runs aslant through a large box is left to luck, and whatever stands
/// before it is not asked about.
pub(super) fn small_solids(
    assembly: &Assembly,
    pinhole: &PinholeCamera,
    eye: DVec3,
    dots: Size,
) -> Grid<bool> {
    let mut marked = Grid::filled(dots, false);
    for primitive in &assembly.primitives {
        let corners = primitive.form.bounds().corners().map(|corner| pinhole.seen_at(corner - eye));
        let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        let around = corners.into_iter().try_fold(nothing, |[least, most], corner| {
            let corner = corner?;
            let by_axis = |pick: fn(f64, f64) -> f64, end: [f64; 2]| {
                std::array::from_fn(|axis| pick(end[axis], corner[axis]))
            };
            Some([by_axis(f64::min, least), by_axis(f64::max, most)])
        });
        // What reaches behind the eye is not small.
        let Some([[left, top], [right, bottom]]) = around else { continue };
        if (right - left).min(bottom - top) >= SURELY_SEEN {
            continue;
        }
        // From the first dot that it touches to the last; negative numbers and those beyond end at the rim.
        let within = |from: f64, to: f64, end: u32| from.floor() as u32..(to.ceil().max(0.0) as u32).min(end);
        for row in within(top, bottom, dots.height) {
            for column in within(left, right, dots.width) {
                marked[(column, row)] = true;
            }
        }
    }
    marked
}
