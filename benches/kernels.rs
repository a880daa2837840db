//! The innermost work: a ray and a form, a ray and an expression, a ray on its way through the cells.
//! `cargo bench --bench kernels`; each figure is the time of the rays that [`forms::rays`] sends.

#[expect(dead_code, reason = "not every scene that can be written is measured")]
mod scenery;

mod forms;
mod setting;

use std::fmt::Write;
use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{BenchmarkId, Criterion, Throughput};
use ray13::lattice::{Bvh8, Lattice, Structure, SubLattices, Tree};
use ray13::math::Ray;
use ray13::scene::Format;
use ray13::solid::{Assembly, Body, Scratch, TRange, first_of_expression, first_of_span, first_of_surface};
use ray13::stage::{Meter, Silent};

use forms::{CONVEX, rays};

/// Other forms of about radius 1, each by a text that gives it and no other.
const OTHERS: [(&str, Format, &str); 4] = [
    (
        // A prism over an L, which is not convex.
        "mesh",
        Format::Language,
        "polyhedron(points = [[-1,-1,-1],[1,-1,-1],[1,0,-1],[0,0,-1],[0,1,-1],[-1,1,-1],
                              [-1,-1,1],[1,-1,1],[1,0,1],[0,0,1],[0,1,1],[-1,1,1]],
                    faces = [[0,1,2,3,4,5],[11,10,9,8,7,6],[1,0,6,7],[2,1,7,8],[3,2,8,9],[4,3,9,10],[5,4,10,11],[0,5,11,6]]);",
    ),
    ("face", Format::Nff, "p 4 -1 0 -1  1 0 -1  1 0 1  -1 0 1"),
    ("patch", Format::Nff, "pp 3 -1 0 -1 -1 -2 -1  1 0 -1 1 -2 -1  0 0 1 0 -2 1"),
    ("tube", Format::Nff, "c 0 -0.5 -0.8 0.8  0 0.5 0.8 0.8"),
];

/// Objects that are walked past: as many as a lattice has room for, and as many as only the tree has.
const WALKED: [u64; 2] = [50, 5000];

fn main() {
    let mut criterion = setting::criterion();
    forms(&mut criterion);
    expressions(&mut criterion);
    walks(&mut criterion);
    criterion.final_summary();
}

/// Sends all rays against the first object.
fn meet(criterion: &mut Criterion, group: &str, name: &str, assembly: &Assembly) {
    let rays = rays(assembly);
    let primitives = &assembly.primitives;
    let (mut scratch, mut meter) = (Scratch::default(), Meter::new(Silent));
    let body = &assembly.objects[0].body;
    let mut first = |ray: &Ray| match body {
        Body::Single(index) => first_of_span(ray, &primitives[*index as usize], *index, None, &mut meter),
        Body::Surface(index) => first_of_surface(ray, &primitives[*index as usize], *index, None, &mut meter),
        Body::Composite { whole, .. } => {
            first_of_expression(ray, &**whole, primitives, None, TRange::ALL, &mut scratch, &mut meter)
        }
    };
    let mut group = criterion.benchmark_group(group);
    group.throughput(Throughput::Elements(rays.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| rays.iter().filter(|ray| first(black_box(ray)).is_some()).count());
    });
    group.finish();
}

fn forms(criterion: &mut Criterion) {
    let convex = CONVEX.map(|(name, text)| (name, Format::Language, text));
    for (name, format, text) in convex.into_iter().chain(OTHERS) {
        meet(criterion, "form", name, &assembled(name, text, format));
    }
}

/// A block with balls taken out of it.
fn expressions(criterion: &mut Criterion) {
    for primitives in [2, 8, 64] {
        let mut text = "difference() { cube(2, center = true);".to_owned();
        for ball in 1..primitives {
            // 5, 3 and 7 have no factor in common with 13: the balls stand apart.
            let place = |step: u32| f64::from(ball * step % 13) / 6.0 - 1.0;
            let [x, y, z] = [place(5), place(3), place(7)];
            let _ = write!(text, "translate([{x}, {y}, {z}]) sphere(0.35);");
        }
        text.push('}');
        let name = format!("{primitives} primitives");
        meet(criterion, "expression", &name, &assembled(&name, &text, Format::Language));
    }
}

/// Through all cells, past all objects: none is tested.
fn walks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("walk");
    for objects in WALKED {
        let text = setting::spread(objects, scenery::Shape::Spheres);
        let assembly = assembled("spheres", &text, Format::Nff);
        let rays = rays(&assembly);
        group.throughput(Throughput::Elements(rays.len() as u64));
        let (tree, subs) = (Tree::new(&assembly), SubLattices::new(&assembly));
        let lattice = Lattice::new(&assembly).ok();
        let boxes = Bvh8::new(&assembly);
        let structures = [
            lattice.as_ref().map(|lattice| Structure::Lattice(lattice, &subs)),
            Some(Structure::Tree(&tree, &subs)),
            Some(Structure::Boxes(&boxes, &subs)),
        ];
        for structure in structures.into_iter().flatten() {
            group.bench_with_input(BenchmarkId::new(structure.name(), objects), &rays, |bencher, rays| {
                bencher.iter(|| {
                    let mut cells = 0;
                    for ray in rays {
                        let passed = structure.walk(black_box(ray), 0.0, f64::INFINITY, |_, _| {
                            cells += 1;
                            ControlFlow::<(), f64>::Continue(f64::INFINITY)
                        });
                        black_box(passed);
                    }
                    cells
                });
            });
        }
    }
    group.finish();
}

fn assembled(name: &str, text: &str, format: Format) -> Assembly {
    setting::assembled(&setting::scene(name, text, format))
}
