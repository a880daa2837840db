//! How strongly the eye sees an error in one dot of a cell together with an error in another.

use super::shape::DOT_COUNT;

/// The eye's filters that a fit is good for, from near and from far: standard deviations of a quarter and of
/// half a cell's width, in dots.
const EYES: [f64; 2] = [0.5, 1.0];

/// A value for each dot of a cell, in scan order.
pub type Dots = [f64; DOT_COUNT];

/// K: for each two dots, the product of their light after the eye's filter, over the whole screen; the mean
/// of the [`EYES`]. Dots are square, as a cell of 2 × 4 is twice as high as wide.
pub fn overlaps() -> [Dots; DOT_COUNT] {
    let apart = |a: usize, b: usize| (a % 2).abs_diff(b % 2) as f64;
    let below = |a: usize, b: usize| (a / 2).abs_diff(b / 2) as f64;
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let seen = EYES.map(|eye| overlap(apart(a, b), eye) * overlap(below(a, b), eye));
            seen.iter().sum::<f64>() / EYES.len() as f64
        })
    })
}

/// Along one axis, the overlap of two dots of width 1 that stand `apart`, each seen through a Gaussian of
/// standard deviation `eye`: the second difference of ∬ of the Gaussian of variance 2 eye².
fn overlap(apart: f64, eye: f64) -> f64 {
    let sigma = eye * std::f64::consts::SQRT_2;
    let twice_integrated = |x: f64| {
        let z = x / sigma;
        let density = libm::exp(-z * z / 2.0) / std::f64::consts::TAU.sqrt();
        let below = f64::midpoint(1.0, libm::erf(z / std::f64::consts::SQRT_2));
        sigma * (z * below + density)
    };
    twice_integrated(apart + 1.0) - 2.0 * twice_integrated(apart) + twice_integrated(apart - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The light of dots seen through Gaussians, without the closed form: K is compared with sums over fine
    /// squares.
    #[test]
    fn the_overlap_is_the_integral_of_two_seen_dots() {
        const FINE: i32 = 200;
        for eye in EYES {
            for apart in 0..4 {
                let sigma = eye * std::f64::consts::SQRT_2;
                let mut sum = 0.0;
                for i in 0..FINE {
                    for j in 0..FINE {
                        let away = f64::from(apart) + f64::from(i - j) / f64::from(FINE);
                        let z = away / sigma;
                        sum += libm::exp(-z * z / 2.0) / (sigma * std::f64::consts::TAU.sqrt());
                    }
                }
                let integral = sum / f64::from(FINE * FINE);
                assert!((overlap(f64::from(apart), eye) - integral).abs() < 1e-5);
            }
        }
    }
}
