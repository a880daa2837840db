//! The picture geometry: the direction of the ray through each dot.

use crate::math::{DVec3, Number, Ray, Size, Vector};
use crate::scene::{Camera, FieldSpan};

/// The largest tangent of half an angle. From 1e16 on the angle is 180° within rounding; this leaves room for
/// the square of a tangent that the other one's aspect multiplies.
const WIDEST: f64 = 1e100;

/// The raster of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Traced dots across and down.
    pub dots: Size,
    /// Width of a dot on the screen divided by its height, above 0.
    pub dot_aspect: f64,
}

impl Picture {
    /// Width of the picture on the screen divided by its height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.dots.width) / f64::from(self.dots.height) * self.dot_aspect
    }
}

/// A camera and a picture, made ready to give rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinholeCamera {
    /// The viewpoint.
    pub eye: DVec3,
    /// Along the line of sight, length 1.
    pub forward: DVec3,
    /// To the right in the picture, length 1.
    pub right: DVec3,
    /// Upwards in the picture, length 1.
    pub up: DVec3,
    /// Distance from the eye to its target.
    pub focus: f64,
    /// Tangents of half the angles across and down.
    pub tangents: [f64; 2],
    dots: Size,
}

impl PinholeCamera {
    /// The pinhole camera of a camera for a picture. The camera's field is contained: the other angle widens
    /// until dots are as wide as high on the screen.
    pub fn new(camera: &Camera, picture: &Picture) -> Self {
        let sight = camera.target - camera.eye;
        // Scaled first, so that no square overflows or vanishes.
        let size = sight.abs().max_element();
        let length = (sight / size).length();
        let forward = sight / size / length;
        // From what the camera says, not from `forward`, whose rounding is all that would be left of the
        // product where `up` is nearly along the sight: so `right` is square to both.
        let right = cross(scaled(sight), scaled(camera.up));
        let right = scaled(right).normalize_or(forward.any_orthonormal_vector());
        let Size { width, height } = picture.dots;
        let half = |degrees: f64, dots: u32| {
            (libm::tan(0.5 * degrees.to_radians()) / camera.zoom * reach(camera.span, dots)).min(WIDEST)
        };
        let (tx, ty) = (half(camera.field[0], width), half(camera.field[1], height));
        let aspect = picture.aspect();
        let tangents = if tx > ty * aspect { [tx, tx / aspect] } else { [ty * aspect, ty] };
        Self {
            eye: camera.eye,
            forward,
            right,
            up: right.cross(forward),
            focus: (size * length).min(f64::MAX),
            tangents,
            dots: picture.dots,
        }
    }

    /// The ray through a point of the picture, in dots from its upper left corner: dot (i, j) spans
    /// `i..i + 1`, `j..j + 1`, and its middle is at (i + ½, j + ½).
    #[inline]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let d = self.directions(x, y);
        Ray::new(self.eye, DVec3::new(d.x, d.y, d.z))
    }

    /// The directions, of length 1, through one point of the picture or through several, as for
    /// [`PinholeCamera::ray`].
    #[inline(always)]
    pub fn directions<N: Number>(&self, x: N, y: N) -> Vector<N> {
        self.upward(self.across(x), self.height(y))
    }

    /// The directions of columns of the picture, before their rows move them: not of length 1.
    #[inline(always)]
    pub fn across<N: Number>(&self, x: N) -> Vector<N> {
        let across = (x * 2.0 / f64::from(self.dots.width) - 1.0) * self.tangents[0];
        let like = Vector { x, y: x, z: x };
        like.same(self.right) * across + like.same(self.forward)
    }

    /// How far above the middle a row lies, as a tangent.
    #[inline(always)]
    pub fn height<N: Number>(&self, y: N) -> N {
        (-(y * 2.0 / f64::from(self.dots.height)) + 1.0) * self.tangents[1]
    }

    /// The directions, of length 1, of dots by their columns and rows.
    #[inline(always)]
    pub fn upward<N: Number>(&self, across: Vector<N>, height: N) -> Vector<N> {
        let d = across + across.same(self.up) * height;
        d * (height.same(1.0) / d.length())
    }

    /// Where in the picture a point is seen that lies so far from the eye, in dots from the upper left
    /// corner; none where it is not in front of the eye. The inverse of [`PinholeCamera::ray`].
    pub fn seen_at(&self, from_eye: DVec3) -> Option<[f64; 2]> {
        let depth = from_eye.dot(self.forward);
        let Size { width, height } = self.dots;
        let [across, down] = self.tangents;
        let x = from_eye.dot(self.right) / depth / across;
        let y = from_eye.dot(self.up) / depth / down;
        (depth > 0.0).then(|| [0.5 * (1.0 + x) * f64::from(width), 0.5 * (1.0 - y) * f64::from(height)])
    }

    /// How wide or high a dot is at a distance of 1 from the eye at least, whichever is less.
    pub fn least_dot(&self) -> f64 {
        let Size { width, height } = self.dots;
        let [x, y] = self.tangents;
        // Dots are even on a plane across the line of sight: in a corner it is farther away, and seen aslant.
        let slant = 1.0 + x * x + y * y;
        (2.0 * x / f64::from(width)).min(2.0 * y / f64::from(height)) / slant
    }

    /// The full angles of the field across and down, in degrees.
    pub fn field(&self) -> [f64; 2] {
        self.tangents.map(|t| 2.0 * libm::atan(t).to_degrees())
    }

    /// The place of a point given in (right, up, back), in units of the distance to the target; the nearest
    /// that numbers can hold.
    pub fn place(&self, p: DVec3) -> DVec3 {
        let place = self.eye + self.focus * (p.x * self.right + p.y * self.up - p.z * self.forward);
        place.clamp(DVec3::MIN, DVec3::MAX)
    }
}

/// The vector by the power of two, if any, that brings its largest component into `1..2`. That rounds nothing
/// but what vanishes beside the largest.
fn scaled(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest == 0.0 || !largest.is_finite() {
        return v;
    }
    let exponent = libm::ilogb(largest);
    DVec3::from_array(v.to_array().map(|x| libm::scalbn(x, -exponent)))
}

/// The cross product, each component within 1.5 units in its last place however much its two products cancel
/// (Kahan's difference of products; Jeannerod, Louvet, Muller: Further analysis of Kahan's algorithm for the
/// accurate computation of 2 × 2 determinants, Mathematics of Computation 2013).
fn cross(a: DVec3, b: DVec3) -> DVec3 {
    let difference = |p: f64, q: f64, r: f64, s: f64| {
        let subtrahend = r * s;
        libm::fma(p, q, -subtrahend) + libm::fma(-r, s, subtrahend)
    };
    DVec3::new(difference(a.y, b.z, a.z, b.y), difference(a.z, b.x, a.x, b.z), difference(a.x, b.y, a.y, b.x))
}

/// How far the edge of a picture lies from its middle, in units of how far that lies which the camera's angle
/// spans. Of a single row its centre is the middle itself, and the angle can only be that of its edges.
fn reach(span: FieldSpan, dots: u32) -> f64 {
    match span {
        FieldSpan::Centers if dots > 1 => f64::from(dots) / f64::from(dots - 1),
        FieldSpan::Centers | FieldSpan::Edges => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(field: [f64; 2]) -> Camera {
        Camera {
            name: None,
            eye: DVec3::new(0.0, -5.0, 0.0),
            target: DVec3::ZERO,
            up: DVec3::Z,
            field,
            span: FieldSpan::Edges,
            zoom: 1.0,
        }
    }

    #[test]
    fn the_field_is_contained_and_dots_are_square() {
        let wide = Picture { dots: Size::new(200, 50), dot_aspect: 1.0 };
        let pinhole = PinholeCamera::new(&camera([40.0, 25.0]), &wide);
        assert!((pinhole.field()[1] - 25.0).abs() < 1e-12 && pinhole.field()[0] > 40.0);
        assert!((pinhole.tangents[0] / 200.0 - pinhole.tangents[1] / 50.0).abs() < 1e-15);
        let tall = Picture { dots: Size::new(50, 200), dot_aspect: 1.0 };
        let pinhole = PinholeCamera::new(&camera([40.0, 25.0]), &tall);
        assert!((pinhole.field()[0] - 40.0).abs() < 1e-12 && pinhole.field()[1] > 25.0);
    }

    #[test]
    fn a_point_is_seen_where_its_ray_passes() {
        let picture = Picture { dots: Size::new(160, 100), dot_aspect: 0.5 };
        let pinhole = PinholeCamera::new(&camera([40.0, 25.0]), &picture);
        for [x, y] in [[80.0, 50.0], [0.0, 0.0], [159.5, 3.25]] {
            let [i, j] = pinhole.seen_at(pinhole.ray(x, y).d * 7.0).unwrap();
            assert!((i - x).abs() < 1e-9 && (j - y).abs() < 1e-9, "{i} {j}");
        }
        assert_eq!(pinhole.seen_at(-pinhole.forward), None);
    }

    #[test]
    fn the_middle_looks_forward_and_x_goes_right() {
        let pinhole = PinholeCamera::new(
            &camera([40.0, 25.0]),
            &Picture { dots: Size::new(160, 100), dot_aspect: 1.0 },
        );
        assert_eq!(pinhole.ray(80.0, 50.0).d, DVec3::Y);
        assert!(pinhole.ray(160.0, 50.0).d.x > 0.0);
        assert!(pinhole.ray(80.0, 0.0).d.z > 0.0);
    }

    #[test]
    fn an_angle_between_centers_is_that_of_the_outermost_dots() {
        let across = Camera { span: FieldSpan::Centers, ..camera([45.0, 45.0]) };
        for dots in [Size::new(513, 513), Size::new(2, 2), Size::new(1, 1)] {
            let pinhole = PinholeCamera::new(&across, &Picture { dots, dot_aspect: 1.0 });
            let [first, last] = [0.5, f64::from(dots.width) - 0.5].map(|x| pinhole.ray(x, 0.5).d);
            let tangent = |d: DVec3| d.dot(pinhole.right) / d.dot(pinhole.forward);
            let expected = if dots.width > 1 { libm::tan(22.5_f64.to_radians()) } else { 0.0 };
            assert!((tangent(first) + expected).abs() < 1e-15, "{dots:?}");
            assert!((tangent(last) - expected).abs() < 1e-15, "{dots:?}");
        }
    }

    #[test]
    fn zoom_divides_both_tangents() {
        let picture = Picture { dots: Size::new(160, 100), dot_aspect: 1.0 };
        let plain = PinholeCamera::new(&camera([40.0, 25.0]), &picture);
        let near = PinholeCamera::new(&Camera { zoom: 2.0, ..camera([40.0, 25.0]) }, &picture);
        assert_eq!(plain.tangents.map(|t| t / 2.0), near.tangents);
    }

    // Within 1e-14 of the sight, `up` gave a `right` that was off square by a hundredth: its cross product
    // with `forward` was rounding.
    #[test]
    fn right_up_and_forward_are_square_however_near_up_is_to_the_sight() {
        for off in [1e-1, 1e-7, 1e-12, 1e-14, 4e-15, 1e-200] {
            for sight in [DVec3::new(0.3, 0.7, -0.2), DVec3::new(1e-3, -5.0, 2e200), DVec3::splat(1.0 / 3.0)]
            {
                let picture = Picture { dots: Size::new(16, 10), dot_aspect: 1.0 };
                let up = sight / sight.abs().max_element() + off * DVec3::new(0.9, -0.4, 0.1);
                let camera = Camera { eye: DVec3::ZERO, target: sight, up, ..camera([40.0, 25.0]) };
                let PinholeCamera { forward, right, up, .. } = PinholeCamera::new(&camera, &picture);
                for (a, b) in [(forward, right), (right, up), (up, forward)] {
                    assert!(a.dot(b).abs() < 1e-15 && (a.length() - 1.0).abs() < 1e-15, "{off} {sight}");
                }
            }
        }
    }

    #[test]
    fn lights_that_move_with_the_eye_have_a_place_at_any_distance() {
        let far = Camera { eye: DVec3::MAX, ..camera([40.0, 25.0]) };
        let pinhole = PinholeCamera::new(&far, &Picture { dots: Size::new(16, 10), dot_aspect: 1.0 });
        assert!(pinhole.place(DVec3::new(-0.6, 0.8, 3.0)).is_finite());
    }

    // A zoom of 1e-200 overflowed the square of a ray's direction, which came out as 0.
    #[test]
    fn rays_have_a_direction_at_any_zoom() {
        for zoom in [5e-324, 1e-200, 1.0, 1e200, f64::MAX] {
            let picture = Picture { dots: Size::new(32_768, 1), dot_aspect: 1.0 };
            let pinhole = PinholeCamera::new(&Camera { zoom, ..camera([40.0, 25.0]) }, &picture);
            for (x, y) in [(0.0, 0.0), (0.5, 0.5), (32_768.0, 1.0)] {
                assert!((pinhole.ray(x, y).d.length() - 1.0).abs() < 1e-15, "{zoom} {x} {y}");
            }
        }
    }
}
