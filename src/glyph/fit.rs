//! Best fit.

use super::cell::{Cell, Paint, Palette};
use super::shade::shade;
use super::shape::{DOT_COUNT, DOTS, Shape};
use crate::math::{Grid, Size};
use crate::tone::{Level, Tone, lightness};

enum Show {
    Level(Level),
    Edge(Cell),
}

pub struct BestFit {
    palette: Palette,
    shown: Vec<Show>,
    dots: Vec<[f64; DOT_COUNT]>,
    pull: Vec<[f64; DOT_COUNT]>,
    own: Vec<f64>,
}

fn var(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// k(n)
fn overlap(n: f64, sigma: f64) -> f64 {
    let s = sigma * std::f64::consts::SQRT_2;
    let psi = |x: f64| {
        let phi = libm::exp(-x * x / 2.0) / (2.0 * std::f64::consts::PI).sqrt();
        x * 0.5 * (1.0 + libm::erf(x / std::f64::consts::SQRT_2)) + phi
    };
    s * (psi((n + 1.0) / s) - 2.0 * psi(n / s) + psi((n - 1.0) / s))
}

impl BestFit {
    pub fn new(shapes: &[Shape], palette: Palette, dark: bool) -> Self {
        let (w1, w2, w0) = (var("W1", 0.5), var("W2", 0.5), var("W0", 0.0));
        let mut k = [[0.0; DOT_COUNT]; DOT_COUNT];
        for i in 0..DOT_COUNT {
            for j in 0..DOT_COUNT {
                let dx = (i % 2).abs_diff(j % 2) as f64;
                let dy = (i / 2).abs_diff(j / 2) as f64;
                k[i][j] = w1 * overlap(dx, 0.5) * overlap(dy, 0.5)
                    + w2 * overlap(dx, 1.0) * overlap(dy, 1.0)
                    + if i == j { w0 } else { 0.0 };
            }
        }
        let mut fit = Self { palette, shown: vec![], dots: vec![], pull: vec![], own: vec![] };
        for level in Level::all() {
            fit.add(Show::Level(level), [level.light(); DOT_COUNT]);
        }
        let pairs: Vec<(Paint, Paint)> = match palette {
            Palette::Mono => vec![(Paint::Terminal, Paint::Terminal)],
            Palette::Dos => {
                let all = [Paint::Black, Paint::LightGray, Paint::DarkGray, Paint::White];
                let papers = if dark { &all[..2] } else { &all[..] };
                papers
                    .iter()
                    .flat_map(|&p| all.iter().filter(move |&&i| i != p).map(move |&i| (i, p)))
                    .collect()
            }
        };
        for (ink, paper) in pairs {
            for shape in shapes {
                let cell = Cell { glyph: shape.glyph, ink, paper };
                let dots = std::array::from_fn(|d| {
                    if shape.mask >> d & 1 == 1 { cell.ink_light() } else { cell.paper_light() }
                });
                if !fit.dots.contains(&dots) {
                    fit.add(Show::Edge(cell), dots);
                }
            }
        }
        for dots in &fit.dots {
            let l = dots.map(lightness);
            let pull: [f64; DOT_COUNT] =
                std::array::from_fn(|i| (0..DOT_COUNT).map(|j| k[i][j] * l[j]).sum());
            fit.own.push((0..DOT_COUNT).map(|i| pull[i] * l[i]).sum());
            fit.pull.push(pull);
        }
        fit
    }

    fn add(&mut self, show: Show, dots: [f64; DOT_COUNT]) {
        self.shown.push(show);
        self.dots.push(dots);
    }

    pub fn compose(&self, light: &Grid<f64>, tone: Tone) -> Grid<Cell> {
        let cells = Size::new(light.size().width / DOTS.width, light.size().height / DOTS.height);
        Grid::from_fn(cells, |column, row| {
            let dots: [f64; DOT_COUNT] = std::array::from_fn(|d| {
                let (x, y) = (d as u32 % DOTS.width, d as u32 / DOTS.width);
                tone.shown(light[(column * DOTS.width + x, row * DOTS.height + y)])
            });
            if dots.iter().all(|&d| d == dots[0]) {
                return shade(Level::nearest(dots[0]), self.palette, column, row);
            }
            let l = dots.map(lightness);
            let mut best = (f64::INFINITY, 0);
            for c in 0..self.own.len() {
                let cost = self.own[c] - 2.0 * (0..DOT_COUNT).map(|d| self.pull[c][d] * l[d]).sum::<f64>();
                if cost < best.0 {
                    best = (cost, c);
                }
            }
            match self.shown[best.1] {
                Show::Level(level) => shade(level, self.palette, column, row),
                Show::Edge(cell) => cell,
            }
        })
    }
}
