//! What the words above hand down to a word.

use super::chain::Chain;
use super::materials::Surface;
use crate::scene::profile::Fragments;

/// What the words above hand down to a word.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// From the word's coordinates to the world's, or to those of the form that it is a part of.
    pub maps: Chain,
    pub surface: Surface,
    /// How fine curves are cut, where they are.
    pub fragments: Fragments,
    pub space: FormSpace,
}

/// What becomes of figures and solids.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum FormSpace {
    /// Solids are solids, and figures are as thick as OpenSCAD shows them.
    #[default]
    Solid,
    /// Figures are solids from one z to another.
    Extruded { bottom: f64, top: f64 },
    /// Both are cut into facets, for something to be made of their corners.
    Faceted,
}

impl FormSpace {
    /// From where to where along z a figure reaches: one unit, about the plane z = 0, where nothing is made
    /// of it.
    pub fn thickness(self) -> (f64, f64) {
        match self {
            Self::Extruded { bottom, top } => (bottom, top),
            Self::Solid | Self::Faceted => (-0.5, 0.5),
        }
    }
}
