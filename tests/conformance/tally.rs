//! An engine's answers about one primitive, held against the oracle's.

use ray13::math::{DVec3, Ray};
use ray13::scene::{Primitive, Shape};

use crate::conformance::engine::{Found, Subject};
use crate::support::oracle::{Big, Chord, Number, Verdict, chord, silhouette, verdict};

/// What was found over many rays.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub rays: usize,
    pub hits: usize,
    /// Rays said to hit or to miss against the oracle's word, though no rim is near.
    pub wrong: Vec<String>,
    /// The same, within the engine's own bound of the rim.
    pub wrong_at_rim: usize,
    /// The largest error of `t`, in ulps of the longest length on the way times `1 + tan` of the angle of
    /// incidence and the ratio of the axes.
    pub ulps: f64,
    /// The largest error of `t` in units of the engine's own word for it.
    pub stated: f64,
    /// Errors of `t` beyond the bound.
    pub inexact: Vec<String>,
}

/// The error of `t`, in the ulps of [`Tally::ulps`], that no hit may pass, but one on the side of a cone:
/// near its apex, and along it, an error grows by the square root of what moves it, and only the engine's own
/// word is a bound.
pub const MOST_ULPS: f64 = 4.0;

/// The same at an edge: there the engine's bound for where a face may seem, 32 half-ulps of 6, decides which
/// is named.
const AT_EDGE: f64 = 96.0;

/// The distance from a number to the next.
pub fn ulp(x: f64) -> f64 {
    x.next_up() - x
}

/// Whether a ray passes the apex of a cone within so much in the cone's own coordinates: there the error
/// along one axis counts for all, because a chord is compared with what it may be off, not with where.
fn passes_apex(primitive: &Primitive, ray: &Ray, within: f64) -> bool {
    let apex = match primitive.shape {
        Shape::Cone { top: 0.0, .. } => DVec3::Z,
        Shape::Cone { bottom: 0.0, .. } => DVec3::NEG_Z,
        _ => return false,
    };
    let inverse = primitive.map.inverse();
    let (o, d) = (inverse.transform_point3(ray.o) - apex, inverse.transform_vector3(ray.d));
    (o - d * (o.dot(d) / d.length_squared())).length() <= within
}

impl Tally {
    /// Counts one ray's answer. `found` may be a hit of the primitive or none; `ratio` is that of its axes.
    pub fn count(
        &mut self,
        subject: &impl Subject,
        primitive: &Primitive,
        ratio: f64,
        ray: &Ray,
        found: Option<Found>,
    ) {
        self.rays += 1;
        let exact = chord::<Big>(primitive, ray).filter(|c| c.leave.t.sign() > 0);
        if exact.is_some() != found.is_some() {
            let rim = subject.rim(primitive, ray);
            match verdict::<Big>(primitive, ray, rim) {
                Verdict::Either => self.wrong_at_rim += 1,
                _ if passes_apex(primitive, ray, rim.max_element()) => self.wrong_at_rim += 1,
                expected => self.wrong.push(format!(
                    "{expected:?} expected, {found:?}, passing at {:?} of the silhouette, {:e} times the bound: {}",
                    silhouette::<Big>(primitive, ray),
                    beyond(primitive, ray, subject.rim(primitive, ray)),
                    said(primitive, ray)
                )),
            }
        }
        let (Some(exact), Some(found)) = (exact, found) else { return };
        self.hits += 1;
        self.compare(subject, primitive, ratio, ray, &exact, found);
    }

    fn compare(
        &mut self,
        subject: &impl Subject,
        primitive: &Primitive,
        ratio: f64,
        ray: &Ray,
        exact: &Chord<Big>,
        found: Found,
    ) {
        let end = if exact.enter.t.sign() > 0 { &exact.enter } else { &exact.leave };
        let error = (Big::from(found.t) - end.t.clone()).abs().value();
        let (linear, center) = (primitive.map.matrix3, primitive.map.translation);
        let size = [0, 1, 2].iter().map(|&i| linear.col(i).length()).fold(0.0, f64::max);
        // The longest length on the way: to the hit, or to the primitive's own place; from 8 sizes on the
        // engine moves its origin there, and the scene's own numbers are taken as exact.
        let length = found.t.max(center.length().min(8.0 * size) + size);
        let ulps = error / (ulp(length) * (1.0 + end.tangent) * ratio);
        let stated = error / (found.error + ulp(found.t));
        let is_cone = matches!(primitive.shape, Shape::Cone { bottom, top } if bottom != top);
        // At an edge the face beside may be named, which the ray may cross more steeply: then its word says
        // less.
        let at_edge = end.face != found.surface;
        let most = if at_edge { AT_EDGE } else { MOST_ULPS };
        let is_inexact = (ulps > most && (at_edge || !is_cone)) || (stated > 1.0 && !at_edge);
        // Along a face within rounding, the ray comes in wherever it may.
        if is_inexact && verdict::<Big>(primitive, ray, subject.rim(primitive, ray)) == Verdict::Either {
            self.wrong_at_rim += 1;
            return;
        }
        self.ulps = self.ulps.max(ulps);
        self.stated = self.stated.max(if at_edge { 0.0 } else { stated });
        if is_inexact {
            self.inexact.push(format!(
                "t = {}, off by {error:e}: {ulps:.1} ulps, {stated:.2} of the stated {:e}, tan {:.3e}: {}",
                found.t,
                found.error,
                end.tangent,
                said(primitive, ray)
            ));
        }
    }

    /// Takes another tally in.
    pub fn add(&mut self, other: Self) {
        self.rays += other.rays;
        self.hits += other.hits;
        self.wrong.extend(other.wrong);
        self.wrong_at_rim += other.wrong_at_rim;
        self.ulps = self.ulps.max(other.ulps);
        self.stated = self.stated.max(other.stated);
        self.inexact.extend(other.inexact);
    }

    /// One line of figures.
    pub fn figures(&self) -> String {
        format!(
            "{} rays, {} hits, {} wrong, {} wrong within the bound, {} inexact, {:.2} ulps, {:.3} of stated",
            self.rays,
            self.hits,
            self.wrong.len(),
            self.wrong_at_rim,
            self.inexact.len(),
            self.ulps,
            self.stated
        )
    }

    #[track_caller]
    pub fn assert_right(&self, what: &str) {
        assert!(self.hits > 0, "{what}: nothing was hit");
        let faults: Vec<&str> =
            self.wrong.iter().take(4).chain(self.inexact.iter().take(4)).map(String::as_str).collect();
        assert!(faults.is_empty(), "{what}: {}\n{}", self.figures(), faults.join("\n"));
    }
}

/// By how much the bound would have to be larger, as a power of two.
fn beyond(primitive: &Primitive, ray: &Ray, bound: DVec3) -> f64 {
    let mut factor = 1.0;
    while factor < 1e15 && verdict::<Big>(primitive, ray, bound * factor) != Verdict::Either {
        factor *= 2.0;
    }
    factor
}

/// A primitive and a ray, to be worked through again.
pub fn said(primitive: &Primitive, ray: &Ray) -> String {
    format!("{:?} {:?} o {:?} d {:?}", primitive.shape, primitive.map, ray.o.to_array(), ray.d.to_array())
}
