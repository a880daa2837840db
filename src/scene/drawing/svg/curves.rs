//! The curves of an SVG file, cut into sides: into as many as OpenSCAD cuts them, whatever `$fn` says.

use std::f64::consts::{PI, TAU};

use crate::math::DVec2;
use crate::scene::degrees;

/// The sides of a Bézier curve.
const OF_CURVE: u32 = 20;

/// The sides of a circle or an ellipse.
const OF_ELLIPSE: u32 = 40;

/// The corners of a Bézier curve from `points[0]` on, of degree 2 or 3, without that.
pub fn bezier(points: &[DVec2]) -> impl Iterator<Item = DVec2> {
    (1..=OF_CURVE).map(move |side| {
        let t = f64::from(side) / f64::from(OF_CURVE);
        let rest = 1.0 - t;
        match *points {
            [a, b, c] => a * (rest * rest) + b * (2.0 * rest * t) + c * (t * t),
            [a, b, c, d] => {
                a * (rest * rest * rest)
                    + b * (3.0 * rest * rest * t)
                    + c * (3.0 * rest * t * t)
                    + d * (t * t * t)
            }
            _ => points[points.len() - 1],
        }
    })
}

/// The corners of an ellipse.
pub fn ellipse(centre: DVec2, radii: DVec2) -> Vec<DVec2> {
    let corner = |side: u32| {
        let angle = f64::from(side) * 360.0 / f64::from(OF_ELLIPSE);
        centre + radii * DVec2::new(degrees::sin(angle), degrees::cos(angle))
    };
    (1..=OF_ELLIPSE).map(corner).collect()
}

/// An arc of an ellipse between two places.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub from: DVec2,
    pub to: DVec2,
    /// Both above 0; enlarged where the ellipse does not reach from one place to the other.
    pub radii: DVec2,
    /// By how many degrees the ellipse is turned.
    pub turn: f64,
    /// Whether it is the longer way round.
    pub is_large: bool,
    /// Whether it goes from x towards y.
    pub is_forward: bool,
}

impl Arc {
    /// The corners of the arc, its ends among them: by the notes on arcs of the SVG standard.
    pub fn corners(self) -> Vec<DVec2> {
        let along = DVec2::new(degrees::cos(self.turn), degrees::sin(self.turn));
        // Where the ellipse is the unit circle about the origin, but for its place.
        let half = inverse(along, (self.from - self.to) * 0.5) / self.radii;
        let (grown, half) = match half.length() {
            far if far > 1.0 => (far, half / far),
            _ => (1.0, half),
        };
        let radii = self.radii * grown;
        let off = (1.0 / half.length_squared() - 1.0).max(0.0).sqrt();
        let sign = if self.is_large == self.is_forward { 1.0 } else { -1.0 };
        let middle = half.perp() * (off * sign);
        let angle = |p: DVec2| libm::atan2(p.y, p.x);
        let start = angle(half - middle);
        let sweep = (angle(-half - middle) - start).rem_euclid(TAU);
        let sweep = if self.is_forward { sweep } else { sweep - TAU };
        let centre = (self.from + self.to) * 0.5 + along.rotate(middle * radii);
        let count = (sweep.abs() * 10.0 / PI) as u32 + 4;
        let corner = |side: u32| {
            let at = start + sweep * f64::from(side) / f64::from(count);
            centre + along.rotate(radii * DVec2::new(libm::cos(at), libm::sin(at)))
        };
        // Its own ends, so that what is closed is.
        let inner = (1..count).map(corner);
        std::iter::once(self.from).chain(inner).chain([self.to]).collect()
    }
}

/// Turned back.
fn inverse(along: DVec2, p: DVec2) -> DVec2 {
    DVec2::new(along.x, -along.y).rotate(p)
}
