//! What a surface is made of, and what it reflects of a lamp's light: `kd·C·(L·N) + ks·cosⁿθ`, one formula
//! for one surface and for eight.

use crate::math::{Mask, Number, Powers};

use super::channel::{Channel, limited};
use super::power::power;

/// A material, ready for the channels and the terms that are computed: the shares of all others are 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ResolvedMaterial<C> {
    pub color: C,
    pub kd: f64,
    pub ks: f64,
    pub n: f64,
    pub kr: f64,
    pub kt: f64,
    pub index: f64,
}

impl<C: Channel> ResolvedMaterial<C> {
    /// Whether it reflects anything of a lamp's light.
    #[inline]
    pub fn is_lit(&self) -> bool {
        self.kd > 0.0 || self.ks > 0.0
    }

    /// Whether it sends rays on.
    #[inline]
    pub fn scatters(&self) -> bool {
        self.kr > 0.0 || self.kt > 0.0
    }

    /// `kd·(L·N)`.
    #[inline(always)]
    pub fn diffuse<N: Number>(&self, facing: N) -> N {
        facing * self.kd
    }

    /// `ks·cosⁿθ` of those in `which` whose cosine is above 0; 0 of all others.
    #[inline(always)]
    pub fn highlight<N: Powers>(&self, cosine: N, which: N::Mask) -> N {
        let zero = cosine.same(0.0);
        let towards = which & cosine.is_above(zero);
        if towards.any() { towards.choose(power(cosine, self.n) * self.ks, zero) } else { zero }
    }
}

/// The shares of a lamp's light that surfaces of one material reflect to where they are seen from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflected<N> {
    /// `kd·(L·N)`, in the material's colour.
    pub diffuse: N,
    /// `ks·cosⁿθ`, in the light's colour.
    pub highlight: N,
    /// V; absent where it is 1.
    pub visible: Option<N>,
}

impl<N: Number> Reflected<N> {
    /// Adds one part of a lamp's light to what other lamps gave.
    #[inline(always)]
    pub fn add_to(&self, sum: N, color: f64, light: f64) -> N {
        let mut share = self.diffuse * color + self.highlight;
        if let Some(visible) = self.visible {
            share = share * visible;
        }
        limited(sum + share * light)
    }
}
