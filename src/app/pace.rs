//! How fast the picture is drawn with Turbo off: as a PC/AT of so many megahertz would have.
//!
//! Nobody wrote down what it took in 1986. It is estimated from what is known: the operations that a program
//! of the paper's stages needs, and the clocks that an 80287 takes for each.

use crate::frame::Frame;
use crate::stage::{RayEvent, Stage};

/// Clocks of an 80287 for an operation with its operands fetched and its result put away: Intel's data sheet
/// has 70 to 100 for a sum, 90 to 145 for a product, 193 to 203 for a quotient, 180 to 186 for a root and 38
/// to 104 to fetch or to store one; of three sums and products to each fetch and store about this much.
const CLOCKS: f64 = 140.0;

/// The coprocessor's clock as a part of the processor's: in a PC/AT of 6 MHz it runs at 4 MHz, in one of
/// 8 MHz at 5.3.
const COPROCESSOR: f64 = 2.0 / 3.0;

/// Processors, in megahertz: two so slow that each stage can be seen, the two PC/ATs, and faster ones.
const MEGAHERTZ: [f64; 8] = [0.01, 0.1, 1.0, 6.0, 8.0, 33.0, 133.0, 1000.0];

/// The place of the PC/AT of 8 MHz among [`MEGAHERTZ`].
const PCAT: usize = 4;

/// How fast pictures are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// Whether they are drawn as fast as it goes.
    pub turbo: bool,
    /// The processor otherwise, by its place.
    step: usize,
}

impl Pace {
    /// As fast as it goes, or as the PC/AT of 8 MHz.
    pub const fn new(turbo: bool) -> Self {
        Self { turbo, step: PCAT }
    }

    /// Turbo on where it is off, and off where it is on.
    #[must_use]
    pub const fn switched(self) -> Self {
        Self { turbo: !self.turbo, ..self }
    }

    /// The next slower processor.
    #[must_use]
    pub const fn slower(self) -> Self {
        Self { step: self.step.saturating_sub(1), ..self }
    }

    /// The next faster processor.
    #[must_use]
    pub fn faster(self) -> Self {
        Self { step: (self.step + 1).min(MEGAHERTZ.len() - 1), ..self }
    }

    /// Megahertz of the processor with Turbo off.
    pub const fn megahertz(self) -> f64 {
        MEGAHERTZ[self.step]
    }

    /// What it is called.
    pub fn name(self) -> String {
        format!("{} MHz", self.megahertz())
    }
}

/// The operations of a stage for one thing that it does: a ray from a dot (three products and sums for each
/// coordinate, and its length); an outcode and a way to a box; a step to the nearest of three planes; a test
/// of a primitive (the ray moved into its coordinates, an equation of the second degree, two planes); a
/// comparison of intervals; a point with its normal, the direction to a lamp and a power.
const fn operations(stage: Stage) -> f64 {
    match stage {
        Stage::Ray => 30.0,
        Stage::Clip => 12.0,
        Stage::Cell | Stage::Csg => 10.0,
        Stage::Solid => 60.0,
        Stage::Shade => 80.0,
        Stage::Objects | Stage::Lattice | Stage::View | Stage::Dither | Stage::Display => 0.0,
    }
}

/// The seconds that a picture would have taken on a PC/AT of one megahertz, by what it counted.
pub fn seconds(frame: &Frame) -> f64 {
    let counts = &frame.counts;
    let hits = counts.primary_hits + counts.secondary_hits;
    let done = [
        (Stage::Ray, counts.rays()),
        (Stage::Clip, counts.primary_rays),
        (Stage::Cell, counts.cells_visited),
        (Stage::Solid, counts.primitive_tests),
        (Stage::Csg, counts.csg_evaluations),
        (Stage::Shade, hits),
    ];
    let all: f64 = done.into_iter().map(|(stage, times)| operations(stage) * times as f64).sum();
    all * CLOCKS / (COPROCESSOR * 1e6)
}

/// The stages of a ray in their order, each with its part of the ray's time, 0 to 1 in all.
pub fn stages(events: &[RayEvent]) -> Vec<(Stage, f64)> {
    let all: f64 = events.iter().map(|event| operations(event.stage())).sum();
    let mut stages: Vec<(Stage, f64)> = Vec::new();
    for stage in events.iter().map(RayEvent::stage) {
        let part = operations(stage) / all;
        match stages.last_mut() {
            Some((last, share)) if *last == stage => *share += part,
            _ => stages.push((stage, part)),
        }
    }
    stages
}

/// The stage that a ray is in when so much of its time is over, 0 to 1.
pub fn stage_at(stages: &[(Stage, f64)], part: f64) -> Option<Stage> {
    let mut left = part;
    let found = stages.iter().find(|(_, share)| {
        left -= share;
        left < 0.0
    });
    found.or(stages.last()).map(|(stage, _)| *stage)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Studio, pcat};
    use crate::scene::{ReadOptions, embedded, read};

    /// The paper's picture took minutes: not seconds, and not hours.
    #[test]
    fn the_papers_picture_takes_minutes_on_its_machine() {
        let hanyang = embedded()[0];
        let scene = read("hanyang.scene", hanyang.text.as_bytes(), &ReadOptions::default()).unwrap();
        let studio = Studio::new(scene).unwrap();
        let frame = studio.draw(&pcat::request(studio.camera(0, 1.0)));
        let six = seconds(&frame) / 6.0;
        assert!((60.0..1200.0).contains(&six), "{six} s");
        assert!((seconds(&frame) / 8.0 - six * 0.75).abs() < 1e-9);
    }

    #[test]
    fn a_ray_goes_through_its_stages_in_their_order() {
        let events = [
            RayEvent::Clipped,
            RayEvent::Cell { from: 0.0, number: None },
            RayEvent::Cell { from: 1.0, number: None },
            RayEvent::Tested { primitive: 0, span: None },
            RayEvent::Missed,
        ];
        let stages = stages(&events);
        let names: Vec<Stage> = stages.iter().map(|(stage, _)| *stage).collect();
        assert_eq!(names, [Stage::Clip, Stage::Cell, Stage::Solid, Stage::Csg]);
        assert!((stages.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
        assert_eq!(stage_at(&stages, 0.0), Some(Stage::Clip));
        assert_eq!(stage_at(&stages, 0.6), Some(Stage::Solid));
        assert_eq!(stage_at(&stages, 1.0), Some(Stage::Csg));
        assert_eq!(stage_at(&[], 0.5), None);
    }

    #[test]
    fn paces_end_at_both_ends() {
        let mut pace = Pace::new(false);
        assert_eq!(pace.name(), "8 MHz");
        for _ in 0..20 {
            pace = pace.slower();
        }
        assert_eq!((pace.name().as_str(), pace.turbo), ("0.01 MHz", false));
        for _ in 0..20 {
            pace = pace.faster();
        }
        assert_eq!((pace.name().as_str(), pace.switched().turbo), ("1000 MHz", true));
    }
}
