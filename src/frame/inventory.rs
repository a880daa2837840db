//! What a picture has of each object: how much of it, where, how far away, and what stands before what.

use std::collections::{BTreeMap, BTreeSet};

use crate::math::{Bounds, Grid, Size};
use crate::plan::{Options, Shading};
use crate::view::{Picture, PinholeCamera};

use super::{Frame, NothingInView, Request, Studio, Wants};

/// From dot to dot a surface that is seen at 72° or less to its normal gets no farther than three dots are
/// wide; where two objects are farther from each other, one stands before the other.
const STEEPEST: f64 = 3.0;

/// So many times as far as the nearer surface goes on by itself from dot to dot, as a floor does that is seen
/// from low above it, it may go on to the next dot: what is no farther touches it. Twice, since a floor's
/// steps grow, but not to the double unless it is seen within two dots of its horizon.
const GOING_ON: f64 = 2.0;

/// All objects of a scene, as a picture has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Inventory {
    /// Those that are seen, the largest in the picture first.
    pub seen: Vec<SeenObject>,
    /// The others, in the order of the file.
    pub unseen: Vec<UnseenObject>,
    /// The share of the dots that see nothing.
    pub background: f64,
}

/// An object that is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenObject {
    /// Its number in the file, from 0.
    pub object: u32,
    /// The share of the dots that see it.
    pub share: f64,
    /// The mean of their places across and down, as shares of the picture.
    pub middle: [f64; 2],
    /// How much of the picture's width and height lie between the outermost of them.
    pub extent: [f64; 2],
    /// The least and the greatest distance from the eye, in the scene's unit.
    pub distance: [f64; 2],
    /// The objects that it stands before, by their numbers in the file.
    pub before: Vec<u32>,
}

/// An object of which no dot is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnseenObject {
    /// Its number in the file, from 0.
    pub object: u32,
    /// Why, as far as its box tells: what is in the field is hidden, or between the rays.
    pub why: NothingInView,
}

/// What a dot sees.
#[derive(Clone, Copy)]
struct SeenByDot {
    /// The number of the object, from 1; 0 where nothing is seen.
    object: u32,
    depth: f64,
}

/// What the dots of an object come to.
struct Extents {
    dots: u32,
    sums: [f64; 2],
    least: [u32; 2],
    most: [u32; 2],
    distance: [f64; 2],
}

impl Studio {
    /// Traces the middles of a picture's dots, without light, and says what they see of each object.
    pub fn inventory(&self, request: &Request) -> Inventory {
        let wants = Wants { cells: false, ..Wants::ALL };
        let (shading, samples) = (Shading::Lambert, 1);
        let options = Options { shading, samples, shadows: false, adaptive: None, ..request.options };
        let frame = self.draw(&Request { options, wants, ..request.clone() });
        let picture = Picture { dots: request.dots, dot_aspect: request.dot_aspect };
        let pinhole = PinholeCamera::new(&request.camera, &picture);
        let seen = seen(&frame, pinhole.least_dot());
        let numbers: BTreeSet<u32> = seen.iter().map(|object| object.object).collect();
        let boxes: BTreeMap<u32, Bounds> =
            self.assembly.objects.iter().map(|object| (object.number, object.bounds)).collect();
        let all = 0..self.scene().objects.len() as u32;
        let unseen = all.filter(|number| !numbers.contains(number)).map(|object| {
            let of_box = |bounds| NothingInView::of_box(bounds, &self.assembly, &pinhole);
            UnseenObject { object, why: boxes.get(&object).map_or(NothingInView::NoObjects, of_box) }
        });
        let all: f64 = seen.iter().map(|object| object.share).sum();
        Inventory { background: (1.0 - all).max(0.0), unseen: unseen.collect(), seen }
    }
}

/// The objects that are seen; `dot` is how wide a dot is at the distance 1.
fn seen(frame: &Frame, dot: f64) -> Vec<SeenObject> {
    let (Some(objects), Some(depths)) = (&frame.object, &frame.depth) else { return Vec::new() };
    let dots = Grid::from_fn(objects.size(), |column, row| SeenByDot {
        object: objects[(column, row)],
        depth: depths[(column, row)],
    });
    let before = occlusions(&dots, dot);
    let size = [dots.size().width, dots.size().height].map(f64::from);
    let object = |(number, own): (u32, Extents)| SeenObject {
        object: number - 1,
        share: f64::from(own.dots) / (size[0] * size[1]),
        middle: std::array::from_fn(|axis| own.sums[axis] / f64::from(own.dots) / size[axis]),
        extent: std::array::from_fn(|axis| f64::from(own.most[axis] - own.least[axis] + 1) / size[axis]),
        distance: own.distance,
        before: before
            .range([number, 0]..=[number, u32::MAX])
            .filter(|(_, times)| **times > 0)
            .map(|([_, far], _)| far - 1)
            .collect(),
    };
    let mut all: Vec<SeenObject> = extents(&dots).into_iter().map(object).collect();
    // Of two that are as large the first in the file comes first.
    all.sort_by(|one, other| other.share.total_cmp(&one.share));
    all
}

/// Where the dots of each object are, by its number from 1.
fn extents(dots: &Grid<SeenByDot>) -> BTreeMap<u32, Extents> {
    let mut all: BTreeMap<u32, Extents> = BTreeMap::new();
    for row in 0..dots.size().height {
        for column in 0..dots.size().width {
            let SeenByDot { object, depth } = dots[(column, row)];
            if object == 0 {
                continue;
            }
            let place = [column, row];
            let own = all.entry(object).or_insert(Extents {
                dots: 0,
                sums: [0.0; 2],
                least: place,
                most: place,
                distance: [depth; 2],
            });
            own.dots += 1;
            own.distance = [own.distance[0].min(depth), own.distance[1].max(depth)];
            for axis in 0..2 {
                own.sums[axis] += f64::from(place[axis]) + 0.5;
                own.least[axis] = own.least[axis].min(place[axis]);
                own.most[axis] = own.most[axis].max(place[axis]);
            }
        }
    }
    all
}

/// By the numbers of two objects, from 1: how many more pairs of neighbours see the first before the second
/// than the other way round.
fn occlusions(dots: &Grid<SeenByDot>, dot: f64) -> BTreeMap<[u32; 2], i64> {
    let Size { width, height } = dots.size();
    let mut all = BTreeMap::new();
    for row in 0..height {
        for column in 0..width {
            for [across, down] in [[1, 0], [0, 1]] {
                let (at, beside) = ((column, row), (column + across, row + down));
                if beside.0 == width || beside.1 == height {
                    continue;
                }
                let [one, other] = [dots[at], dots[beside]];
                let is_first = one.depth <= other.depth;
                let (near, far) = if is_first { (one, other) } else { (other, one) };
                if near.object == 0 || far.object == 0 || near.object == far.object {
                    continue;
                }
                // The dot beyond the nearer, away from the farther.
                let beyond = if is_first {
                    (column.wrapping_sub(across), row.wrapping_sub(down))
                } else {
                    (beside.0 + across, beside.1 + down)
                };
                let is_own = beyond.0 < width && beyond.1 < height && dots[beyond].object == near.object;
                let step = if is_own { (dots[beyond].depth - near.depth).abs() } else { 0.0 };
                if far.depth - near.depth > f64::max(STEEPEST * dot * near.depth, GOING_ON * step) {
                    *all.entry([near.object, far.object]).or_default() += 1;
                    *all.entry([far.object, near.object]).or_default() -= 1;
                }
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::DVec3;
    use crate::scene::{Camera, ReadOptions, read};
    use crate::tone::Tone;

    #[test]
    fn a_ball_before_a_wall_hides_another() {
        let text = "translate([0, 5, 0]) cube([20, 1, 20], center = true); sphere(1);
            translate([0, 2, 0]) sphere(0.5); translate([0, -20, 0]) sphere(1); translate([0, 0, 90]) sphere(1);
            translate([0, -3, 0]) sphere(1e-4);";
        let studio = Studio::new(read("a", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap();
        let camera = Camera {
            eye: DVec3::new(0.0, -10.0, 0.0),
            target: DVec3::ZERO,
            field: [40.0, 40.0],
            ..studio.camera(0, 1.0)
        };
        let inventory = studio.inventory(&Request {
            camera,
            dots: Size::new(60, 60),
            dot_aspect: 1.0,
            options: Options::default(),
            wants: Wants::LIGHT,
            glyphs: GlyphMode::Shade,
            palette: Palette::DOS,
            tone: Tone::Lightness,
        });
        let [wall, ball] = &inventory.seen[..] else { panic!("{inventory:?}") };
        assert_eq!((wall.object, ball.object), (0, 1));
        assert_eq!((&wall.before[..], &ball.before[..]), (&[][..], &[0][..]));
        assert!((ball.middle[0] - 0.5).abs() < 1e-9 && (ball.distance[0] - 9.0).abs() < 0.01);
        // The tangent of its radius is 1/√99, that of half the field 0.364.
        assert!((ball.extent[0] - 0.1005 / 0.364).abs() < 0.04, "{ball:?}");
        let why: Vec<_> = inventory.unseen.iter().map(|unseen| (unseen.object, unseen.why)).collect();
        assert_eq!(
            why,
            [
                (2, NothingInView::Unknown),
                (3, NothingInView::Behind),
                (4, NothingInView::Beside),
                (5, NothingInView::TooSmall)
            ]
        );
        assert_eq!(inventory.background, 0.0);
    }
}
