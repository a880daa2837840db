//! What an eye at a distance sees of light on a screen: the filter for luminance of S-CIELAB (Zhang and
//! Wandell, "A spatial extension of CIELAB for digital color-image reproduction", 1996), whose weights and
//! spreads were fitted to what people told apart (Poirson and Wandell, 1993).

use crate::math::{Grid, Size};

/// One of the three Gaussians, e^(−r²/s²), whose weighted sum the filter is.
struct Gaussian {
    weight: f64,
    /// s, in degrees of the visual field.
    spread: f64,
}

/// The filter for luminance: table 1 of the paper. The broad one is taken away: of light that is the same
/// far around, the eye sees little.
const LUMINANCE: [Gaussian; 3] = [
    Gaussian { weight: 0.921, spread: 0.0283 },
    Gaussian { weight: 0.105, spread: 0.133 },
    Gaussian { weight: -0.108, spread: 4.336 },
];

/// Where a Gaussian is cut off, in spreads: erfc(3) = 2·10⁻⁵ of it lies beyond.
const END: f64 = 3.0;

/// How large the cells of a screen are to an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeDistance {
    /// Degrees of the visual field that a cell is wide.
    pub degrees_per_cell: f64,
}

impl Default for EyeDistance {
    /// A fifth of a degree: a cell of 8 × 16 pixels on a screen of 96 pixels to the inch is 2.12 mm wide, and
    /// the eye 60 cm away: atan(2.12 / 600) = 0.202°.
    fn default() -> Self {
        Self { degrees_per_cell: 0.2 }
    }
}

/// Filters light as an eye sees it.
#[derive(Clone, Debug)]
pub(super) struct EyeFilter {
    /// For each Gaussian its weight, the sum of all being 1, and the shares of a dot's light that dots 0, 1,
    /// … away get, across and down.
    kernels: Vec<(f64, [Vec<f64>; 2])>,
}

impl EyeFilter {
    /// The filter for dots of so many degrees across and down, each above 0, in a picture of `size`.
    pub fn new(degrees: [f64; 2], size: Size) -> Self {
        let all: f64 = LUMINANCE.iter().map(|gaussian| gaussian.weight).sum();
        let kernel = |Gaussian { weight, spread }: &Gaussian| {
            let sides = [(degrees[0], size.width), (degrees[1], size.height)];
            (weight / all, sides.map(|(degrees, dots)| shares(spread / degrees, dots as usize)))
        };
        Self { kernels: LUMINANCE.iter().map(kernel).collect() }
    }

    /// The light, in the same unit, as it is seen. What lies beyond the edge is not known, and counts
    /// nothing.
    pub fn seen(&self, light: &Grid<f64>) -> Grid<f64> {
        let mut seen = Grid::filled(light.size(), 0.0);
        for (weight, [across, down]) in &self.kernels {
            let blurred = transposed(&blurred(&transposed(&blurred(light, across)), down));
            for (sum, light) in seen.values_mut().iter_mut().zip(blurred.values()) {
                *sum += weight * light;
            }
        }
        seen
    }
}

/// The shares that a Gaussian of `spread` dots gives to dots 0, 1, … away, as far as it or the picture
/// reaches: its integral over each.
fn shares(spread: f64, dots: usize) -> Vec<f64> {
    let reach = ((END * spread).ceil() as usize).min(dots.saturating_sub(1));
    let below = |x: f64| libm::erf(x / spread);
    (0..=reach).map(|k| 0.5 * (below(k as f64 + 0.5) - below(k as f64 - 0.5))).collect()
}

/// Each row as a Gaussian leaves it.
fn blurred(light: &Grid<f64>, shares: &[f64]) -> Grid<f64> {
    let width = light.size().width as usize;
    let reach = shares.len() - 1;
    let mut values = Vec::with_capacity(light.size().area());
    for row in light.rows() {
        for middle in 0..width {
            let (mut sum, mut weights) = (0.0, 0.0);
            for x in middle.saturating_sub(reach)..(middle + reach + 1).min(width) {
                let share = shares[middle.abs_diff(x)];
                sum += share * row[x];
                weights += share;
            }
            values.push(sum / weights);
        }
    }
    Grid::from_values(light.size(), values)
}

fn transposed(light: &Grid<f64>) -> Grid<f64> {
    let Size { width, height } = light.size();
    Grid::from_fn(Size::new(height, width), |y, x| light[(x, y)])
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOTS: Size = Size::new(64, 48);

    /// Light that is the same everywhere is seen as it is, at the edges too: by as much as sums of a hundred
    /// products round.
    #[test]
    fn even_light_stays() {
        for degrees in [0.01, 0.1, 2.0] {
            let seen = EyeFilter::new([degrees, 2.0 * degrees], DOTS).seen(&Grid::filled(DOTS, 0.37));
            assert!(seen.values().iter().all(|light| (light - 0.37).abs() < 1e-13), "{degrees}");
        }
    }

    /// A chequer is seen from near; from far it is its mean. With dots of 0.1° (the eye 1.2 m from a cell
    /// 4.2 mm wide) a dot is 3.5 spreads of the narrow Gaussian wide: nearly all stays. With dots of 0.01° it
    /// is 0.35 of one, and a chequer of frequency ½ to the dot both ways keeps e^(−(π s)²/4 · 2) of its
    /// contrast, with s = 2.83: nothing. What is left there, erfc(3) of each side, is where Gaussians are cut
    /// off.
    #[test]
    fn a_chequer_is_seen_from_near_only() {
        let chequer = Grid::from_fn(DOTS, |x, y| f64::from((x + y) % 2));
        let contrast = |degrees: f64| {
            let seen = EyeFilter::new([degrees; 2], DOTS).seen(&chequer);
            let (a, b) = (seen[(32, 24)], seen[(33, 24)]);
            (a - b).abs()
        };
        assert!(contrast(0.1) > 0.5, "{}", contrast(0.1));
        assert!(contrast(0.01) < 1e-3, "{}", contrast(0.01));
    }

    #[test]
    fn a_dot_of_light_is_spread_evenly_to_all_sides() {
        let dot = Grid::from_fn(Size::new(33, 33), |x, y| f64::from(u8::from((x, y) == (16, 16))));
        let seen = EyeFilter::new([0.02; 2], dot.size()).seen(&dot);
        let around = [(15, 16), (17, 16), (16, 15), (16, 17)].map(|place| seen[place]);
        assert!(around.iter().all(|light| (light - around[0]).abs() < 1e-15 && *light > 0.0), "{around:?}");
        assert!(seen[(16, 16)] > around[0]);
    }
}
