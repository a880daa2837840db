//! Bézier patches in the world: where a line crosses them, by Newton's method from every place near that.

use ray13::math::{DAffine3, DVec3};
use ray13::scene::BezierPatches;

use super::ball::Ball;
use super::number::{Number, cross, dot, unit};
use super::side::{Row, mapped, place};

/// A patch in the world.
#[derive(Clone, Debug)]
pub struct Patch<N> {
    points: Vec<[N; 3]>,
    /// A ball around it.
    pub ball: Ball,
}

/// Where a line crosses a patch.
pub struct OnPatch<N> {
    pub t: N,
    /// Of length 1, turned either way.
    pub normal: DVec3,
}

/// So often a patch is halved along each parameter before a crossing is looked for in a part of it.
const HALVINGS: u32 = 6;

/// Crossings of one patch whose parameters are nearer than this are one, or too near a silhouette to tell.
const SAME: f64 = 1e-8;

/// A polynomial of third degree in both parameters: its control values, four rows of four, in numbers that
/// are good enough to look for a root.
type Net = [f64; 16];

impl<N: Number> Patch<N> {
    /// All patches, moved by a map.
    pub fn of(patches: &BezierPatches, map: &DAffine3) -> Vec<Self> {
        let points: Vec<[N; 3]> = patches.points().iter().map(|&p| place(&mapped(map, p))).collect();
        patches.patches().iter().map(|patch| Self::new(&patch.map(|i| points[i as usize].clone()))).collect()
    }

    fn new(points: &[[N; 3]; 16]) -> Self {
        let rounded = points.clone().map(|p| DVec3::from_array(p.map(|x| x.value())));
        Self { points: points.to_vec(), ball: Ball::around(&rounded) }
    }

    /// Where the line crosses it: both of two planes through the line at once.
    pub fn crossings(&self, o: &Row<N>, d: &Row<N>) -> Vec<OnPatch<N>> {
        let (o, d) = (place(o), place(d));
        // The axis that the line goes least far on.
        let least =
            (0..3).min_by(|&a, &b| d[a].abs().partial_cmp(&d[b].abs()).expect("numbers")).unwrap_or(0);
        let axis: [N; 3] = std::array::from_fn(|i| N::from(f64::from(u8::from(i == least))));
        let first = cross(&d, &axis);
        let second = cross(&d, &first);
        let planes = [first, second];
        let heights = planes.clone().map(|normal| {
            let scale = N::from(normal.iter().map(|x| x.abs().value()).fold(0.0, f64::max));
            let normal = normal.map(|x| x / scale.clone());
            let heights: Vec<N> = self.points.iter().map(|p| dot(&normal, &minus(p, &o))).collect();
            heights
        });
        let nets: [Net; 2] = [0, 1].map(|k| std::array::from_fn(|i| heights[k][i].value()));
        let mut roots: Vec<[f64; 2]> = Vec::new();
        for start in starts(&nets) {
            let same = |other: &[f64; 2], uv: [f64; 2]| {
                (other[0] - uv[0]).abs().max((other[1] - uv[1]).abs()) < SAME
            };
            if let Some(uv) = newton(&nets, start)
                && !roots.iter().any(|other| same(other, uv))
            {
                roots.push(uv);
            }
        }
        let exact = roots.into_iter().filter_map(|uv| polished(&heights, uv));
        exact.map(|uv| self.at(&o, &d, &uv)).collect()
    }

    fn at(&self, o: &[N; 3], d: &[N; 3], uv: &[N; 2]) -> OnPatch<N> {
        let axis = |i: usize| evaluated(&self.points.iter().map(|p| p[i].clone()).collect::<Vec<_>>(), uv);
        let [x, y, z] = [axis(0), axis(1), axis(2)];
        let part = |k: usize| [x[k].clone(), y[k].clone(), z[k].clone()];
        let t = dot(&minus(&part(0), o), d) / dot(d, d);
        OnPatch { t, normal: unit(&cross(&part(1), &part(2))) }
    }
}

fn minus<N: Number>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    std::array::from_fn(|i| a[i].clone() - b[i].clone())
}

/// The middles of all parts whose control values do not say that there is no root in them.
fn starts(nets: &[Net; 2]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    let mut open = vec![(*nets, [0.0, 0.0], 0)];
    while let Some((nets, from, halved)) = open.pop() {
        let is_beside = |net: &Net| {
            // A thousandth more than the hull: whatever rounding took, and the crossings of neighbours.
            let most = net.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
            net.iter().all(|&x| x > 1e-3 * most) || net.iter().all(|&x| x < -1e-3 * most)
        };
        if nets.iter().any(is_beside) {
            continue;
        }
        let size = |axis: u32| 1.0 / f64::from(1_u32 << ((halved + 1 - axis) / 2));
        if halved == 2 * HALVINGS {
            found.push([from[0] + 0.5 * size(0), from[1] + 0.5 * size(1)]);
            continue;
        }
        let axis = halved % 2;
        for second in [false, true] {
            let half = nets.map(|net| half(&net, axis == 0, second));
            let mut from = from;
            if second {
                from[axis as usize] += 0.5 * size(axis);
            }
            open.push((half, from, halved + 1));
        }
    }
    found
}

fn half(net: &Net, along_rows: bool, second: bool) -> Net {
    let mut part = [0.0; 16];
    for line in 0..4 {
        let at = |i: usize| if along_rows { 4 * line + i } else { 4 * i + line };
        let mut points = [0, 1, 2, 3].map(|i| net[at(if second { 3 - i } else { i })]);
        let mut own = [points[0]; 4];
        for i in 1..4 {
            for k in 0..4 - i {
                points[k] = 0.5 * points[k] + 0.5 * points[k + 1];
            }
            own[i] = points[0];
        }
        for i in 0..4 {
            part[at(if second { 3 - i } else { i })] = own[i];
        }
    }
    part
}

/// Value and both derivatives.
fn evaluated<N: Number>(net: &[N], [u, v]: &[N; 2]) -> [N; 3] {
    let weights = |t: &N| {
        let (s, three) = (N::from(1.0) - t.clone(), N::from(3.0));
        let product = |a: &N, b: &N, c: &N| a.clone() * b.clone() * c.clone();
        let values = [
            product(&s, &s, &s),
            three.clone() * product(&s, &s, t),
            three.clone() * product(&s, t, t),
            product(t, t, t),
        ];
        let (ss, st, tt) = (s.clone() * s.clone(), s.clone() * t.clone(), t.clone() * t.clone());
        let slopes = [
            -(three.clone() * ss.clone()),
            three.clone() * (ss - N::from(2.0) * st.clone()),
            three.clone() * (N::from(2.0) * st - tt.clone()),
            three * tt,
        ];
        [values, slopes]
    };
    let (of_u, of_v) = (weights(u), weights(v));
    let sum = |a: usize, b: usize| {
        (0..16).fold(N::from(0.0), |sum, i| {
            sum + net[i].clone() * of_u[a][i % 4].clone() * of_v[b][i / 4].clone()
        })
    };
    [sum(0, 0), sum(1, 0), sum(0, 1)]
}

/// One step of Newton's method.
fn step<N: Number>(heights: [&[N]; 2], uv: &[N; 2]) -> Option<[N; 2]> {
    let [f, g] = heights.map(|net| evaluated(net, uv));
    let area = f[1].clone() * g[2].clone() - f[2].clone() * g[1].clone();
    if area.is_zero() {
        return None;
    }
    let u = (f[0].clone() * g[2].clone() - f[2].clone() * g[0].clone()) / area.clone();
    let v = (f[1].clone() * g[0].clone() - f[0].clone() * g[1].clone()) / area;
    Some([uv[0].clone() - u, uv[1].clone() - v])
}

/// A number with no more bits than f64 has.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Plain(f64);

macro_rules! plain_operators {
    ($($name:ident $of:ident $sign:tt),*) => {$(
        impl std::ops::$name for Plain {
            type Output = Self;
            fn $of(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    )*};
}
plain_operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl std::ops::Neg for Plain {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<f64> for Plain {
    fn from(x: f64) -> Self {
        Self(x)
    }
}

impl Number for Plain {
    fn value(&self) -> f64 {
        self.0
    }

    fn sqrt(&self) -> Self {
        Self(self.0.max(0.0).sqrt())
    }
}

/// A root near a place, to the digits of f64; none where there is none.
fn newton(nets: &[Net; 2], start: [f64; 2]) -> Option<[f64; 2]> {
    let nets = nets.map(|net| net.map(Plain));
    let mut uv = start.map(Plain);
    for _ in 0..30 {
        let next = step([&nets[0], &nets[1]], &uv)?;
        let moved = (next[0].0 - uv[0].0).abs().max((next[1].0 - uv[1].0).abs());
        uv = next;
        let is_near = |x: &Plain| (-0.1..=1.1).contains(&x.0);
        if !uv.iter().all(is_near) {
            return None;
        }
        if moved < 1e-11 {
            return Some(uv.map(|x| x.0));
        }
    }
    None
}

/// A root to all digits, if it is in the patch. A side belongs to the patch where its parameter is 0.
fn polished<N: Number>(heights: &[Vec<N>; 2], uv: [f64; 2]) -> Option<[N; 2]> {
    let mut uv = uv.map(N::from);
    // Digits double each time: 36 bits, 72, 144, 288, 576.
    for _ in 0..5 {
        uv = step([&heights[0], &heights[1]], &uv)?;
    }
    let one = N::from(1.0);
    uv.iter().all(|x| x.sign() >= 0 && *x < one).then_some(uv)
}
