//! What `$fn` of 3 to 12 makes of round shapes: the convex solids that OpenSCAD meshes them to.

use std::collections::HashMap;
use std::sync::Arc;

use crate::math::{Bounds, DVec3};
use crate::scene::degrees;
use crate::scene::profile::Fragments;
use crate::scene::{Facets, HalfSpace, Shape};

/// How many sides `$fn` asks for, where it asks for a few: OpenSCAD cuts the number to an integer. Below 3
/// there is no polygon, and above 12 people write `$fn` for smoothness, which exact curves have.
pub fn sides(fragments: Fragments) -> Option<u32> {
    let number = fragments.number;
    (3.0..13.0).contains(&number).then_some(number as u32)
}

/// The faceted solids made so far: a scene has few kinds of them, and many of each.
#[derive(Debug, Default)]
pub struct Polygons {
    known: HashMap<(u32, Profile), Shape>,
}

/// What is turned about the z axis; radii by their bits, so that they can be looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Profile {
    Sphere,
    Cone([u64; 2]),
}

impl Polygons {
    /// OpenSCAD's sphere of radius 1: rings of corners, none of them at the poles.
    pub fn sphere(&mut self, sides: u32) -> Shape {
        self.known.entry((sides, Profile::Sphere)).or_insert_with(|| sphere(sides)).clone()
    }

    /// `|z| ≤ 1` between polygons of circumradius `bottom` and `top`, each with a corner at angle 0.
    pub fn cone(&mut self, sides: u32, bottom: f64, top: f64) -> Shape {
        let profile = Profile::Cone([bottom.to_bits(), top.to_bits()]);
        let new = || turned(sides, &[(bottom, -1.0), (top, 1.0)]);
        self.known.entry((sides, profile)).or_insert_with(new).clone()
    }
}

fn sphere(sides: u32) -> Shape {
    let rings = sides.div_ceil(2);
    let ring = |i: u32| {
        let polar = (f64::from(i) + 0.5) * 180.0 / f64::from(rings);
        (degrees::sin(polar), degrees::cos(polar))
    };
    let profile: Vec<_> = (0..rings).rev().map(ring).collect();
    turned(sides, &profile)
}

/// The convex solid between regular polygons stacked along z: `(circumradius, z)` from below, z rising.
fn turned(sides: u32, profile: &[(f64, f64)]) -> Shape {
    let angle = |steps: f64| steps * 360.0 / f64::from(sides);
    let mut faces = Vec::new();
    if let [(radius, z), ..] = *profile
        && radius > 0.0
    {
        faces.push(HalfSpace { normal: DVec3::NEG_Z, offset: -z });
    }
    // A polygon's sides are nearer to the axis than its corners, by this factor.
    let apothem = degrees::cos(angle(0.5));
    for band in profile.windows(2) {
        let [(lower, low), (upper, high)] = [band[0], band[1]].map(|(radius, z)| (radius * apothem, z));
        for side in 0..sides {
            let middle = angle(f64::from(side) + 0.5);
            let (outward, upward) = (high - low, lower - upper);
            let normal = DVec3::new(outward * degrees::cos(middle), outward * degrees::sin(middle), upward);
            let length = (outward * outward + upward * upward).sqrt();
            let offset = (outward * lower + upward * low) / length;
            faces.push(HalfSpace { normal: normal / length, offset });
        }
    }
    if let [.., (radius, z)] = *profile
        && radius > 0.0
    {
        faces.push(HalfSpace { normal: DVec3::Z, offset: z });
    }
    let corners = profile.iter().flat_map(|&(radius, z)| {
        (0..sides).map(move |side| {
            let at = angle(f64::from(side));
            DVec3::new(radius * degrees::cos(at), radius * degrees::sin(at), z)
        })
    });
    Shape::Facets(Arc::new(Facets { faces, bounds: Bounds::around(corners) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facets(shape: &Shape) -> &Facets {
        match shape {
            Shape::Facets(facets) => facets,
            other => panic!("{other:?}"),
        }
    }

    /// How far `point` is outside; negative inside.
    fn outside(facets: &Facets, point: DVec3) -> f64 {
        facets.faces.iter().map(|face| face.normal.dot(point) - face.offset).fold(f64::NEG_INFINITY, f64::max)
    }

    #[test]
    fn counts_as_openscad_does() {
        assert_eq!(
            [0.0, 2.9, 3.0, 6.7, 12.9, 13.0, -6.0]
                .map(|number| sides(Fragments { number, ..Fragments::default() })),
            [None, None, Some(3), Some(6), Some(12), None, None]
        );
    }

    #[test]
    fn corners_lie_on_the_faces() {
        for sides in 3..=12 {
            for (bottom, top) in [(1.0, 1.0), (1.0, 0.25), (0.0, 1.0), (1.0, 0.0)] {
                let shape = Polygons::default().cone(sides, bottom, top);
                let facets = facets(&shape);
                assert_eq!(facets.faces.len() as u32, sides + u32::from(bottom > 0.0) + u32::from(top > 0.0));
                for side in 0..sides {
                    let angle = f64::from(side) * 360.0 / f64::from(sides);
                    for (radius, z) in [(bottom, -1.0), (top, 1.0)] {
                        let corner =
                            DVec3::new(radius * degrees::cos(angle), radius * degrees::sin(angle), z);
                        assert!(outside(facets, corner).abs() < 1e-15, "{sides} {bottom} {top} {corner}");
                        assert!(facets.bounds.contains(corner));
                    }
                }
                assert!(outside(facets, DVec3::new(0.0, 0.0, bottom.min(top) - bottom.max(top)) * 0.1) < 0.0);
            }
        }
    }

    #[test]
    fn a_sphere_has_rings_between_its_poles() {
        // Corners at polar angles 45° and 135°: a cube would have them elsewhere.
        let shape = sphere(4);
        let half_root = std::f64::consts::FRAC_1_SQRT_2;
        let bounds = facets(&shape).bounds;
        assert!((bounds.hi - DVec3::splat(half_root)).abs().max_element() < 1e-15, "{bounds:?}");
        for sides in 3..=12 {
            let shape = sphere(sides);
            let facets = facets(&shape);
            assert_eq!(facets.faces.len() as u32, 2 + sides * (sides.div_ceil(2) - 1));
            for face in &facets.faces {
                assert!((face.normal.length() - 1.0).abs() < 1e-15);
            }
            assert!(outside(facets, DVec3::X) >= -1e-15 && outside(facets, DVec3::ZERO) < 0.0);
        }
    }
}
