//! Stage 7, SOLID: eight rays, each with a primitive of its own.
//!
//! Rays that run apart meet different primitives of a few forms. What is asked of one form is collected, and
//! computed for eight at a time by the formulas for one.

use fearless_simd::{Level, Simd, SimdBase, f64x8};

use crate::math::{LANES, Mask, Ray, Rays, Vector, dispatch};

use super::ball::Balls;
use super::crossing::{Crossing, FirstCrossings, RayStarts, firsts_of_spans};
use super::primitive::{WorldPrimitive, WorldShape};
use super::span::{Departure, Ends, Spans};
use super::surface::firsts_of_sides;
use super::tube::{NUMBERS_OF_TUBE, SideCrossings, Tubes};

/// Numbers of a ray.
const OF_RAY: usize = 6;

/// What eight rays are asked.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct RayBatch {
    rays: [[f64; LANES]; OF_RAY],
    forms: [[f64; LANES]; NUMBERS_OF_TUBE],
    enter: [[f64; LANES]; 2],
    leave: [[f64; LANES]; 2],
    /// Bits: which have a span, or go in; come out; cross only once.
    any: [u8; 3],
}

impl Default for RayBatch {
    #[inline]
    fn default() -> Self {
        Self {
            rays: [[0.0; LANES]; OF_RAY],
            forms: [[0.0; LANES]; NUMBERS_OF_TUBE],
            enter: [[0.0; LANES]; 2],
            leave: [[0.0; LANES]; 2],
            any: [0; 3],
        }
    }
}

impl RayBatch {
    /// The ray and the primitive of a lane, which is a ball or a tube as are those of the other lanes.
    #[inline]
    pub fn set(&mut self, lane: usize, ray: &Ray, primitive: &WorldPrimitive) {
        let lane = lane % LANES;
        let Ray { o, d } = ray;
        for (to, x) in self.rays.iter_mut().zip([o.x, o.y, o.z, d.x, d.y, d.z]) {
            to[lane] = x;
        }
        match &primitive.form {
            WorldShape::Ball(ball) => self.set_form(lane, &ball.numbers()),
            WorldShape::Tube(tube) => self.set_form(lane, &tube.numbers()),
            _ => {}
        }
    }

    #[inline(always)]
    fn set_form(&mut self, lane: usize, numbers: &[f64]) {
        for (to, &x) in self.forms.iter_mut().zip(numbers) {
            to[lane] = x;
        }
    }

    /// Computes where the rays meet balls.
    #[inline]
    pub fn meet_balls(&mut self, level: Level) {
        dispatch!(level, simd => self.balls(simd));
    }

    #[inline(always)]
    fn balls<S: Simd>(&mut self, simd: S) {
        let Spans { enter, leave, any, .. } = Balls::new(self.numbers(simd)).spans(&self.rays(simd));
        self.store(enter, leave);
        self.any[0] = any.bits() as u8;
    }

    /// Computes where the rays meet tubes.
    #[inline]
    pub fn meet_tubes(&mut self, level: Level) {
        dispatch!(level, simd => self.tubes(simd));
    }

    #[inline(always)]
    fn tubes<S: Simd>(&mut self, simd: S) {
        let found = Tubes::new(self.numbers(simd)).crossings(&self.rays(simd));
        let SideCrossings { enter, enters, leave, leaves, one_way } = found;
        self.store(enter, leave);
        self.any = [enters, leaves, one_way].map(|mask| mask.bits() as u8);
    }

    /// The numbers of a form that has so many.
    #[inline(always)]
    fn numbers<S: Simd, const COUNT: usize>(&self, simd: S) -> [f64x8<S>; COUNT] {
        let mut numbers = [f64x8::splat(simd, 0.0); COUNT];
        for (to, from) in numbers.iter_mut().zip(&self.forms) {
            *to = f64x8::from_slice(simd, from);
        }
        numbers
    }

    #[inline(always)]
    fn rays<S: Simd>(&self, simd: S) -> Rays<f64x8<S>> {
        let [ox, oy, oz, dx, dy, dz] = &self.rays;
        Rays {
            o: Vector {
                x: f64x8::from_slice(simd, ox),
                y: f64x8::from_slice(simd, oy),
                z: f64x8::from_slice(simd, oz),
            },
            d: Vector {
                x: f64x8::from_slice(simd, dx),
                y: f64x8::from_slice(simd, dy),
                z: f64x8::from_slice(simd, dz),
            },
        }
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, enter: Ends<f64x8<S>>, leave: Ends<f64x8<S>>) {
        enter.t.store_slice(&mut self.enter[0]);
        enter.error.store_slice(&mut self.enter[1]);
        leave.t.store_slice(&mut self.leave[0]);
        leave.error.store_slice(&mut self.leave[1]);
    }

    /// The lanes that may have met something, a bit for each.
    #[inline]
    pub fn met(&self, tubes: bool) -> u8 {
        if tubes { self.any[0] | self.any[1] } else { self.any[0] }
    }

    /// The first crossing of a lane, of a primitive by its index; `departure` is the surface that its ray
    /// leaves.
    #[inline]
    pub fn first(
        &self,
        lane: usize,
        primitive: &WorldPrimitive,
        index: u32,
        departure: Option<Departure>,
    ) -> Option<Crossing> {
        let lane = lane % LANES;
        let here = departure.is_some_and(|d| d.primitive == index);
        let inward = here && departure.is_some_and(|d| d.inward);
        let starts = RayStarts { here, inward, place_error: departure.map(|d| d.place_error) };
        // Balls and tubes have one face.
        let enter = Ends { t: self.enter[0][lane], error: self.enter[1][lane], surface: 0.0 };
        let leave = Ends { t: self.leave[0][lane], error: self.leave[1][lane], surface: 0.0 };
        let is = |bits: u8| bits >> lane & 1 == 1;
        let form = &primitive.form;
        let FirstCrossings { end, entering, any } = if let WorldShape::Tube(_) = form {
            let [enters, leaves, one_way] = [is(self.any[0]), is(self.any[1]), is(self.any[2])];
            firsts_of_sides(SideCrossings { enter, enters, leave, leaves, one_way }, form, &starts)
        } else {
            let any = is(self.any[0]);
            firsts_of_spans(Spans { enter, leave, any, may: any }, form, &starts)
        };
        let Ends { t, error, .. } = end;
        any.then_some(Crossing { t, error, primitive: index, surface: 0, entering })
    }
}
