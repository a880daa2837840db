//! Which objects a point is in.

use crate::math::{Bounds, DVec3, Ray};
use crate::stage::{Meter, Silent};

use super::assembly::{Assembly, Body};
use super::crossing::{Scratch, TRange, first_of_expression, first_of_span};
use super::expression::CsgTree;

/// A direction of length 1, to the bit, that runs along no axis and in no plane of two.
const PROBE: DVec3 = DVec3::new(0.48, 0.6, 0.64);

impl Assembly {
    /// Whether a point of the assembly is inside an object: a ray from there leaves it before it enters it. A
    /// point on its surface is on the side to which the ray goes. No point is inside a surface that bounds no
    /// solid.
    pub fn contains(&self, object: u32, p: DVec3) -> bool {
        let object = &self.objects[object as usize];
        if !(p.cmpge(object.bounds.lo).all() && p.cmple(object.bounds.hi).all()) {
            return false;
        }
        let ray = Ray::new(p, PROBE);
        let mut meter = Meter::new(Silent);
        let first = match &object.body {
            Body::Single(index) => {
                first_of_span(&ray, &self.primitives[*index as usize], *index, None, &mut meter)
            }
            Body::Composite { whole, .. } => {
                let mut scratch = Scratch::default();
                let primitives = &self.primitives;
                first_of_expression(&ray, &**whole, primitives, None, TRange::ALL, &mut scratch, &mut meter)
            }
            // A surface has sides, but no inside.
            Body::Surface(_) => return false,
        };
        first.is_some_and(|crossing| !crossing.entering)
    }

    /// A box around those of the solids that an object puts together in which there is any primitive of some
    /// kind.
    pub fn bounds_of(&self, object: u32, kind: impl Fn(u32) -> bool) -> Bounds {
        let object = &self.objects[object as usize];
        let Body::Composite { tree, .. } = &object.body else { return object.bounds };
        let of_kind = |part: &&CsgTree| part.leaves().into_iter().any(&kind);
        let parts = tree.parts().into_iter().filter(of_kind).map(|part| part.bounds(&self.primitives));
        parts.fold(Bounds::EMPTY, |all, part| all.join(&part))
    }

    /// The primitives of an object, in file order.
    pub fn primitives_of(&self, object: u32) -> Vec<u32> {
        match &self.objects[object as usize].body {
            Body::Single(index) | Body::Surface(index) => vec![*index],
            Body::Composite { tree, .. } => tree.leaves(),
        }
    }
}
