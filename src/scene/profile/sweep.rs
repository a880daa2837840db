//! Solids that figures sweep: along z, turned and scaled slice by slice, or about z.

use std::collections::{BinaryHeap, HashMap};

use super::arcs::{Fragments, MOST_CORNERS};
use super::figure::{Figure, Region};
use crate::math::{DVec2, DVec3};
use crate::scene::triangulation::{EarClipper, cancel_pairs, triangulate_rings};
use crate::scene::{Mesh, degrees};

/// A figure swept along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSweep {
    /// The z that it begins at.
    pub bottom: f64,
    /// The z that it ends at, above that.
    pub top: f64,
    /// By how many degrees it is turned on the way, clockwise seen from above.
    pub twist: f64,
    /// By what it is scaled on the way; 0 or more.
    pub scale: DVec2,
    /// In how many slices; none leaves that to `fragments`.
    pub slices: Option<f64>,
    /// How many sides an outline has at least, where it is turned or scaled; none leaves it as it is.
    pub segments: Option<f64>,
    /// How fine curves are cut.
    pub fragments: Fragments,
}

/// A figure swept about the z axis: its x becomes the way from the axis, its y the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Revolution {
    /// How far, in degrees, counter-clockwise seen from above.
    pub angle: f64,
    /// Where it begins, in degrees from the x axis; none begins where OpenSCAD does.
    pub start: Option<f64>,
    /// How fine curves are cut.
    pub fragments: Fragments,
}

/// The straight solid over a figure.
pub fn prism(figure: &Figure, bottom: f64, top: f64, clipper: &mut EarClipper) -> Option<Mesh> {
    let slices = Some(1.0);
    let fragments = Fragments::default();
    let (twist, scale, segments) = (0.0, DVec2::ONE, None);
    LinearSweep { bottom, top, twist, scale, slices, segments, fragments }.mesh(figure, clipper)
}

impl LinearSweep {
    /// The solid; none where it would have more than [`MOST_CORNERS`].
    pub fn mesh(&self, figure: &Figure, clipper: &mut EarClipper) -> Option<Mesh> {
        let slices = self.slices(figure);
        if self.segments.is_some_and(|segments| segments > MOST_CORNERS) {
            return None;
        }
        let figure = &self.segmented(figure, slices);
        if (slices + 1.0) * figure.count() as f64 > MOST_CORNERS {
            return None;
        }
        // As OpenSCAD computes it, so that its corners are the same.
        let at = |share: f64| Layer {
            turn: -self.twist * share,
            scale: DVec2::ONE - (DVec2::ONE - self.scale) * share,
            z: if share == 1.0 { self.top } else { self.bottom + (self.top - self.bottom) * share },
        };
        let layers: Vec<Layer> = (0..=slices as usize).map(|slice| at(slice as f64 / slices)).collect();
        let mut sweep = Sweep::default();
        let place = |layer: usize, p: DVec2| layers[layer].place(p);
        for layer in 0..layers.len() {
            sweep.layer(figure, |p| place(layer, p));
        }
        let back = self.twist < 0.0;
        for layer in 1..layers.len() {
            // At an end that is a point or a line the other diagonal keeps triangles from being flat.
            let is_end = layers[layer].scale.min_element() == 0.0;
            let first_diagonal = |is_hole: bool, low: [DVec3; 2], high: [DVec3; 2]| {
                let order = shorter(low[0] - high[1], low[1] - high[0]);
                (order < 0 || (order == 0 && is_hole == back)) != is_end
            };
            sweep.band(figure, layer - 1, layer, first_diagonal);
        }
        sweep.cap(figure, 0, clipper);
        sweep.cap(figure, layers.len() - 1, clipper);
        Some(sweep.mesh())
    }

    fn slices(&self, figure: &Figure) -> f64 {
        let most = |measure: &dyn Fn(DVec2) -> f64| figure.corners().map(measure).fold(0.0, f64::max);
        let height = self.top - self.bottom;
        let shift = || most(&|p| (p - p * self.scale).length());
        let scale = if self.scale.x == self.scale.y { self.scale.x } else { 1.0 };
        match self.slices {
            Some(slices) => slices.trunc().max(1.0),
            None if self.twist != 0.0 => {
                let twisted = self.fragments.of_twist(most(&DVec2::length), height, self.twist, scale);
                let is_uneven = self.scale.x != self.scale.y;
                if is_uneven { twisted.max(self.fragments.of_shift(shift(), height)) } else { twisted }
            }
            None if self.scale.x != self.scale.y => self.fragments.of_shift(shift(), height),
            None => 1.0,
        }
    }
}

impl LinearSweep {
    /// The figure with its longest sides cut, until each outline has so many of them, as OpenSCAD does it:
    /// sides that are equally long are cut together, or not at all.
    fn segmented(&self, figure: &Figure, slices: f64) -> Figure {
        let Some(wanted) = self.segments else { return figure.clone() };
        let at = |share: f64| Layer {
            turn: -self.twist * share,
            scale: DVec2::ONE - (DVec2::ONE - self.scale) * share,
            z: 0.0,
        };
        let layers: Vec<Layer> = if self.scale.x == self.scale.y {
            vec![at(if self.scale.x > 1.0 { 1.0 } else { 0.0 })]
        } else {
            (0..=slices.min(MOST_CORNERS) as usize).map(|slice| at(slice as f64 / slices)).collect()
        };
        let cut = |ring: &Vec<DVec2>| {
            let ends = |i: usize| [ring[i], ring[(i + 1) % ring.len()]];
            let length = |i: usize| {
                let [from, to] = ends(i);
                let way = |layer: &Layer| (layer.place(to) - layer.place(from)).length();
                layers.iter().map(way).fold(0.0, f64::max)
            };
            let counts = counts_of_segments(&(0..ring.len()).map(length).collect::<Vec<_>>(), wanted);
            let parts = |(i, &count): (usize, &u32)| {
                let [from, to] = ends(i);
                (0..count).map(move |part| {
                    let share = f64::from(part) / f64::from(count);
                    from * (1.0 - share) + to * share
                })
            };
            counts.iter().enumerate().flat_map(parts).collect()
        };
        let region = |region: &Region| Region {
            outer: cut(&region.outer),
            holes: region.holes.iter().map(cut).collect(),
        };
        Figure { regions: figure.regions.iter().map(region).collect(), error: figure.error }
    }
}

/// Into how many parts sides of these lengths are cut, so that there are at most `wanted` of them.
fn counts_of_segments(lengths: &[f64], wanted: f64) -> Vec<u32> {
    // By what a side would be, cut once more: between its parts as they are and as they would be.
    let metric = |i: usize, count: u32| lengths[i] / (f64::from(count) + 0.5);
    let mut counts = vec![1_u32; lengths.len()];
    let order = |value: f64| value.max(0.0).to_bits();
    let mut heap: BinaryHeap<(u64, usize)> = (0..lengths.len()).map(|i| (order(metric(i, 1)), i)).collect();
    let mut total = lengths.len();
    while (total as f64) < wanted {
        let Some(&(largest, _)) = heap.peek() else { break };
        let mut group = Vec::new();
        while let Some(&(next, i)) = heap.peek()
            && f64::from_bits(next) >= 0.999 * f64::from_bits(largest)
        {
            heap.pop();
            group.push(i);
        }
        total += group.len();
        if total as f64 > wanted {
            break;
        }
        for i in group {
            counts[i] += 1;
            heap.push((order(metric(i, counts[i])), i));
        }
    }
    counts
}

/// Below 0 where the first way is shorter by more than a rounding, above where the second is.
fn shorter(a: DVec3, b: DVec3) -> i32 {
    let (a, b) = (a.truncate().length(), b.truncate().length());
    if (a - b).abs() * 2e5 <= a + b {
        0
    } else if a < b {
        -1
    } else {
        1
    }
}

#[derive(Clone, Copy, Debug)]
struct Layer {
    turn: f64,
    scale: DVec2,
    z: f64,
}

impl Layer {
    fn place(&self, p: DVec2) -> DVec3 {
        let (sine, cosine) = (degrees::sin(self.turn), degrees::cos(self.turn));
        let turned = DVec2::new(p.x * cosine - p.y * sine, p.x * sine + p.y * cosine);
        (turned * self.scale).extend(self.z)
    }
}

/// Why a figure can not be swept about an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoRevolution {
    /// It lies on both sides of the axis.
    Crosses,
    /// It would have more than [`MOST_CORNERS`].
    TooMany,
}

impl Revolution {
    /// The solid.
    pub fn mesh(&self, figure: &Figure, clipper: &mut EarClipper) -> Result<Mesh, NoRevolution> {
        let xs = || figure.corners().map(|p| p.x);
        let (low, high) = (xs().fold(0.0, f64::min), xs().fold(0.0, f64::max));
        if low < 0.0 && high > 0.0 {
            return Err(NoRevolution::Crosses);
        }
        let is_whole = self.angle.abs() >= 360.0;
        let angle = if is_whole { 360.0 } else { self.angle };
        let steps = (self.fragments.of_circle(high - low) * angle.abs() / 360.0).floor().max(1.0);
        if (steps + 1.0) * figure.count() as f64 > MOST_CORNERS {
            return Err(NoRevolution::TooMany);
        }
        // What is swept all the way begins at −x, as it always did in OpenSCAD.
        let start = self.start.unwrap_or(if is_whole { 180.0 } else { 0.0 });
        let (steps, layers) = (steps as usize, steps as usize + usize::from(!is_whole));
        let mut sweep = Sweep::default();
        for layer in 0..layers {
            let at = start + angle * layer as f64 / steps as f64;
            let (sine, cosine) = (degrees::sin(at), degrees::cos(at));
            sweep.layer(figure, |p| DVec3::new(p.x * cosine, p.x * sine, p.y));
        }
        // Of the two diagonals that from the first corner of each side as OpenSCAD goes round.
        let is_first = (low >= 0.0 && angle > 0.0 && !is_whole) || (low < 0.0 && (angle < 0.0 || is_whole));
        for step in 0..steps {
            sweep.band(figure, step, (step + 1) % layers, |_, _, _| !is_first);
        }
        if !is_whole {
            sweep.cap(figure, 0, clipper);
            sweep.cap(figure, layers - 1, clipper);
        }
        Ok(sweep.mesh())
    }
}

/// A surface as it is made, layer by layer. Points that are equal are one, so that what meets in an axis, a
/// tip or an edge is closed.
#[derive(Default)]
struct Sweep {
    points: Vec<DVec3>,
    numbers: HashMap<[u64; 3], u32>,
    /// By layer: the points of the figure's corners.
    layers: Vec<Vec<u32>>,
    triangles: Vec<([u32; 3], ())>,
}

impl Sweep {
    fn layer(&mut self, figure: &Figure, place: impl Fn(DVec2) -> DVec3) {
        let mut layer = Vec::with_capacity(figure.count());
        for corner in figure.corners() {
            // Adding 0 makes −0 and 0 the same.
            let point = place(corner) + DVec3::ZERO;
            let next = self.points.len() as u32;
            let number = *self.numbers.entry(point.to_array().map(f64::to_bits)).or_insert(next);
            if number == next {
                self.points.push(point);
            }
            layer.push(number);
        }
        self.layers.push(layer);
    }

    fn give(&mut self, triangle: [u32; 3]) {
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            self.triangles.push((triangle, ()));
        }
    }

    /// The sides between two layers. `is_first` chooses a diagonal by whether the outline is that of a hole,
    /// and by the ends of a side below and above.
    fn band(
        &mut self,
        figure: &Figure,
        low: usize,
        high: usize,
        is_first: impl Fn(bool, [DVec3; 2], [DVec3; 2]) -> bool,
    ) {
        let mut start = 0;
        for region in &figure.regions {
            for (number, ring) in region.rings().enumerate() {
                for i in 0..ring.len() {
                    let side = [start + i, start + (i + 1) % ring.len()];
                    let below = side.map(|i| self.layers[low][i]);
                    let above = side.map(|i| self.layers[high][i]);
                    let place = |numbers: [u32; 2]| numbers.map(|i| self.points[i as usize]);
                    let ([a, b], [c, d]) = (below, above);
                    if is_first(number > 0, place(below), place(above)) {
                        self.give([a, b, d]);
                        self.give([a, d, c]);
                    } else {
                        self.give([a, b, c]);
                        self.give([b, d, c]);
                    }
                }
                start += ring.len();
            }
        }
    }

    /// The figure itself, in a layer.
    fn cap(&mut self, figure: &Figure, layer: usize, clipper: &mut EarClipper) {
        let mut start = 0;
        for region in &figure.regions {
            let rings: Vec<&[DVec2]> = region.rings().map(Vec::as_slice).collect();
            let numbers = &self.layers[layer][start..];
            let mut triangles = Vec::new();
            triangulate_rings(&rings, clipper, |triangle| {
                triangles.push(triangle.map(|i| numbers[i as usize]));
            });
            for triangle in triangles {
                self.give(triangle);
            }
            start += rings.iter().map(|ring| ring.len()).sum::<usize>();
        }
    }

    fn mesh(mut self) -> Mesh {
        cancel_pairs(&mut self.triangles);
        let mut triangles: Vec<[u32; 3]> =
            self.triangles.into_iter().map(|(triangle, ())| triangle).collect();
        triangles.shrink_to_fit();
        self.points.shrink_to_fit();
        Mesh { points: self.points, triangles }
    }
}
