//! Pictures that need no scene: what they hold of edges and of soft light is known.

use ray13::math::Grid;

use super::measure::Picture;

/// A picture from its light at (x, y), each from −1 to 1, x to the right and y up.
fn picture(light: impl Fn(f64, f64) -> f64 + 'static) -> Picture {
    Picture::new(move |size| {
        Grid::from_fn(size, |column, row| {
            let along = |k: u32, n: u32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
            light(along(column, size.width), -along(row, size.height))
        })
    })
}

/// Eq. (3) for a surface of normal `n` seen along z, lit from the upper left: ambient, diffuse and highlight
/// light.
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

/// Round and flat shading, soft light, thin and curved parts.
pub fn pictures() -> Vec<Picture> {
    vec![picture(spheres), picture(boxes), picture(glow), picture(columns), picture(rings)]
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
