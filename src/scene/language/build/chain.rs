//! The maps above a word, one after the other: their product, and how far rounding may have moved it.

use std::rc::Rc;

use super::six_digits::half_units;
use crate::math::{Bounds, DAffine3, DMat3, DVec3, is_singular, product_rest};
use crate::scene::Diagnostic;
use crate::scene::language::syntax::TextSpan;

/// What the numbers of a turn lost before they were there, as a share of 1: three turns by Rodrigues'
/// formula, 9 roundings of sine, cosine and axis each, are 27 half-ulps, rounded up to 28.
const TURNED: f64 = 14.0 * f64::EPSILON;

/// What a decimal number loses when it becomes an f64: half an ulp.
const WRITTEN: f64 = 0.5 * f64::EPSILON;

/// No error.
const NOTHING: DAffine3 = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };

/// Maps from the innermost coordinates to the world's, the outermost first.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    product: DAffine3,
    last: Option<Rc<Link>>,
}

/// Where the numbers of a map come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// As they stand in the text.
    Written,
    /// As they stand in a text in which numbers have six digits.
    Printed,
    /// From angles and axes: rotations and reflections.
    Computed,
}

#[derive(Debug)]
struct Link {
    own: DAffine3,
    /// How far each of its numbers may be from what was meant.
    own_error: DAffine3,
    /// How far along the world's axes a step along this map's axes may lead, whichever way it goes.
    stretch: DMat3,
    /// How far each of its numbers may be from the one that was printed with six digits.
    printed: DAffine3,
    /// What the product down to here lost when this map was multiplied to it.
    lost: DAffine3,
    above: Option<Rc<Link>>,
}

impl Chain {
    /// The chain with `own` below it, where that is finite and can be undone; `place` is the word of `own`.
    pub fn then(&self, own: DAffine3, numbers: Numbers, place: TextSpan) -> Result<Self, Diagnostic> {
        let product = self.product * own;
        if !product.is_finite() {
            let error =
                Diagnostic::error(place, "the numbers up to here multiply to more than a 64-bit float holds");
            return Err(error.label("too large with what stands above it"));
        }
        // `own` by itself, too: what a product makes of a flat map is flat only up to rounding.
        if is_singular(&own.matrix3) || is_singular(&product.matrix3) {
            let error = Diagnostic::error(place, "the map up to here is singular: it makes solids flat");
            return Err(error.help("a map must keep three directions apart; a scale must not be 0"));
        }
        let link = Link {
            own,
            own_error: error_of_numbers(&own, numbers),
            printed: match numbers {
                Numbers::Printed => half_units(&own),
                Numbers::Written | Numbers::Computed => NOTHING,
            },
            stretch: self.product.matrix3.abs(),
            lost: product_rest(&self.product, &own, &product),
            above: self.last.clone(),
        };
        Ok(Self { product, last: Some(Rc::new(link)) })
    }

    /// From the innermost coordinates to the world's.
    pub fn product(&self) -> &DAffine3 {
        &self.product
    }

    /// How far along each axis a point of the box may lie from where exact arithmetic would put it in the
    /// world, to first order.
    ///
    /// Each map adds what its own numbers lost, which those above it carry into the world, and what the
    /// product lost when it was multiplied to it. Whole and half numbers lose nothing. The parts of the
    /// product are multiplied out, not the norms of the maps: of a hundred turns the hundredth is not more
    /// off than a hundred times the first.
    pub fn error(&self, b: &Bounds) -> DVec3 {
        let (mut points, mut error) = (b.corners(), DVec3::ZERO);
        let mut next = self.last.as_ref();
        while let Some(link) = next {
            let farthest = Bounds::around(points).farthest();
            let of = |lost: &DAffine3| lost.matrix3 * farthest + lost.translation;
            error += link.stretch * of(&link.own_error) + of(&link.lost);
            points = points.map(|p| link.own.transform_point3(p));
            next = link.above.as_ref();
        }
        // What numbers near the ends of f64 make of it is no bound, and no solid may vanish by it.
        if error.is_finite() { error } else { DVec3::ZERO }
    }

    /// What six digits leave open of where a point of the box lies in the world, to first order, map by map,
    /// the outermost first.
    pub fn printed(&self, b: &Bounds) -> Vec<PrintedMap> {
        let (mut points, mut maps) = (b.corners(), Vec::new());
        let mut next = self.last.as_ref();
        while let Some(link) = next {
            let farthest = Bounds::around(points).farthest();
            let off = link.stretch * (link.printed.matrix3 * farthest + link.printed.translation);
            maps.push(PrintedMap { id: Rc::as_ptr(link).addr(), off });
            points = points.map(|p| link.own.transform_point3(p));
            next = link.above.as_ref();
        }
        maps.reverse();
        maps
    }
}

/// What a map that was printed with six digits leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintedMap {
    /// Which map it is: the same for all that stand below it, as long as there are chains with it.
    pub id: usize,
    /// How far along each axis of the world it may have moved a point.
    pub off: DVec3,
}

/// How far each number of a map may be from what was meant. A multiple of a half, such as 0 and 1 in a
/// quarter turn, is exactly that.
fn error_of_numbers(own: &DAffine3, numbers: Numbers) -> DAffine3 {
    // Larger numbers are not written digit by digit.
    let whole = |x: f64| (2.0 * x).fract() == 0.0 && x.abs() < libm::ldexp(1.0, 52);
    let of = |x: f64| match numbers {
        _ if whole(x) => 0.0,
        Numbers::Written | Numbers::Printed => WRITTEN * x.abs(),
        Numbers::Computed => TURNED,
    };
    DAffine3::from_cols_array(&own.to_cols_array().map(of))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Bounds = Bounds::new(DVec3::NEG_ONE, DVec3::ONE);

    fn chain(numbers: Numbers, maps: &[DAffine3]) -> Chain {
        let mut chain = Chain::default();
        for &map in maps {
            chain = chain
                .then(map, numbers, TextSpan { start: 0, end: 0 })
                .unwrap_or_else(|error| panic!("{map}: {error:?}"));
        }
        chain
    }

    #[test]
    fn whole_numbers_are_exact() {
        let maps = [
            DAffine3::from_translation(DVec3::new(0.0, 0.0, 5e14)),
            DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z)),
            DAffine3::from_scale(DVec3::new(2.0, 3.0, 5e14)),
        ];
        assert_eq!(chain(Numbers::Written, &maps).error(&UNIT), DVec3::ZERO);
        assert!(
            chain(Numbers::Written, &[DAffine3::from_scale(DVec3::splat(0.1))]).error(&UNIT).min_element()
                > 0.0
        );
    }

    #[test]
    fn a_long_way_there_and_back_is_not_forgotten() {
        let way = DVec3::new(1e6 + 0.1, 0.0, 0.0);
        let error =
            chain(Numbers::Written, &[DAffine3::from_translation(way), DAffine3::from_translation(-way)])
                .error(&UNIT);
        assert!((1e-10..1e-7).contains(&error.x) && error.y < 1e-14, "{error}");
    }

    #[test]
    fn turns_add_up_and_do_not_multiply() {
        let turn = DAffine3::from_axis_angle(DVec3::new(2.0, 3.0, 6.0) / 7.0, 0.3);
        let of = |turns: &[DAffine3]| chain(Numbers::Computed, turns).error(&UNIT).length();
        let (ten, thousand) = (of(&[turn; 10]), of(&vec![turn; 1000]));
        assert!((90.0..110.0).contains(&(thousand / ten)), "{ten} {thousand}");
    }

    #[test]
    fn what_is_scaled_down_takes_its_error_along() {
        let odd = DAffine3::from_scale(DVec3::splat(0.3));
        let down = DAffine3::from_scale(DVec3::splat(1e-9));
        let of = |maps: &[DAffine3]| chain(Numbers::Written, maps).error(&UNIT).length();
        let (own, below) = (of(&[odd]), of(&[down, odd]));
        assert!((1e-9..4e-9).contains(&(below / own)), "{own} {below}");
    }
}
