//! Which way round the triangles of a mesh go. To rays it is all the same; who works out surfaces asks for
//! it.

use std::collections::HashMap;

use crate::math::DVec3;

/// Meshes in more parts than this are not turned: each is held against all others.
const MOST_PARTS: usize = 64;

/// A direction along which no edge of a mesh as people make them lies.
const ODD: DVec3 = DVec3::new(0.481_753, 0.300_461, 0.823_197);

/// The triangles of a closed mesh, each counter-clockwise seen from outside; none where that can not be, as
/// on Klein's bottle, and of more than 64 parts that do not hang together.
pub fn oriented(points: &[DVec3], triangles: &[[u32; 3]]) -> Option<Vec<[u32; 3]>> {
    let mut edges = HashMap::<[u32; 2], Vec<usize>>::new();
    let sides = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    for (number, &triangle) in triangles.iter().enumerate() {
        for [a, b] in sides(triangle) {
            edges.entry([a.min(b), a.max(b)]).or_default().push(number);
        }
    }
    let mut turned = triangles.to_vec();
    // By triangle: the number of its part.
    let mut parts = vec![usize::MAX; triangles.len()];
    let mut count = 0;
    for first in 0..triangles.len() {
        if parts[first] != usize::MAX {
            continue;
        }
        let mut open = vec![first];
        parts[first] = count;
        while let Some(number) = open.pop() {
            for [a, b] in sides(turned[number]) {
                // Where four meet in an edge, two parts touch.
                let [one, two] = edges[&[a.min(b), a.max(b)]][..] else { continue };
                let next = if one == number { two } else { one };
                let is_against = sides(turned[next]).contains(&[b, a]);
                if parts[next] == usize::MAX {
                    parts[next] = count;
                    if !is_against {
                        turned[next].swap(1, 2);
                    }
                    open.push(next);
                } else if !is_against {
                    return None;
                }
            }
        }
        count += 1;
        if count > MOST_PARTS {
            return None;
        }
    }
    let corners = |triangle: [u32; 3]| triangle.map(|i| points[i as usize]);
    for part in 0..count {
        let own = || (0..turned.len()).filter(|&number| parts[number] == part);
        let volume: f64 =
            own().map(|number| corners(turned[number])).map(|[a, b, c]| a.dot(b.cross(c))).sum();
        let [a, b, c] = corners(turned[own().next()?]);
        let from = (a + b + c) / 3.0;
        let others = (0..turned.len()).filter(|&number| parts[number] != part);
        let crossed = others.filter(|&number| is_crossed(from, corners(triangles[number]))).count();
        // What lies within an odd number of others is a hollow.
        if (volume < 0.0) != (crossed % 2 == 1) {
            for number in 0..turned.len() {
                if parts[number] == part {
                    turned[number].swap(1, 2);
                }
            }
        }
    }
    Some(turned)
}

/// Whether a ray along [`ODD`] meets a triangle.
fn is_crossed(from: DVec3, corners: [DVec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner - from);
    let [p, q, r] = [b.cross(c).dot(ODD), c.cross(a).dot(ODD), a.cross(b).dot(ODD)];
    let is_within = (p > 0.0 && q > 0.0 && r > 0.0) || (p < 0.0 && q < 0.0 && r < 0.0);
    is_within && (a * p + b * q + c * r).dot(ODD) / (p + q + r) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of this edge about the origin, its sides turned at random.
    fn cube(edge: f64, first: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let corner = |i: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(i >> axis & 1) - 0.5)) * edge;
        let sides = [[0, 2, 3, 1], [4, 6, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 4, 6, 2], [1, 3, 7, 5]];
        let halves = sides.iter().flat_map(|&[a, b, c, d]| [[a, c, b], [a, c, d]]);
        ((0..8).map(corner).collect(), halves.map(|half| half.map(|i: u32| i + first)).collect())
    }

    fn volume(points: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let signed = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| points[i as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        triangles.iter().map(signed).sum()
    }

    #[test]
    fn a_shell_within_a_shell_is_a_hollow() {
        let (mut points, mut triangles) = cube(2.0, 0);
        assert!((volume(&points, &oriented(&points, &triangles).expect("a cube")) - 8.0).abs() < 1e-12);
        let (inner, more) = cube(1.0, 8);
        points.extend(inner);
        triangles.extend(more);
        assert!((volume(&points, &oriented(&points, &triangles).expect("two")) - 7.0).abs() < 1e-12);
    }

    #[test]
    fn a_strip_with_a_twist_has_no_outside() {
        let corner = |i: u32| i % 6;
        let strip: Vec<[u32; 3]> =
            (0..5).map(|i| [corner(i), corner(i + 1), corner(i + 2)]).chain([[5, 1, 0], [0, 4, 5]]).collect();
        let points: Vec<DVec3> = (0..6).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 1.0)).collect();
        // Whatever it is, it is an answer.
        let _ = oriented(&points, &strip);
        // The projective plane of six corners.
        let plane = [
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 5],
            [0, 5, 1],
            [1, 2, 4],
            [2, 3, 5],
            [3, 4, 1],
            [4, 5, 2],
            [5, 1, 3],
        ];
        assert_eq!(oriented(&points, &plane), None);
    }
}
