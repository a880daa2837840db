//! The way of a ray through balls of glass, worked out without the program: where the index of refraction
//! changes is asked of the points just before and just behind each sphere, and the ray bends by the angles of
//! Snell's law.

use ray13::math::DVec3;

/// A place where a path bends, and how it goes on.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    pub at: DVec3,
    pub d: DVec3,
    pub index: f64,
}

/// A world of spheres, with an index of refraction at each point.
pub struct World<'a> {
    pub spheres: &'a [(DVec3, f64)],
    pub index: &'a dyn Fn(DVec3) -> f64,
}

/// Far less than the solids, far more than rounding.
const STEP: f64 = 1e-7;

impl World<'_> {
    /// The bends of a path until it leaves the world, at most `most` of them.
    pub fn path(&self, eye: DVec3, d: DVec3, most: usize) -> Vec<Bend> {
        let (mut p, mut d) = (eye, d);
        let mut bends = Vec::new();
        while let Some((at, normal)) = self.boundary(p, d) {
            let (before, behind) = ((self.index)(at - STEP * d), (self.index)(at + STEP * d));
            d = bent(d, normal, before, behind);
            bends.push(Bend { at, d, index: (self.index)(at + STEP * d) });
            if bends.len() == most {
                break;
            }
            p = at;
        }
        bends
    }

    /// The next place where the index changes, and a normal of the sphere there.
    fn boundary(&self, p: DVec3, d: DVec3) -> Option<(DVec3, DVec3)> {
        let mut places: Vec<(f64, DVec3)> = Vec::new();
        for &(center, radius) in self.spheres {
            let (b, c) = ((p - center).dot(d), (p - center).length_squared() - radius * radius);
            let discriminant = b * b - c;
            if discriminant > 0.0 {
                places.extend([-b - discriminant.sqrt(), -b + discriminant.sqrt()].map(|t| (t, center)));
            }
        }
        places.retain(|(t, _)| *t > 10.0 * STEP);
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        places.into_iter().find_map(|(t, center)| {
            let at = p + t * d;
            let changes = (self.index)(at - STEP * d) != (self.index)(at + STEP * d);
            changes.then(|| (at, (at - center).normalize()))
        })
    }
}

/// By angles: the ray turns in the plane of `d` and the normal, from the angle of incidence to that of
/// refraction.
fn bent(d: DVec3, normal: DVec3, before: f64, behind: f64) -> DVec3 {
    let inward = if d.dot(normal) > 0.0 { normal } else { -normal };
    let sideways = d - d.dot(inward) * inward;
    let incidence = libm::atan2(sideways.length(), d.dot(inward));
    let sine = libm::sin(incidence) * before / behind;
    if sine > 1.0 {
        return sideways - d.dot(inward) * inward;
    }
    let refraction = libm::asin(sine);
    libm::cos(refraction) * inward + libm::sin(refraction) * sideways.normalize_or_zero()
}
