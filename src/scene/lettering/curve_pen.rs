//! Takes the outline of a letter, and cuts its curves into sides.

use skrifa::outline::OutlinePen;

use crate::math::DVec2;

/// What FreeType counts by: 64ths of a dot.
const OF_DOT: f64 = 64.0;

/// The outline of a letter as it is drawn, in 64ths of a dot.
#[derive(Clone, Debug)]
pub struct CurvePen {
    /// How many sides a curve is cut into.
    sides: u32,
    /// How many corners more there may be; what goes beyond is left out.
    room: usize,
    /// The outlines, the one that is open last.
    pub outlines: Vec<Vec<DVec2>>,
    at: DVec2,
    /// The lowest coordinates of all corners, those that pull curves among them.
    low: DVec2,
    /// The highest.
    high: DVec2,
}

impl CurvePen {
    pub fn new(sides: u32, room: usize) -> Self {
        let (low, high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        Self { sides, room, outlines: Vec::new(), at: DVec2::ZERO, low, high }
    }

    /// The lowest and highest coordinates, to whole dots outwards; of what is not drawn 0.
    pub fn box_of_dots(&self) -> [DVec2; 2] {
        if self.low.x > self.high.x {
            return [DVec2::ZERO; 2];
        }
        [(self.low / OF_DOT).floor() * OF_DOT, (self.high / OF_DOT).ceil() * OF_DOT]
    }

    /// How many corners more there may be; 0 where that was too few.
    pub fn room(&self) -> usize {
        self.room
    }

    fn meet(&mut self, x: f32, y: f32) -> DVec2 {
        // FreeType has whole numbers here; the pen is given them as exact parts.
        let place = DVec2::new(f64::from(x), f64::from(y)) * OF_DOT;
        (self.low, self.high) = (self.low.min(place), self.high.max(place));
        place
    }

    fn corner(&mut self, place: DVec2) {
        if let (Some(outline), 1..) = (self.outlines.last_mut(), self.room) {
            self.room -= 1;
            outline.push(place);
        }
    }
}

impl OutlinePen for CurvePen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.at = self.meet(x, y);
        self.outlines.push(Vec::new());
        self.corner(self.at);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.at = self.meet(x, y);
        self.corner(self.at);
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        let (from, by, to) = (self.at, self.meet(cx0, cy0), self.meet(x, y));
        for side in 1..=self.sides.min(self.room as u32) {
            let t = f64::from(side) / f64::from(self.sides);
            let rest = 1.0 - t;
            self.corner(from * (rest * rest) + by * (2.0 * rest * t) + to * (t * t));
        }
        self.at = to;
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let (from, to) = (self.at, [self.meet(cx0, cy0), self.meet(cx1, cy1), self.meet(x, y)]);
        for side in 1..=self.sides.min(self.room as u32) {
            let t = f64::from(side) / f64::from(self.sides);
            let rest = 1.0 - t;
            let shares = [3.0 * rest * rest * t, 3.0 * rest * t * t, t * t * t];
            let pulled = to[0] * shares[0] + to[1] * shares[1] + to[2] * shares[2];
            self.corner(from * (rest * rest * rest) + pulled);
        }
        self.at = to[2];
    }

    fn close(&mut self) {}
}
