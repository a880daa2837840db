//! One convex primitive and one line: where the line is inside, and how nearly it is not.

use ray13::math::{DVec3, Ray};
use ray13::scene::{Primitive, Shape};

use super::number::{Number, cross, dot};
use super::side::{Row, Side, along, direction, inverse, place, point, sides};

/// One end of a chord.
#[derive(Clone, Debug)]
pub struct End<N> {
    /// Where it is, in lengths of the ray's direction.
    pub t: N,
    /// The number of the face, as the program numbers them.
    pub face: u32,
    /// The tangent of the angle between the ray and the face's normal in the primitive's own coordinates: how
    /// much farther along the ray the end moves than the face does. `l / √(1 − l²)` on a sphere.
    pub tangent: f64,
}

/// The part of a line that is inside a convex primitive.
#[derive(Clone, Debug)]
pub struct Chord<N> {
    pub enter: End<N>,
    pub leave: End<N>,
}

/// What a ray and a primitive come to when the primitive may be off by a little in its own coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The ray meets it wherever it is.
    Hit,
    /// The ray misses it wherever it is.
    Miss,
    /// It passes too near the rim to say.
    Either,
}

/// Where the line of the ray is inside a convex primitive. None where it only touches it.
pub fn chord<N: Number>(primitive: &Primitive, ray: &Ray) -> Option<Chord<N>> {
    chord_of_line(primitive, &point(ray.o), &direction(ray.d))
}

fn chord_of_line<N: Number>(primitive: &Primitive, o: &Row<N>, d: &Row<N>) -> Option<Chord<N>> {
    let sides: Vec<Side<N>> = sides(&primitive.shape, &primitive.map);
    let mut ends: Vec<(N, usize)> = Vec::new();
    for (face, side) in sides.iter().enumerate() {
        ends.extend(side.crossings(o, d).into_iter().map(|t| (t, face)));
    }
    ends.sort_by(|a, b| a.0.partial_cmp(&b.0).expect("roots are numbers"));
    let half = N::from(0.5);
    let is_inside = |pair: &[(N, usize)]| {
        let middle = (pair[0].0.clone() + pair[1].0.clone()) * half.clone();
        let p = along(o, d, &middle);
        pair[0].0 < pair[1].0 && sides.iter().all(|side| side.at(&p).sign() <= 0)
    };
    let inside: Vec<&[(N, usize)]> = ends.windows(2).filter(|pair| is_inside(pair)).collect();
    let end = |(t, face): &(N, usize)| {
        let outward = sides[*face].gradient(&along(o, d, t));
        End { t: t.clone(), face: *face as u32, tangent: tangent(primitive, d, &outward) }
    };
    Some(Chord { enter: end(&inside.first()?[0]), leave: end(&inside.last()?[1]) })
}

/// The tangent of the angle between a direction and a gradient, both given in the world, in the primitive's
/// own coordinates.
fn tangent<N: Number>(primitive: &Primitive, d: &Row<N>, outward: &[N; 3]) -> f64 {
    let d: [N; 3] = inverse::<N>(&primitive.map).map(|row| dot(&row, d));
    let matrix = primitive.map.matrix3;
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|c| c.to_array().map(N::from));
    let normal = columns.map(|column| dot(&column, outward));
    let (across, along) = (cross(&d, &normal), dot(&d, &normal).abs());
    if along.is_zero() { f64::INFINITY } else { (dot(&across, &across).sqrt() / along).value() }
}

/// Whether the ray, from its start on, must meet the primitive, must miss it, or neither, when the primitive
/// may lie as far as `off` from its place along each axis of its own coordinates: it is put to the corners of
/// that box.
pub fn verdict<N: Number>(primitive: &Primitive, ray: &Ray, off: DVec3) -> Verdict {
    let (o, d): (Row<N>, Row<N>) = (point(ray.o), direction(ray.d));
    let matrix = primitive.map.matrix3;
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|c| direction::<N>(c));
    let corner = |n: u32| {
        // The ray moves instead.
        let signs = [1, 2, 4].map(|bit| if n & bit == 0 { 1.0 } else { -1.0 });
        (0..3).fold(o.clone(), |p, i| along(&p, &columns[i], &N::from(signs[i] * off[i])))
    };
    let ahead = |o: &Row<N>| chord_of_line(primitive, o, &d).is_some_and(|c| c.leave.t.sign() > 0);
    let here = ahead(&o);
    match (0..8).all(|n| ahead(&corner(n)) == here) {
        false => Verdict::Either,
        true if here => Verdict::Hit,
        true => Verdict::Miss,
    }
}

/// How far a line passes from the middle of a curved surface, as a share of what it may without missing it:
/// below 1 it crosses the surface, at 1 it touches its silhouette.
///
/// For a sphere or ellipsoid it is the distance from the centre in the unit space. For the side of a
/// truncated cone, extended beyond its caps, it is `|dₓo_y − d_yo_x|` over `|d ρ − ρ′ o|` in the
/// cross-section, where `ρ` is the radius at the start and `ρ′` its change along the direction: both are the
/// same from every point of the line, and for a cylinder their quotient is the distance from the axis in
/// radii.
pub fn silhouette<N: Number>(primitive: &Primitive, ray: &Ray) -> Option<f64> {
    let rows = inverse::<N>(&primitive.map);
    let (world_o, world_d): (Row<N>, Row<N>) = (point(ray.o), direction(ray.d));
    let o: [N; 3] = std::array::from_fn(|i| dot(&rows[i], &world_o));
    let d: [N; 3] = std::array::from_fn(|i| dot(&rows[i], &world_d));
    match &primitive.shape {
        Shape::Sphere => {
            let across = cross(&o, &d);
            Some((dot(&across, &across) / dot(&d, &d)).sqrt().value())
        }
        Shape::Cone { bottom, top } | Shape::Tube { bottom, top } => {
            let (half, bottom, top) = (N::from(0.5), N::from(*bottom), N::from(*top));
            let slope = half.clone() * (top.clone() - bottom.clone());
            let rho = half * (top + bottom) + slope.clone() * o[2].clone();
            let change = slope * d[2].clone();
            let across = (d[0].clone() * o[1].clone() - d[1].clone() * o[0].clone()).abs();
            let along: [N; 2] =
                std::array::from_fn(|i| d[i].clone() * rho.clone() - change.clone() * o[i].clone());
            let along = dot(&along, &along).sqrt();
            // Along the axis of a cylinder nothing is crossed.
            (!along.is_zero()).then(|| (across / along).value())
        }
        _ => None,
    }
}

/// The point of the ray at `t`, rounded once.
pub fn point_at<N: Number>(ray: &Ray, t: &N) -> DVec3 {
    DVec3::from_array(place(&along(&point(ray.o), &direction(ray.d), t)).map(|x: N| x.value()))
}
