//! Measures how near each glyph mode comes to the picture it shows, and prints the table of `docs/13-grays.md`:
//! `cargo run --release --example grays`.

use std::io::{self, Write};

use ray13::frame::{Request, Studio};
use ray13::glyph::{Cell, GlyphMode, Palette, appearance, compose};
use ray13::math::{Grid, Size};
use ray13::output;
use ray13::plan::Options;
use ray13::scene::{ReadOptions, embedded, read};
use ray13::tone::{Tone, lightness};

/// The screen that is measured, in cells: square, as cells are twice as high as wide.
const SCREEN: Size = Size::new(80, 40);
/// Samples of the reference per cell: 16 for each of the 2 × 4 dots, and square on the screen.
const SAMPLES: Size = Size::new(8, 16);
/// The eye's filter: standard deviations in widths of a cell.
const EYES: [f64; 2] = [0.25, 0.5];

/// A picture that can be drawn at any size: linear light, one ray through the middle of each dot.
struct Picture {
    name: String,
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

fn times(cells: Size, per_cell: Size) -> Size {
    Size::new(cells.width * per_cell.width, cells.height * per_cell.height)
}

impl Picture {
    /// The light of each of `dots`, the mean of `rays` × `rays` rays.
    fn dots(&self, dots: Size, rays: u32) -> Grid<f64> {
        let fine = (self.light)(times(dots, Size::new(rays, rays)));
        Grid::from_fn(dots, |x, y| {
            let places = (0..rays * rays).map(|k| (x * rays + k % rays, y * rays + k / rays));
            places.map(|place| fine[place]).sum::<f64>() / f64::from(rays * rays)
        })
    }
}

/// One row of the table: the characters, and along each axis of a dot how many rays.
struct Row {
    mode: GlyphMode,
    palette: Palette,
    rays: u32,
}

/// `shade` stands before the modes that are compared with it.
const ROWS: [Row; 8] = {
    use GlyphMode::{Blocks, Cp437, Shade};
    use Palette::{Dos, Mono};
    [
        Row { mode: Shade, palette: Dos, rays: 1 },
        Row { mode: Blocks, palette: Dos, rays: 1 },
        Row { mode: Cp437, palette: Dos, rays: 1 },
        Row { mode: Shade, palette: Dos, rays: 4 },
        Row { mode: Blocks, palette: Dos, rays: 4 },
        Row { mode: Shade, palette: Mono, rays: 1 },
        Row { mode: Blocks, palette: Mono, rays: 1 },
        Row { mode: Cp437, palette: Mono, rays: 1 },
    ]
};

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    table(&mut out)?;
    small_pictures(&mut out)
}

fn table(out: &mut impl Write) -> io::Result<()> {
    let pictures = pictures();
    let references: Vec<Grid<f64>> = pictures
        .iter()
        .map(|picture| (picture.light)(times(SCREEN, SAMPLES)).map(|light| light.clamp(0.0, 1.0)))
        .collect();
    let names: Vec<&str> = pictures.iter().map(|picture| picture.name.as_str()).collect();
    writeln!(out, "| glyphs | palette | rays per dot | {} | mean | better than shade |", names.join(" | "))?;
    writeln!(out, "|---|---|---|{}---|---|", "---|".repeat(names.len()))?;
    let mut shade = Vec::new();
    for Row { mode, palette, rays } in ROWS {
        let found: Vec<[f64; 2]> = pictures
            .iter()
            .zip(&references)
            .map(|(picture, reference)| {
                let light = picture.dots(times(SCREEN, mode.dots_per_cell()), rays);
                errors(reference, &compose(&light, mode, palette, Tone::default()))
            })
            .collect();
        write!(out, "| `{}` | {} | {} |", mode.name(), palette.name(), rays * rays)?;
        for [near, far] in &found {
            write!(out, " {near:.2} / {far:.2} |")?;
        }
        write!(out, " {:.2} |", mean(found.concat().into_iter()))?;
        if mode == GlyphMode::Shade {
            writeln!(out, " |")?;
            shade = found;
        } else {
            let gains: Vec<f64> = found
                .iter()
                .zip(&shade)
                .map(|(found, shade)| {
                    100.0 * mean(found.iter().zip(shade).map(|(found, shade)| 1.0 - found / shade))
                })
                .collect();
            let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
            writeln!(out, " {:.0} %, at least {least:.0} % |", mean(gains.iter().copied()))?;
        }
    }
    Ok(())
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len();
    values.sum::<f64>() / count as f64
}

/// The first picture, small, as plain text.
fn small_pictures(out: &mut impl Write) -> io::Result<()> {
    let small = Size::new(32, 16);
    for mode in GlyphMode::ALL {
        let light = pictures()[0].dots(times(small, mode.dots_per_cell()), 1);
        writeln!(out, "\n{}:", mode.name())?;
        output::text(&compose(&light, mode, Palette::Mono, Tone::default()), out)?;
    }
    Ok(())
}

/// A picture from its light at (x, y), each from −1 to 1, x to the right and y up.
fn picture(name: &'static str, light: impl Fn(f64, f64) -> f64 + 'static) -> Picture {
    Picture {
        name: name.to_owned(),
        light: Box::new(move |size| {
            Grid::from_fn(size, |column, row| {
                let along = |k: u32, n: u32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
                light(along(column, size.width), -along(row, size.height))
            })
        }),
    }
}

/// Eq. (3) for a surface of normal `n` seen along z, lit from the upper left: ambient, diffuse and highlight light.
fn lit(n: [f64; 3], ambient: f64, kd: f64, ks: f64) -> f64 {
    const TO_LIGHT: [f64; 3] = [-0.5, 0.6, 0.62];
    const SHINE: f64 = 24.0;
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let facing = dot(n, TO_LIGHT);
    if facing <= 0.0 {
        return ambient;
    }
    let mirrored = 2.0 * facing * n[2] - TO_LIGHT[2];
    ambient + kd * facing + ks * libm::pow(mirrored.max(0.0), SHINE)
}

/// Pictures that need no scene: round and flat shading, shadow edges, soft light, thin and curved parts.
fn pictures() -> Vec<Picture> {
    let mut all = Vec::new();
    for scene in embedded() {
        let scene_read = read(scene.name, scene.text.as_bytes(), &ReadOptions::default()).expect("embedded");
        let studio = std::rc::Rc::new(Studio::new(scene_read).expect("embedded"));
        for index in 0..studio.scene().views.len() {
            let studio = studio.clone();
            let camera = studio.camera(index, 1.0);
            let name = format!("{}-{}", scene.name, camera.name.clone().unwrap_or_default());
            all.push(Picture {
                name,
                light: Box::new(move |size| {
                    studio
                        .draw(&Request {
                            camera: camera.clone(),
                            dots: size,
                            dot_aspect: 1.0 * f64::from(size.height) / f64::from(size.width),
                            options: Options::default(),
                            glyphs: GlyphMode::Shade,
                            palette: Palette::Mono,
                            tone: Tone::default(),
                        })
                        .light
                }),
            });
        }
    }
    all.extend([
        picture("spheres", spheres),
        picture("boxes", boxes),
        picture("glow", glow),
        picture("columns", columns),
        picture("rings", rings),
    ]);
    all
}

fn spheres(x: f64, y: f64) -> f64 {
    for (cx, cy, r) in [(-0.45, -0.1, 0.42), (0.35, -0.25, 0.3), (0.3, 0.5, 0.35), (0.8, -0.5, 0.12)] {
        let (u, v) = ((x - cx) / r, (y - cy) / r);
        let depth = 1.0 - u * u - v * v;
        if depth >= 0.0 {
            return lit([u, v, depth.sqrt()], 0.05, 0.7, 0.3);
        }
    }
    if y >= -0.3 {
        return 0.0;
    }
    let shadows = [(-0.15, -0.62, 0.45, 0.13), (0.6, -0.6, 0.33, 0.1)];
    let in_shadow = shadows.iter().any(|(cx, cy, a, b)| {
        let (u, v) = ((x - cx) / a, (y - cy) / b);
        u * u + v * v < 1.0
    });
    if in_shadow { 0.06 } else { 0.1 - 0.25 * y }
}

/// Cubes seen along a slanted axis: a top, and two sides of different light.
fn boxes(x: f64, y: f64) -> f64 {
    for (cx, cy, size) in [(0.5, -0.4, 0.35), (-0.4, 0.1, 0.5), (0.45, 0.55, 0.2)] {
        let (u, v) = ((x - cx) / size, (y - cy) / size);
        let (a, b) = (v / 1.6 + u / 0.92, v / 1.6 - u / 0.92);
        if (0.0..1.0).contains(&a) && (0.0..1.0).contains(&b) {
            return 0.82;
        }
        if u.abs() < 0.92 && (-1.1..0.0).contains(&(v + 1.7 * u.abs())) {
            return if u < 0.0 { 0.33 } else { 0.07 };
        }
    }
    0.02
}

/// No edge anywhere: all error is the 13 levels' own.
fn glow(x: f64, y: f64) -> f64 {
    let (u, v) = (x - 0.3, y + 0.2);
    0.9 * libm::exp(-2.0 * (u * u + v * v)) + 0.025 * (x + 1.0)
}

/// Upright columns on square plinths, from five dots wide to less than one.
fn columns(x: f64, y: f64) -> f64 {
    for k in 0..9 {
        let (centre, radius) = (-0.85 + 0.21 * f64::from(k), 0.07 - 0.0065 * f64::from(k));
        let u = (x - centre) / radius;
        if u.abs() < 1.0 && y.abs() < 0.75 {
            return lit([u, 0.0, (1.0 - u * u).sqrt()], 0.06, 0.75, 0.2);
        }
        if u.abs() < 1.3 && y.abs() < 0.82 {
            return 0.55;
        }
    }
    if y < -0.75 { 0.25 } else { 0.1 + 0.08 * y }
}

/// Edges in every direction.
fn rings(x: f64, y: f64) -> f64 {
    let (radius, angle) = ((x * x + y * y).sqrt(), libm::atan2(y, x));
    if radius > 0.95 {
        0.0
    } else if libm::sin(24.0 * radius) + 0.4 * libm::sin(3.0 * angle) > 0.0 {
        0.5 + 0.4 * libm::cos(angle)
    } else {
        0.12
    }
}
