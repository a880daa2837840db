//! Stage 7, SOLID: the first place along a ray where it meets a surface that bounds no solid.

use crate::math::Ray;
use crate::stage::{Meter, Probe};

use super::crossing::{Crossing, at_start};
use super::primitive::{Form, Primitive};
use super::span::{Departure, End};

/// The first crossing of a surface. It enters where the ray comes against the surface's own normal.
#[inline]
pub fn first_of_surface(
    ray: &Ray,
    primitive: &Primitive,
    index: u32,
    departure: Option<Departure>,
    meter: &mut Meter<impl Probe>,
) -> Option<Crossing> {
    meter.counts.primitive_tests += 1;
    let here = departure.filter(|d| d.primitive == index);
    let crossing = |end: End, entering: bool| Crossing {
        t: end.t,
        error: end.error,
        primitive: index,
        surface: end.surface,
        entering,
    };
    match &primitive.form {
        Form::Face(face) => {
            // A plane is not met again by a ray that leaves it.
            let end = if here.is_some() { None } else { face.crossing(ray) };
            end.filter(|end| !at_start(end)).map(|end| crossing(end, face.normal().dot(ray.d) < 0.0))
        }
        Form::Patch(patch) => {
            let end = if here.is_some() { None } else { patch.face.crossing(ray) };
            end.filter(|end| !at_start(end)).map(|end| crossing(end, patch.face.normal().dot(ray.d) < 0.0))
        }
        Form::Tube(tube) => {
            let found = tube.crossings(ray);
            let ahead = |end: &End| !at_start(end);
            match here {
                None => {
                    let enter = found.enter.filter(ahead).map(|end| crossing(end, true));
                    enter.or_else(|| found.leave.filter(ahead).map(|end| crossing(end, false)))
                }
                // The start is where it went in: what is left is where it comes out, if that is another place.
                Some(departure) if departure.inward && !found.one_way => {
                    found.leave.filter(|end| end.t > 0.0).map(|end| crossing(end, false))
                }
                // Nor is the side of a convex solid by a ray to its outside.
                Some(_) => None,
            }
        }
        _ => None,
    }
}
