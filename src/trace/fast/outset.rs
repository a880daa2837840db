//! The rays of a tile: those that surfaces sent on are there, those from the eye are made where anything may lie in their
//! way.

use fearless_simd::{Level, Simd, SimdMask, f64x8, mask64x8};

use crate::lattice::{Basis, Beam, FAN, Fan, Spread};
use crate::math::{Bundle, Column, Columns, Number, row_of};
use crate::solid::{Departures, Starts};
use crate::view::Sight;

use super::super::exact::most_moved;

/// A bundle, and the surfaces that its rays leave: none from the eye.
#[derive(Clone, Copy)]
pub(super) struct Outset<'a> {
    pub rays: &'a Bundle,
    pub departures: Option<&'a Departures>,
}

impl Outset<'_> {
    /// The surfaces that the rays of a row start on, as seen from a primitive.
    #[inline(always)]
    pub fn starts<S: Simd>(&self, simd: S, row: usize, primitive: f64x8<S>) -> Starts<f64x8<S>> {
        let no = mask64x8::splat(simd, false);
        let Some(departures) = self.departures else { return Starts { here: no, inward: no, off: None } };
        Starts {
            here: departures.primitive.load(simd, row).is_equal(primitive),
            inward: row_of(simd, departures.inward, row),
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
            Self::Made { bundles, departures } => {
                Outset { rays: &bundles[k], departures: departures.map(|all| &all[k]) }
            }
            Self::Seen { bundles, .. } => Outset { rays: &bundles[k], departures: None },
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
                beams.extend(bundles.iter().map(
                    #[inline(always)]
                    |bundle| Some(around(simd, std::slice::from_ref(bundle))),
                ));
            }
            Self::Seen { sight, .. } => {
                // The sides of all blocks run along those of the tile.
                let basis = Basis::of_corners(sight.ends());
                let mut corners = [Column::filled(0.0); 3];
                sight.corners(level, &mut corners);
                for k in 0..sight.blocks().min(FAN) {
                    let ends = [0, 1, 2, 3].map(|corner| corners.get(4 * k + corner));
                    let moved = most_moved(sight.eye, &ends);
                    beams.push(Some(Beam::between(sight.eye, ends, moved, &basis)));
                }
            }
        }
        fan.set(beams);
    }
}

/// The frustum around rays of any kind.
#[inline(always)]
fn around<S: Simd>(simd: S, bundles: &[Bundle]) -> Beam {
    Beam::around(simd, bundles.iter().map(|bundle| (bundle, None)), Spread::Apart)
}
