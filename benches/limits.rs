//! How far the kernels that eight rays go through at once are from what this processor's arithmetic allows.
//! `cargo bench --bench limits` prints the table of docs/performance.md.
//!
//! What a kernel computes is counted by running it on numbers that count. What the processor allows is
//! measured too: chains of one operation that do not wait for each other. A kernel takes at least as long as
//! its simple operations do, and as its quotients and roots do, which go through another unit beside them;
//! loads, stores and the order of things come on top.

#[expect(dead_code, reason = "no scene of many objects is measured")]
mod scenery;
#[expect(dead_code, reason = "criterion measures no limits")]
mod setting;

mod counted;
mod forms;

use std::hint::black_box;
use std::time::{Duration, Instant};

use fearless_simd::{Level, Simd, SimdBase, dispatch, f64x8};
use ray13::math::{Mask, Number, PACKET, REGISTERS, Ray, RayPacket, Rays};
use ray13::scene::Format;
use ray13::solid::{Assembly, WorldShape};

use counted::{Counted, Operations};
use forms::{CONVEX, rays};

/// Chains of operations side by side: more than any processor has operations of one kind on their way.
const CHAINS: usize = 12;

/// Operations of a chain, and rounds of a kernel, between two looks at the clock.
const ROUNDS: usize = 2000;

/// The least of so many times counts: whatever else a machine does only adds to it.
const TIMES: usize = 200;

/// What eight numbers side by side take, in nanoseconds.
struct Pace {
    simple: f64,
    quotient: f64,
    root: f64,
}

fn main() {
    let level = Level::new();
    let pace = dispatch!(level, simd => Pace {
        simple: chained(simd, |x, a, k| if k % 2 == 0 { x * a } else { x + a }),
        quotient: chained(simd, |x, a, _| a / x),
        root: chained(simd, |x, _, _| x.root()),
    });
    println!(
        "eight numbers: a sum or a product {:.2} ns, a quotient {:.2} ns, a root {:.2} ns\n",
        pace.simple, pace.quotient, pace.root
    );
    println!("| form | simple | quotients | roots | at least | measured | times |");
    println!("|---|---|---|---|---|---|---|");
    for (name, text) in CONVEX {
        let assembly = setting::assembled(&setting::scene(name, text, Format::Language));
        let form = &assembly.primitives[0].form;
        let (packet, rays) = bundled(&assembly, form);
        let Operations { simple, quotients, roots } = counted(form, &rays);
        let least = (simple * pace.simple).max(quotients * pace.quotient + roots * pace.root);
        let measured = dispatch!(level, simd => measured(simd, form, &packet));
        println!(
            "| {name} | {simple:.0} | {quotients:.0} | {roots:.0} | {least:.1} ns | {measured:.1} ns | {:.1} |",
            measured / least
        );
    }
}

/// A packet of rays that all meet a form.
fn bundled(assembly: &Assembly, form: &WorldShape) -> (RayPacket, Vec<Ray>) {
    let meeting: Vec<Ray> = rays(assembly).into_iter().filter(|ray| form.span(ray).is_some()).collect();
    let rays: Vec<Ray> = meeting.into_iter().cycle().take(PACKET).collect();
    let mut packet = RayPacket::EMPTY;
    for (lane, ray) in rays.iter().enumerate() {
        packet.set(lane, ray);
    }
    (packet, rays)
}

/// What a ray takes on average.
fn counted(form: &WorldShape, rays: &[Ray]) -> Operations {
    let all = counted::during(|| {
        for ray in rays {
            black_box(form.spans(&Counted::of(&Rays::from(ray))));
        }
    });
    all.over(rays.len() as f64)
}

/// What an operation takes in nanoseconds, where nothing waits for anything.
#[inline(always)]
fn chained<S: Simd>(simd: S, step: impl Fn(f64x8<S>, f64x8<S>, usize) -> f64x8<S>) -> f64 {
    // Near 1, where neither sums nor products leave the numbers that are quick.
    let a = f64x8::splat(simd, black_box(1.0 + 1e-9));
    let mut chains = [f64x8::splat(simd, black_box(1.5)); CHAINS];
    let time = least(|| {
        for round in 0..ROUNDS {
            for x in &mut chains {
                *x = step(*x, a, round);
            }
        }
        black_box(chains[0].as_slice());
    });
    for x in &chains {
        black_box(x.as_slice());
    }
    time / (ROUNDS * CHAINS) as f64
}

/// What the spans of a row of rays take in nanoseconds.
#[inline(always)]
fn measured<S: Simd>(simd: S, form: &WorldShape, packet: &RayPacket) -> f64 {
    macro_rules! of {
        ($($kind:ident),*) => {
            match form {
                $(WorldShape::$kind(solid) => rows(simd, packet, #[inline(always)] |rays| {
                    let spans = solid.spans(rays);
                    let sum = spans.enter.t + spans.leave.t + spans.enter.error + spans.leave.error;
                    spans.any.choose(sum + spans.enter.surface + spans.leave.surface, sum)
                }),)*
                _ => f64::NAN,
            }
        };
    }
    of!(Ball, AxisBox, SkewBox, Quadric, Facets)
}

#[inline(always)]
fn rows<S: Simd>(simd: S, packet: &RayPacket, spans: impl Fn(&Rays<f64x8<S>>) -> f64x8<S>) -> f64 {
    let time = least(|| {
        // By itself: a closure is not compiled for the processor that its surroundings are for.
        simd.vectorize(
            #[inline(always)]
            || {
                let mut sum = f64x8::splat(simd, 0.0);
                for _ in 0..ROUNDS / REGISTERS {
                    let packet = black_box(packet);
                    for row in 0..REGISTERS {
                        sum += spans(&packet.load(simd, row));
                    }
                }
                black_box(sum.as_slice());
            },
        );
    });
    time / (ROUNDS / REGISTERS * REGISTERS) as f64
}

/// The least time of many, in nanoseconds.
#[inline(always)]
fn least(mut work: impl FnMut()) -> f64 {
    let mut least = Duration::MAX;
    for _ in 0..TIMES {
        let start = Instant::now();
        work();
        least = least.min(start.elapsed());
    }
    least.as_secs_f64() * 1e9
}
