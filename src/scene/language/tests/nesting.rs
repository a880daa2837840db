//! Nesting as deep as programs write it, and the deepest that is read, on a small stack.

use std::thread;

use super::{errors, scene, structure};
use crate::scene::Solid;

/// Half of what a thread gets by default.
const SMALL_STACK: usize = 1 << 20;

/// Runs on a small stack, to its end: what is dropped is dropped there.
fn on_a_small_stack(run: impl FnOnce() + Send) {
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(SMALL_STACK).spawn_scoped(scope, run);
        assert!(thread.expect("a thread").join().is_ok());
    });
}

#[test]
fn operators_inside_operators() {
    on_a_small_stack(|| {
        let levels = "difference() { cube(9); intersection() { cube(8); ".repeat(999);
        let text = format!("{levels}sphere(1);{}", "}".repeat(2 * 999));
        let scene = scene(&text);
        let mut count = 0;
        scene.objects[0].solid.visit(&mut |_| count += 1);
        assert_eq!(count, 2 * 999 + 1);
        assert!(scene.has_solids_of(&scene));
    });
}

#[test]
fn a_chain_of_one_is_that_one() {
    on_a_small_stack(|| {
        for (open, close) in
            [("group() ", ""), ("{", "}"), ("difference() {", "}"), ("translate([0, 0, 1]) ", "")]
        {
            let text = format!("{}cube(1);{}", open.repeat(2000), close.repeat(2000));
            assert_eq!(structure(&text), "a", "{open}");
        }
        let both =
            format!("{}cube(1); cube(2);{}", "intersection() { union() {".repeat(999), "} }".repeat(999));
        assert_eq!(structure(&both), "a, b");
    });
}

#[test]
fn lists_inside_lists() {
    on_a_small_stack(|| {
        let lists = |depth: usize| format!("cube({}1{});", "[".repeat(depth), "]".repeat(depth));
        assert!(errors(&lists(2000)).contains("this is a list"));
        assert!(errors(&lists(2001)).contains("nested deeper than 2000 levels"));
        assert!(errors(&lists(1_000_000)).contains("nested deeper than 2000 levels"));
    });
}

#[test]
fn what_is_wide_is_flat() {
    let text = format!("group() {{ {} }}", "union() { cube(1); } ".repeat(10_000));
    assert_eq!(scene(&text).objects.len(), 10_000);
    let text = format!("difference() {{ {} }}", "union() { cube(1); cube(2); } ".repeat(5_000));
    let scene = scene(&text);
    let Solid::Difference(operands) = &scene.objects[0].solid else { panic!("no difference") };
    assert_eq!(operands.len(), 2 * 5_000 - 1);
}
