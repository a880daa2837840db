//! The rays of a tile: those that surfaces sent on are there, those from the eye are made where anything may lie in their
//! way.

use fearless_simd::{Level, Simd};

use crate::lattice::{Basis, Beam, FAN, Fan, Spread};
use crate::math::{Bundle, Column, Columns, Digits, Number};
use crate::solid::{Departures, Starts};
use crate::view::Sight;

use super::super::exact::most_moved;

/// A bundle, and the surfaces that its rays leave: none from the eye. In the digits in which it is asked, and with all.
#[derive(Clone, Copy)]
pub(super) struct Outset<'a, T = f64> {
    pub rays: &'a Bundle<T>,
    pub departures: Option<&'a Departures<T>>,
    pub full_rays: &'a Bundle,
    pub full_departures: Option<&'a Departures>,
}

impl<'a> Outset<'a> {
    /// One with all digits.
    pub fn new(rays: &'a Bundle, departures: Option<&'a Departures>) -> Self {
        Self { rays, departures, full_rays: rays, full_departures: departures }
    }
}

impl<'a, T: Digits> Outset<'a, T> {
    /// The same with all digits.
    pub fn full(&self) -> Outset<'a> {
        Outset::new(self.full_rays, self.full_departures)
    }

    /// The surfaces that the rays of a row start on, as seen from a primitive.
    #[inline(always)]
    pub fn starts<S: Simd>(&self, simd: S, row: usize, primitive: T::Wide<S>) -> Starts<T::Wide<S>> {
        let no = T::row_of(simd, 0, row);
        let Some(departures) = self.departures else { return Starts { here: no, inward: no, off: None } };
        Starts {
            here: departures.primitive.load(simd, row).is_equal(primitive),
            inward: T::row_of(simd, departures.inward, row),
            off: Some(departures.off.load(simd, row)),
        }
    }
}

/// The bundles of a tile, up to [`FAN`] of them.
pub(super) enum Outsets<'a> {
    /// Bundles that are [closed](Bundle::close), and the surfaces that the rays of each leave.
    Made { bundles: &'a [Bundle], departures: Option<&'a [Departures]> },
    /// The blocks of a tile. `make` makes the rays of one.
    Seen { sight: &'a Sight<'a>, bundles: &'a mut [Bundle], make: &'a mut dyn FnMut(usize, &mut Bundle) },
}

impl Outsets<'_> {
    /// Whether none of a bundle's rays looks for anything. Of those that are still to be made some does.
    pub fn is_blind(&self, k: usize) -> bool {
        matches!(self, Self::Made { bundles, .. } if bundles[k].live == 0)
    }

    /// Makes what is to be made of a bundle.
    pub fn make(&mut self, k: usize) {
        if let Self::Seen { bundles, make, .. } = self {
            make(k, &mut bundles[k]);
        }
    }

    /// One of them, which was made.
    #[inline(always)]
    pub fn get(&self, k: usize) -> Outset<'_> {
        match self {
            Self::Made { bundles, departures } => Outset::new(&bundles[k], departures.map(|all| &all[k])),
            Self::Seen { bundles, .. } => Outset::new(&bundles[k], None),
        }
    }

    /// The frustum around them all.
    #[inline(always)]
    pub fn whole<S: Simd>(&self, simd: S) -> Beam {
        match self {
            Self::Made { bundles, .. } => around(simd, bundles),
            Self::Seen { sight, .. } => {
                let ends = sight.ends();
                Beam::between(sight.eye, ends, most_moved(sight.eye, &ends), &Basis::of_corners(ends))
            }
        }
    }

    /// Sets `fan` to the frustums of each.
    #[inline(always)]
    pub fn spread<S: Simd>(&self, simd: S, level: Level, (beams, fan): (&mut Vec<Option<Beam>>, &mut Fan)) {
        beams.clear();
        match self {
            Self::Made { bundles, .. } => {
                // Not by `map`, whose closure is compiled by itself, for any processor.
                for bundle in *bundles {
                    beams.push(Some(around(simd, std::slice::from_ref(bundle))));
                }
            }
            Self::Seen { sight, .. } => {
                // The sides of all blocks run along those of the tile.
                let ends = sight.ends();
                let basis = Basis::of_corners(ends);
                // Rays of one tile differ little in how far they are moved.
                let moved = most_moved(sight.eye, &ends);
                let mut corners = [Column::filled(0.0); 3];
                sight.corners(level, &mut corners);
                for k in 0..sight.blocks().min(FAN) {
                    let ends = [0, 1, 2, 3].map(|corner| corners.get(4 * k + corner));
                    beams.push(Some(Beam::between(sight.eye, ends, moved, &basis)));
                }
            }
        }
        fan.set(simd, beams);
    }
}

/// The frustum around rays of any kind.
#[inline(always)]
fn around<S: Simd>(simd: S, bundles: &[Bundle]) -> Beam {
    Beam::around(simd, bundles.iter().map(|bundle| (bundle, None)), Spread::Apart)
}

#[cfg(test)]
mod tests {
    use fearless_simd::{SimdBase, dispatch, f32x8};
    use proptest::prelude::*;

    use super::super::super::exact::all_moved_nearer;
    use super::*;
    use crate::math::{DVec3, ROWS, Size, lanes};
    use crate::scene::{Camera, FieldSpan};
    use crate::view::{Lens, Picture, tiles};

    fn direction() -> impl Strategy<Value = DVec3> {
        let coordinate = || prop_oneof![-1.0..1.0_f64, (-1..=1_i8).prop_map(f64::from)];
        (coordinate(), coordinate(), coordinate())
            .prop_map(|(x, y, z)| DVec3::new(x, y, z).normalize_or(DVec3::X))
    }

    proptest! {
        #[test]
        fn what_a_ray_from_the_eye_meets_its_frustums_meet_no_farther(
            (from, look, up) in (direction(), direction(), direction()),
            // The eye in the world, near it, or far away, with a field as wide as that, or any.
            (exponent, wide_exponent) in (-1.0..9.0_f64, -1.0..1.0_f64),
            any_field in prop_oneof![Just(None), (0.01..179.0_f64).prop_map(Some)],
            (width, height) in (1..80_u32, 1..80_u32),
            off in (-0.5..0.5_f64, -0.5..0.5_f64),
            pick in 0..64_usize,
        ) {
            let distance = libm::pow(10.0, exponent);
            let eye = from * distance;
            let narrow = 2.0 * libm::atan(libm::pow(10.0, wide_exponent) / distance).to_degrees();
            let field = any_field.unwrap_or(narrow).min(179.0);
            let camera = Camera {
                name: None, eye, target: look * 0.3, up, field: [field; 2], span: FieldSpan::Edges, zoom: 1.0,
            };
            prop_assume!(eye.distance(camera.target) > 1e-3);
            let lens = Lens::new(&camera, &Picture { dots: Size::new(width, height), dot_aspect: 1.0 });
            let all = tiles(Size::new(width, height));
            let tile = all[pick % all.len()];
            let sight = Sight { lens: &lens, tile, off: [off.0, off.1], eye, way: distance + 4.0 };
            let mut bundles = vec![Bundle::EMPTY; sight.blocks()];
            let level = Level::new();
            for (k, bundle) in bundles.iter_mut().enumerate() {
                sight.rays(k, level, bundle);
                dispatch!(level, simd => for row in 0..ROWS {
                    let (near, _) = all_moved_nearer(&bundle.load(simd, row));
                    bundle.o.store(row, near.o);
                });
            }
            let mut unmade = bundles.clone();
            let mut make = |_: usize, _: &mut Bundle| {};
            let outsets = Outsets::Seen { sight: &sight, bundles: &mut unmade, make: &mut make };
            let (mut beams, mut fan) = (Vec::new(), Fan::default());
            let whole = dispatch!(level, simd => {
                outsets.spread(simd, level, (&mut beams, &mut fan));
                outsets.whole(simd)
            });
            for (k, bundle) in bundles.iter().enumerate() {
                for lane in lanes(bundle.live) {
                    let ray = bundle.ray(lane);
                    for t in [0.0, 0.3, 2.0, 3.5, 5.0, 8.0] {
                        let p = ray.at(t);
                        if p.abs().max_element() > 2.0 {
                            continue;
                        }
                        // As boxes are: rounded outward, and a little more.
                        let lo = [p.x, p.y, p.z].map(|x| (x - 1e-6) as f32);
                        let hi = [p.x, p.y, p.z].map(|x| (x + 1e-6) as f32);
                        let (met, near) = dispatch!(level, simd => {
                            let eight = |x: [f32; 3]| x.map(|x| f32x8::splat(simd, x));
                            let met = whole.meets_boxes(simd, &eight(lo), &eight(hi));
                            let near: [f32; 8] = met.near.into();
                            (met.boxes, near[0])
                        });
                        prop_assert_eq!(met & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(near) <= t, "{} {}", near, t);
                        let met = dispatch!(level, simd => fan.meets(simd, lo, hi));
                        prop_assert_eq!(met.frustums >> k & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(met.near[k]) <= t, "{} {}", met.near[k], t);
                        let center = [p.x, p.y, p.z].map(|x| x as f32);
                        let met = dispatch!(level, simd => fan.meets_ball(simd, center, 1e-6));
                        prop_assert_eq!(met.frustums >> k & 1, 1, "block {} lane {} at {}", k, lane, t);
                        prop_assert!(f64::from(met.near[k]) <= t, "{} {}", met.near[k], t);
                    }
                }
            }
        }
    }
}
