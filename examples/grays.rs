//! Measures how near each glyph mode comes to the picture it shows, and prints the table of `docs/13-grays.md`:
//! `cargo run --release --example grays`.

use ray13::glyph::{Cell, GlyphMode, Palette, appearance, compose};
use ray13::math::{Grid, Size};
use ray13::tone::{Tone, lightness};

/// The screen that is measured, in cells: square, as cells are twice as high as wide.
const SCREEN: Size = Size::new(80, 40);
/// Samples of the reference per cell: 16 for each of the 2 × 4 dots, and square on the screen.
const SAMPLES: Size = Size::new(8, 16);
/// The eye's filter: standard deviations in widths of a cell.
const EYES: [f64; 2] = [0.25, 0.5];

/// A picture that can be drawn at any size: linear light, one ray through the middle of each dot.
struct Picture {
    name: &'static str,
    light: Box<dyn Fn(Size) -> Grid<f64>>,
}

/// RMS error in L* of `cells` against `reference` (linear light, [`SAMPLES`] to a cell), for each of [`EYES`].
fn errors(reference: &Grid<f64>, cells: &Grid<Cell>) -> [f64; 2] {
    let shown = appearance(cells, SAMPLES);
    EYES.map(|eye| {
        let sigma = eye * f64::from(SAMPLES.width);
        let meant = blurred(reference, sigma);
        let seen = blurred(&shown, sigma);
        let squares = meant.values().iter().zip(seen.values()).map(|(&meant, &seen)| {
            let error = lightness(meant.clamp(0.0, 1.0)) - lightness(seen);
            error * error
        });
        (squares.sum::<f64>() / meant.values().len() as f64).sqrt()
    })
}

/// `light` after a Gaussian filter of `sigma` samples; the picture goes on beyond its border as it is there.
fn blurred(light: &Grid<f64>, sigma: f64) -> Grid<f64> {
    // Beyond four standard deviations lies 0.006 % of the filter.
    let reach = (4.0 * sigma).ceil() as i64;
    let mut weights: Vec<f64> =
        (-reach..=reach).map(|n| libm::exp(-((n * n) as f64) / (2.0 * sigma * sigma))).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    let Size { width, height } = light.size();
    let near = |at: u32, n: i64, end: u32| (i64::from(at) + n).clamp(0, i64::from(end) - 1) as u32;
    let across = Grid::from_fn(light.size(), |x, y| {
        (-reach..=reach).zip(&weights).map(|(n, w)| w * light[(near(x, n, width), y)]).sum::<f64>()
    });
    Grid::from_fn(light.size(), |x, y| {
        (-reach..=reach).zip(&weights).map(|(n, w)| w * across[(x, near(y, n, height))]).sum::<f64>()
    })
}

fn times(cells: Size, per_cell: Size) -> Size {
    Size::new(cells.width * per_cell.width, cells.height * per_cell.height)
}

fn main() {
    let pictures = pictures();
    let references: Vec<Grid<f64>> = pictures
        .iter()
        .map(|picture| (picture.light)(times(SCREEN, SAMPLES)).map(|light| light.clamp(0.0, 1.0)))
        .collect();
    let shows = [
        ("shade", GlyphMode::Shade, Palette::Dos),
        ("blocks", GlyphMode::Blocks, Palette::Dos),
        ("cp437", GlyphMode::Cp437, Palette::Dos),
        ("shade", GlyphMode::Shade, Palette::Mono),
        ("blocks", GlyphMode::Blocks, Palette::Mono),
        ("cp437", GlyphMode::Cp437, Palette::Mono),
    ];
    print!("| glyphs | palette |");
    for picture in &pictures {
        print!(" {} |", picture.name);
    }
    println!(" mean |");
    let mut base = vec![];
    for (name, mode, palette) in shows {
        let mut row = vec![];
        for (picture, reference) in pictures.iter().zip(&references) {
            let light = (picture.light)(times(SCREEN, mode.dots_per_cell()));
            row.push(errors(reference, &compose(&light, mode, palette, Tone::Lightness)));
        }
        print!("| {name} | {} |", palette.name());
        for e in &row {
            print!(" {:.2} / {:.2} |", e[0], e[1]);
        }
        let mean = row.iter().flatten().sum::<f64>() / (2 * row.len()) as f64;
        println!(" {mean:.2} |");
        if mode == GlyphMode::Shade {
            base = row;
        } else {
            let gains: Vec<f64> =
                row.iter().zip(&base).map(|(a, b)| 100.0 * (1.0 - (a[0] + a[1]) / (b[0] + b[1]))).collect();
            let each: Vec<f64> =
                row.iter().flatten().zip(base.iter().flatten()).map(|(a, b)| 100.0 * (1.0 - a / b)).collect();
            let text: Vec<String> = gains.iter().map(|g| format!("{g:.0} %")).collect();
            println!(
                "| gain | | {} | {:.1} % (each {:.1}) |",
                text.join(" | "),
                gains.iter().sum::<f64>() / gains.len() as f64,
                each.iter().sum::<f64>() / each.len() as f64
            );
        }
    }
    let light = (pictures[0].light)(Size::new(240, 160));
    let t = std::time::Instant::now();
    for _ in 0..20 {
        std::hint::black_box(compose(&light, GlyphMode::Blocks, Palette::Dos, Tone::Lightness));
    }
    println!("{:.3} ms for 120 x 40", t.elapsed().as_secs_f64() * 50.0);
}

/// A picture from its light at (x, y), each from −1 to 1, x to the right and y up.
fn picture(name: &'static str, light: impl Fn(f64, f64) -> f64 + 'static) -> Picture {
    Picture {
        name,
        light: Box::new(move |size| {
            Grid::from_fn(size, |column, row| {
                let along = |k: u32, n: u32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
                light(along(column, size.width), -along(row, size.height))
            })
        }),
    }
}

fn lit(n: [f64; 3], ambient: f64, kd: f64, ks: f64, shine: f64) -> f64 {
    let l = [-0.5, 0.6, 0.62];
    let m = (l[0] * l[0] + l[1] * l[1] + l[2] * l[2] as f64).sqrt();
    let d = (n[0] * l[0] + n[1] * l[1] + n[2] * l[2]) / m;
    let r = 2.0 * d * n[2] - l[2] / m;
    ambient + kd * d.max(0.0) + if d > 0.0 { ks * libm::pow(r.max(0.0), shine) } else { 0.0 }
}

fn sphere(x: f64, y: f64, cx: f64, cy: f64, r: f64) -> Option<[f64; 3]> {
    let (u, v) = ((x - cx) / r, (y - cy) / r);
    let w = 1.0 - u * u - v * v;
    (w >= 0.0).then(|| [u, v, w.sqrt()])
}

fn pictures() -> Vec<Picture> {
    vec![
        picture("spheres", |x, y| {
            for (cx, cy, r) in [(-0.45, -0.1, 0.42), (0.35, -0.25, 0.3), (0.3, 0.5, 0.35), (0.8, -0.5, 0.12)]
            {
                if let Some(n) = sphere(x, y, cx, cy, r) {
                    return lit(n, 0.05, 0.7, 0.3, 24.0);
                }
            }
            if y < -0.3 {
                let shadow = [(-0.15, -0.62, 0.45, 0.13), (0.6, -0.6, 0.33, 0.1)]
                    .iter()
                    .any(|(a, b, c, d)| ((x - a) / c) * ((x - a) / c) + ((y - b) / d) * ((y - b) / d) < 1.0);
                return if shadow { 0.06 } else { 0.35 - 0.25 * (y + 1.0) };
            }
            0.0
        }),
        picture("boxes", |x, y| {
            for (cx, cy, s) in [(0.5, -0.4, 0.35), (-0.4, 0.1, 0.5), (0.45, 0.55, 0.2)] {
                let (u, v) = ((x - cx) / s, (y - cy) / s);
                // Three faces of a cube seen along a slanted axis.
                let (a, b) = (u / 0.92 + v / 1.6, -u / 0.92 + v / 1.6);
                if a > 0.0 && b > 0.0 && a < 1.0 && b < 1.0 {
                    return 0.82;
                }
                let h = v + u.abs() * 1.7;
                if u.abs() < 0.92 && h < 0.0 && h > -1.1 {
                    return if u < 0.0 { 0.33 } else { 0.07 };
                }
            }
            0.02
        }),
        picture("gradient", |x, y| {
            let d = ((x - 0.3) * (x - 0.3) + (y + 0.2) * (y + 0.2)).sqrt();
            0.9 * libm::exp(-d * d * 2.0) + 0.05 * (x + 1.0) / 2.0
        }),
        picture("columns", |x, y| {
            for k in 0..9 {
                let (c, r) = (-0.85 + 0.21 * f64::from(k), 0.07 - 0.0065 * f64::from(k));
                let u = (x - c) / r;
                if u.abs() < 1.0 && y.abs() < 0.75 {
                    return lit([u, 0.0, (1.0 - u * u).sqrt()], 0.06, 0.75, 0.2, 30.0);
                }
                if (x - c).abs() < r * 1.3 && y.abs() < 0.82 {
                    return 0.55;
                }
            }
            if y < -0.75 { 0.25 } else { 0.10 + 0.08 * y }
        }),
        picture("rings", |x, y| {
            let d = (x * x + y * y).sqrt();
            let a = libm::atan2(y, x);
            if d > 0.95 {
                0.0
            } else if (libm::sin(d * 24.0) + 0.4 * libm::sin(3.0 * a)) > 0.0 {
                0.5 + 0.4 * libm::cos(a)
            } else {
                0.12
            }
        }),
    ]
}
