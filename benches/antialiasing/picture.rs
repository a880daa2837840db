//! Pictures whose levels are compared.

use ray13::tone::{Level, Tone};

/// The share of dots whose level is not that of the reference.
pub fn wrong_levels(own: &[Level], reference: &[Level]) -> f64 {
    assert_eq!(own.len(), reference.len());
    own.iter().zip(reference).filter(|(own, other)| own != other).count() as f64 / own.len() as f64
}

/// The level that a dot of this light, 0 to 1, shows.
pub fn level(light: f64) -> Level {
    Tone::Lightness.level(light)
}
