//! Forms that are measured, and the rays that are sent against them.

use ray13::math::{DVec3, Ray};
use ray13::solid::Assembly;

/// Rays along each side of a square of them.
const RAYS: u32 = 16;

/// Convex forms of about radius 1, each by a text of the scene language that gives it and no other.
pub const CONVEX: [(&str, &str); 7] = [
    ("ball", "sphere(1);"),
    ("axis box", "cube(1.6, center = true);"),
    ("skew box", "rotate([20, 30, 40]) cube(1.6, center = true);"),
    ("ellipsoid", "rotate([20, 30, 40]) scale([1, 0.8, 0.6]) sphere(1);"),
    ("cylinder", "rotate([20, 30, 40]) cylinder(h = 1.6, r = 0.8, center = true);"),
    ("cone", "rotate([20, 30, 40]) cylinder(h = 1.6, r1 = 1, r2 = 0, center = true);"),
    ("facets", "rotate([20, 30, 40]) cylinder(h = 1.6, r = 1, center = true, $fn = 6);"),
];

/// Rays from a point in front, in the assembly's coordinates, across a square a little larger than its limit:
/// about half of them meet a round solid.
pub fn rays(assembly: &Assembly) -> Vec<Ray> {
    let (center, reach) = (assembly.limit.center(), assembly.limit.half().max_element());
    let eye = center + DVec3::new(1.0, -4.0, 2.0) * reach;
    let share = |i: u32| 1.3 * (2.0 * (f64::from(i) + 0.5) / f64::from(RAYS) - 1.0);
    let rays = (0..RAYS * RAYS).map(|i| {
        let across = DVec3::new(share(i % RAYS), 0.0, share(i / RAYS));
        Ray::new(eye, (center + across * reach - eye).normalize())
    });
    rays.collect()
}
