//! How far cells are from the picture they show, as an eye sees both.

use ray13::glyph::{Cell, Palette, appearance};
use ray13::math::{Grid, Size};
use ray13::tone::lightness;

/// Samples of the reference per cell: 16 for each of the 2 × 4 dots, and square on the screen.
const SAMPLES: Size = Size::new(8, 16);
/// The eye's filter: standard deviations in widths of a cell.
const EYES: [f64; 2] = [0.25, 0.5];

/// A picture that can be drawn at any size: linear light, one ray through the middle of each dot.
pub struct Picture {
    light: Box<dyn Fn(Size) -> Grid<f64>>,
}

/// RMS error in L* of `cells` against what each eye sees of the picture itself.
pub fn errors(meant: &[Grid<f64>; 2], cells: &Grid<Cell>, palette: Palette) -> [f64; 2] {
    let shown = seen(&appearance(cells, palette, SAMPLES));
    std::array::from_fn(|eye| {
        let pairs = meant[eye].values().iter().zip(shown[eye].values());
        let squares = pairs.map(|(meant, shown)| (meant - shown) * (meant - shown));
        (squares.sum::<f64>() / meant[eye].values().len() as f64).sqrt()
    })
}

/// The lightness that each of [`EYES`] sees of `light`, with [`SAMPLES`] to a cell.
fn seen(light: &Grid<f64>) -> [Grid<f64>; 2] {
    EYES.map(|eye| blurred(light, eye * f64::from(SAMPLES.width)).map(|&light| lightness(light)))
}

/// `light` after a Gaussian filter of `sigma` samples; the picture goes on beyond its border as it is there.
fn blurred(light: &Grid<f64>, sigma: f64) -> Grid<f64> {
    // Beyond four standard deviations lies 0.006 % of the filter.
    let reach = (4.0 * sigma).ceil() as i64;
    let mut weights: Vec<f64> =
        (-reach..=reach).map(|n| libm::exp(-((n * n) as f64) / (2.0 * sigma * sigma))).collect();
    let sum: f64 = weights.iter().sum();
    for weight in &mut weights {
        *weight /= sum;
    }
    let Size { width, height } = light.size();
    let near = |at: u32, n: i64, end: u32| (i64::from(at) + n).clamp(0, i64::from(end) - 1) as u32;
    let across = Grid::from_fn(light.size(), |x, y| {
        (-reach..=reach).zip(&weights).map(|(n, w)| w * light[(near(x, n, width), y)]).sum::<f64>()
    });
    Grid::from_fn(light.size(), |x, y| {
        (-reach..=reach).zip(&weights).map(|(n, w)| w * across[(x, near(y, n, height))]).sum::<f64>()
    })
}

pub fn times(cells: Size, per_cell: Size) -> Size {
    Size::new(cells.width * per_cell.width, cells.height * per_cell.height)
}

impl Picture {
    /// A picture by what draws it at a size.
    pub fn new(light: impl Fn(Size) -> Grid<f64> + 'static) -> Self {
        Self { light: Box::new(light) }
    }

    /// What each eye sees of it on a screen of so many cells.
    pub fn reference(&self, screen: Size) -> [Grid<f64>; 2] {
        seen(&(self.light)(times(screen, SAMPLES)).map(|light| light.clamp(0.0, 1.0)))
    }

    /// The light of each of `dots`, the mean of `rays` × `rays` rays.
    pub fn dots(&self, dots: Size, rays: u32) -> Grid<f64> {
        let fine = (self.light)(times(dots, Size::new(rays, rays)));
        Grid::from_fn(dots, |x, y| {
            let places = (0..rays * rays).map(|k| (x * rays + k % rays, y * rays + k / rays));
            places.map(|place| fine[place]).sum::<f64>() / f64::from(rays * rays)
        })
    }
}
