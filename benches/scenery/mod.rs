//! Scenes of any number of objects: spheres and cylinders, evenly spread over a cube or in clusters.

use std::io::{self, Write};

use ray13::math::DVec3;

/// A scene that can be written.
#[derive(Clone, Copy, Debug)]
pub struct Scenery {
    /// How many objects.
    pub objects: u64,
    /// What they are.
    pub shape: Shape,
    /// Where they stand.
    pub spread: Spread,
    /// Another number gives another scene.
    pub seed: u64,
}

/// What the objects are.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Spheres.
    Spheres,
    /// Open cylinders, pointing anywhere.
    Cylinders,
    /// Spheres, cylinders and cones in turn.
    Mixed,
}

/// Where the objects stand.
#[derive(Clone, Copy, Debug)]
pub enum Spread {
    /// Anywhere in a cube, one place as likely as another.
    Even,
    /// In clusters of many sizes, each denser towards its middle.
    Clustered,
}

/// From here, 456 away, a field of 45° holds the ball around the cube of [`HALF`]: 100 · √3 / sin 22.5° =
/// 453.
const VIEW: &str = "\
v
from -150 -400 160
at 0 0 0
up 0 0 1
angle 45
hither 1
resolution 512 512
l -300 -300 500
l 400 -200 100
";

/// Ivory, brick, slate and moss. None is a mirror: it is the number of objects that is to be measured.
const FILLS: [&str; 4] = ["0.95 0.92 0.85", "0.8 0.4 0.3", "0.45 0.5 0.6", "0.5 0.6 0.35"];

/// Half an edge of the cube in which everything stands.
const HALF: f64 = 100.0;
/// Objects of a cluster.
const CLUSTER: u64 = 1000;
/// How far a cluster reaches to each side, from the smallest to the largest.
const CLUSTER_HALF: [f64; 2] = [2.0, 15.0];

/// Radii as shares of the distance between neighbours in a cubic grid of as many objects: so a picture is
/// about as full whatever their number.
const RADIUS: [f64; 2] = [0.1, 0.4];
/// Half the lengths of cylinders and cones, in the same measure.
const HALF_LENGTH: [f64; 2] = [0.2, 0.6];

impl Scenery {
    /// Writes the scene as NFF.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut chance = Chance(self.seed);
        out.write_all(VIEW.as_bytes())?;
        let mut region = Region { center: DVec3::ZERO, half: HALF, objects: self.objects };
        let per_fill = self.objects.div_ceil(FILLS.len() as u64).max(1);
        for object in 0..self.objects {
            if object % per_fill == 0 {
                writeln!(out, "f {} 0.8 0 1 0 1", FILLS[(object / per_fill) as usize])?;
            }
            let place = match self.spread {
                Spread::Even => region.center + region.half * chance.point(),
                Spread::Clustered => {
                    if object % CLUSTER == 0 {
                        region = Region::cluster(&mut chance, self.objects - object);
                    }
                    // The mean of two even numbers is most often near the middle.
                    region.center + region.half * 0.5 * (chance.point() + chance.point())
                }
            };
            self.object(object, place, region.spacing(), &mut chance, out)?;
        }
        Ok(())
    }

    fn object(
        &self,
        number: u64,
        DVec3 { x, y, z }: DVec3,
        spacing: f64,
        chance: &mut Chance,
        out: &mut impl Write,
    ) -> io::Result<()> {
        let radius = spacing * chance.within(RADIUS);
        let top = match (self.shape, number % 3) {
            (Shape::Spheres, _) | (Shape::Mixed, 0) => {
                return writeln!(out, "s {x:.6} {y:.6} {z:.6} {radius:.6}");
            }
            (Shape::Cylinders, _) | (Shape::Mixed, 1) => radius,
            (Shape::Mixed, _) => 0.0,
        };
        let half = chance.direction() * spacing * chance.within(HALF_LENGTH);
        let (base, apex) = (DVec3 { x, y, z } - half, DVec3 { x, y, z } + half);
        write!(out, "c {:.6} {:.6} {:.6} {radius:.6} ", base.x, base.y, base.z)?;
        writeln!(out, "{:.6} {:.6} {:.6} {top:.6}", apex.x, apex.y, apex.z)
    }
}

/// A cube in which objects stand.
struct Region {
    center: DVec3,
    half: f64,
    objects: u64,
}

impl Region {
    /// Somewhere in the whole cube, for the next of the objects that are `left`.
    fn cluster(chance: &mut Chance, left: u64) -> Self {
        let half = chance.within(CLUSTER_HALF);
        Self { center: (HALF - half) * chance.point(), half, objects: left.min(CLUSTER) }
    }

    /// The distance between neighbours in a cubic grid.
    fn spacing(&self) -> f64 {
        2.0 * self.half / libm::cbrt(self.objects as f64)
    }
}

/// Random numbers that are the same in every run: Steele, Lea and Flood's `SplitMix64` (OOPSLA 2014).
struct Chance(u64);

impl Chance {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Even in `low..high`.
    fn within(&mut self, [low, high]: [f64; 2]) -> f64 {
        // 53 bits over 2^53.
        let share = (self.bits() >> 11) as f64 * (0.5 * f64::EPSILON);
        low + (high - low) * share
    }

    /// Even in the cube `−1..1`.
    fn point(&mut self) -> DVec3 {
        DVec3::from_array([0; 3].map(|_| self.within([-1.0, 1.0])))
    }

    /// Of length 1, even on the sphere.
    fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point();
            // Of shorter ones the digits would count for too little.
            if (0.01..=1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }
}
