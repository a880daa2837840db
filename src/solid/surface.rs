//! Stage 7, SOLID: the first place along a ray where it meets a surface that bounds no solid.

use crate::math::{Number, Ray, Rays};
use crate::stage::{Meter, Probe, RayEvent};

use super::crossing::{Crossing, FirstCrossings, RayStarts, at_start};
use super::primitive::{WorldPrimitive, WorldShape};
use super::span::{Departure, End, Ends};
use super::tube::{SideCrossings, Tube};

/// The first crossing of a surface. It enters where the ray comes against the surface's own normal.
#[inline]
pub fn first_of_surface(
    ray: &Ray,
    primitive: &WorldPrimitive,
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
    let at_start = |end: &End| at_start(end, &primitive.form, departure);
    let found = match &primitive.form {
        WorldShape::Face(face) => {
            // A plane is not met again by a ray that leaves it.
            let end = if here.is_some() { None } else { face.crossing(ray) };
            end.filter(|end| !at_start(end)).map(|end| crossing(end, face.normal().dot(ray.d) < 0.0))
        }
        WorldShape::Sheet(sheet) => {
            let end = sheet.first_crossing(ray, here.map(|d| d.surface), |end| at_start(end));
            end.map(|end| crossing(end, sheet.normal(end.surface).dot(ray.d) < 0.0))
        }
        WorldShape::Patch(patch) => {
            let end = if here.is_some() { None } else { patch.face.crossing(ray) };
            end.filter(|end| !at_start(end)).map(|end| crossing(end, patch.face.normal().dot(ray.d) < 0.0))
        }
        WorldShape::Tube(tube) => {
            let starts = RayStarts {
                here: here.is_some(),
                inward: here.is_some_and(|d| d.inward),
                place_error: departure.map(|d| d.place_error),
            };
            let first = firsts_of_tube(&Rays::from(ray), tube, &primitive.form, &starts);
            first.any.then(|| crossing(first.end.one(), first.entering))
        }
        // It may be met again by a ray that leaves it, elsewhere.
        WorldShape::Bezier(patches) => {
            let mut first: Option<End> = None;
            patches.crossings(ray, |end| {
                if !at_start(&end) && first.is_none_or(|first| end.t < first.t) {
                    first = Some(end);
                }
            });
            let enters = |end: &End| patches.normal(ray.at(end.t), end.surface).dot(ray.d) < 0.0;
            first.map(|end| crossing(end, enters(&end)))
        }
        _ => None,
    };
    meter.record(|| RayEvent::Tested { primitive: index, span: found.map(|crossing| [crossing.t; 2]) });
    found
}

/// The first crossings of a tube, which is the form itself.
#[inline(always)]
pub(super) fn firsts_of_tube<N: Number>(
    rays: &Rays<N>,
    tube: &Tube,
    form: &WorldShape,
    starts: &RayStarts<N>,
) -> FirstCrossings<N> {
    firsts_of_sides(tube.crossings(rays), form, starts)
}

/// The same, given where the lines cross the tube.
#[inline(always)]
pub(super) fn firsts_of_sides<N: Number>(
    found: SideCrossings<N>,
    form: &WorldShape,
    starts: &RayStarts<N>,
) -> FirstCrossings<N> {
    let (enter, leave) = (&found.enter, &found.leave);
    let enter_ahead = !starts.before(enter, form);
    let leave_ahead = !starts.before(leave, form);
    let entering = !starts.here & found.enters & enter_ahead;
    // A ray that starts on the tube went in there: what is left is where it comes out, if that is another
    // place. A ray to the outside of a convex solid does not meet its side again.
    let other = starts.inward & !found.one_way & leave.t.is_above(leave.t.same(0.0));
    let leaving = found.leaves & ((starts.here & other) | (!starts.here & leave_ahead));
    FirstCrossings {
        end: Ends::choose(entering, found.enter, found.leave),
        entering,
        any: entering | leaving,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::math::{DAffine3, DVec3};
    use crate::scene::{Material, MaterialId, Object, Primitive as Part, Scene, Shape, Solid};
    use crate::solid::{Assembly, AssemblyError};
    use crate::stage::Silent;

    fn part(shape: Shape) -> Solid {
        Solid::Primitive(Part::new(shape, DAffine3::IDENTITY, MaterialId(0)))
    }

    fn scene(solid: Solid) -> Scene {
        let objects = vec![Object { name: None, solid }];
        Scene { objects, materials: vec![Material::default()], ..Scene::default() }
    }

    fn first(shape: Shape, o: [f64; 3], d: [f64; 3], inward: Option<bool>) -> Option<(f64, bool)> {
        let assembly = Assembly::new(&scene(part(shape))).unwrap();
        let ray = assembly.ray(&Ray::new(o.into(), DVec3::from(d).normalize()));
        let departure = inward.map(|inward| Departure { primitive: 0, surface: 0, inward, place_error: 0.0 });
        let mut meter = Meter::new(Silent);
        let found = first_of_surface(&ray, &assembly.primitives[0], 0, departure, &mut meter)?;
        Some((found.t * assembly.scene_frame.unit, found.entering))
    }

    fn face(corners: &[[f64; 3]]) -> Shape {
        Shape::Face(corners.iter().map(|&p| DVec3::from(p)).collect())
    }

    const CYLINDER: Shape = Shape::Tube { bottom: 1.0, top: 1.0 };
    const CONE: Shape = Shape::Tube { bottom: 1.0, top: 0.0 };

    #[test]
    fn a_tube_is_open_and_has_an_inside_wall() {
        assert_eq!(first(CYLINDER, [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0], None), Some((2.0, true)));
        assert_eq!(first(CYLINDER, [0.0, 0.0, 0.5], [1.0, 0.0, 0.0], None), Some((1.0, false)));
        assert_eq!(first(CYLINDER, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], None), None);
        // In through the open end, out through the wall.
        let (t, entering) = first(CYLINDER, [0.0, 0.0, 2.0], [1.0, 0.0, -2.0], None).unwrap();
        assert!((t - 5_f64.sqrt()).abs() < 1e-15 && !entering);
        assert_eq!(first(CYLINDER, [-3.0, 0.0, 1.5], [1.0, 0.0, 0.0], None), None);
    }

    #[test]
    fn a_cone_is_met_by_lines_steeper_than_its_side() {
        let (t, entering) = first(CONE, [0.25, 0.0, 5.0], [0.0, 0.0, -1.0], None).unwrap();
        assert!((t - 4.5).abs() < 1e-14 && entering);
        let (t, entering) = first(CONE, [0.25, 0.0, -5.0], [0.0, 0.0, 1.0], None).unwrap();
        assert!((t - 5.5).abs() < 1e-14 && !entering);
        // Parallel to the side, within the cone.
        assert_eq!(first(CONE, [0.5, 0.0, -1.0], [1.0, 0.0, -2.0], None), None);
        let (_, entering) = first(CONE, [-1.0, 0.0, 0.0], [1.0, 0.0, -2.0], None).unwrap();
        assert!(entering);
    }

    #[test]
    fn a_ray_that_leaves_a_tube_meets_it_only_on_the_far_side() {
        let wall = [1.0, 0.0, 0.0];
        assert_eq!(first(CYLINDER, wall, [1.0, 0.3, 0.2], Some(false)), None);
        let (t, entering) = first(CYLINDER, wall, [-1.0, 0.0, 0.0], Some(true)).unwrap();
        assert!((t - 2.0).abs() < 1e-14 && !entering);
        assert_eq!(first(CYLINDER, wall, [-1.0, 0.0, 2.0], Some(true)), None);
        // Into a cone, steeper than its side: it leaves through the open end.
        assert_eq!(first(CONE, [0.5, 0.0, 0.0], [-0.1, 0.0, -1.0], Some(true)), None);
    }

    #[test]
    fn a_face_is_met_from_both_sides_and_never_left_into_itself() {
        let square = || face(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]]);
        assert_eq!(first(square(), [1.0, 0.5, 3.0], [0.0, 0.0, -1.0], None), Some((3.0, true)));
        assert_eq!(first(square(), [1.0, 0.5, -3.0], [0.0, 0.0, 1.0], None), Some((3.0, false)));
        assert_eq!(first(square(), [1.0, 0.5, 3.0], [0.0, 0.0, 1.0], None), None);
        assert_eq!(first(square(), [1.0, 0.5, 0.0], [0.0, 0.6, 1.0], Some(true)), None);
        assert_eq!(first(square(), [-1.0, 0.5, 0.0], [1.0, 0.0, 0.0], None), None);
    }

    #[test]
    fn a_concave_face_has_its_notch() {
        let outline: [[f64; 3]; 5] =
            [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [2.0, 1.0, 1.0], [0.0, 4.0, 1.0]];
        let down = |x: f64, y: f64| first(face(&outline), [x, y, 5.0], [0.0, 0.0, -1.0], None).is_some();
        assert!(down(0.5, 3.0) && down(3.5, 3.0) && down(2.0, 0.5));
        assert!(!down(2.0, 1.5) && !down(2.0, 3.0) && !down(-0.5, 1.0));
    }

    #[test]
    fn faces_with_common_edges_share_every_line_among_them() {
        // A sheet of bent quadrilaterals and their halves, on points that are no round numbers.
        let at = |i: i32, j: i32| {
            let (x, y) = (f64::from(i), f64::from(j));
            DVec3::new(x / 7.0 + 0.01 * y, y / 7.0 - 0.02 * x, 0.03 * libm::sin(3.0 * x + 5.0 * y))
        };
        let mut solids = Vec::new();
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let faces: &[&[DVec3]] =
                if (i + j) % 2 == 0 { &[&[a, b, c, d]] } else { &[&[a, b, c], &[a, c, d]] };
            solids.extend(faces.iter().map(|&corners| part(Shape::Face(Arc::from(corners)))));
        }
        let objects = solids.into_iter().map(|solid| Object { name: None, solid }).collect();
        let assembly = Assembly::new(&Scene { objects, ..Scene::default() }).unwrap();
        let eye = DVec3::new(0.31, 0.77, 4.0);
        for (i, j) in (1..8).flat_map(|i| (1..8).map(move |j| (i, j))) {
            // Through corners, through the middles of edges, and along the axis.
            for target in [at(i, j), 0.5 * at(i, j) + 0.5 * at(i + 1, j), 0.5 * at(i, j) + 0.5 * at(i, j + 1)]
            {
                for (o, d) in [(eye, (target - eye).normalize()), (target + DVec3::Z, DVec3::NEG_Z)] {
                    let ray = assembly.ray(&Ray::new(o, d));
                    let meets = |p: &&WorldPrimitive| {
                        first_of_surface(&ray, p, 0, None, &mut Meter::new(Silent)).is_some()
                    };
                    assert_eq!(assembly.primitives.iter().filter(meets).count(), 1, "{i} {j} {o} {d}");
                }
            }
        }
    }

    #[test]
    fn a_face_of_many_corners_is_a_disc_with_teeth() {
        let corner = |i: u32| {
            let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 10_000.0);
            DVec3::new(cos, sin, 0.0) * if i.is_multiple_of(2) { 1.0 } else { 0.9 }
        };
        let gear: Vec<DVec3> = (0..10_000).map(corner).collect();
        let assembly = Assembly::new(&scene(part(Shape::Face(Arc::from(&gear[..]))))).unwrap();
        let meets = |x: f64, y: f64| {
            let ray = assembly.ray(&Ray::new(DVec3::new(x, y, 3.0), DVec3::NEG_Z));
            first_of_surface(&ray, &assembly.primitives[0], 0, None, &mut Meter::new(Silent)).is_some()
        };
        for i in 0..10_000 {
            let direction = corner(i).normalize();
            let (inside, tooth) = (direction * 0.89, direction * 0.95);
            assert!(meets(inside.x, inside.y));
            assert_eq!(meets(tooth.x, tooth.y), i.is_multiple_of(2), "{i}");
            assert!(!meets(1.01 * direction.x, 1.01 * direction.y));
        }
    }

    #[test]
    fn a_surface_is_no_operand() {
        let both = vec![part(Shape::Cube), part(CYLINDER)];
        for solid in [Solid::Union(both.clone()), Solid::Intersection(both.clone()), Solid::Difference(both)]
        {
            let expected = AssemblyError::SurfaceInOperation { object: 1, primitive: 2 };
            assert_eq!(Assembly::new(&scene(solid)).unwrap_err(), expected);
        }
        assert!(Assembly::new(&scene(Solid::Union(vec![part(CONE)]))).is_ok());
    }

    #[test]
    fn sizes_stay_small_for_scenes_of_millions() {
        // 700 bytes for a sphere in all: the scene's object, the assembly's, its primitive, and the
        // structure.
        assert!(size_of::<Object>() <= 160);
        assert!(size_of::<WorldPrimitive>() + size_of::<crate::solid::WorldObject>() <= 160);
    }
}
