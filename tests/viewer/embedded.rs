//! The viewer inside another program: one whose painter panics, and one that goes on afterwards.

use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use ray13::app::{self, Painter, Settings};
use ray13::frame::{Frame, Request, Studio};
use ray13::math::DAffine3;
use ray13::scene::{Camera, Material, MaterialId, Object, Primitive, Scene, Shape, Solid};

use super::pty::{Pty, Size};
use crate::{Reading, SMALLEST};

#[test]
fn a_panic_shows_its_message_on_the_terminal_as_it_was() {
    for (part, message) in [("tracer", "the painter fell"), ("model", "the view fell")] {
        let mut pty = start_broken(part);
        pty.wait_for("the first picture", |pty| pty.row(0).contains(" BROKEN.SCENE ") && pty.eye() != "");
        pty.send("\t");
        pty.wait_for_end(101);
        assert!(pty.text().contains(message), "{}", pty.text());
    }
}

/// A painter that panics after the first picture: in the tracing thread, or in the thread of the screen.
struct Broken {
    studio: Studio,
    in_tracer: bool,
    cameras: AtomicU32,
}

impl Painter for Broken {
    fn scene(&self) -> &Scene {
        self.studio.scene()
    }

    fn camera(&self, index: usize, aspect: f64) -> Camera {
        // Two cameras are asked for before the first picture.
        let asked = self.cameras.fetch_add(1, Ordering::Relaxed);
        let camera = self.studio.camera(index, aspect);
        match asked {
            0..2 => camera,
            _ if self.in_tracer => Camera { zoom: 2.0, ..camera },
            _ => panic!("the view fell"),
        }
    }

    fn draw(&self, request: &Request) -> Frame {
        assert!(request.camera.zoom < 2.0, "the painter fell");
        self.studio.draw(request)
    }
}

const BROKEN_PART: &str = "RAY13_TEST_BROKEN_PART";

/// This test program itself, as a viewer that panics.
fn start_broken(part: &str) -> Pty {
    start_self("viewer::embedded::a_viewer_that_panics", part, Pty::start)
}

/// This test program itself in a terminal, as one of its tests.
fn start_self(test: &str, part: &str, start: impl Fn(&[&str], Size) -> Pty) -> Pty {
    let program = std::env::current_exe().unwrap();
    let variable = format!("{BROKEN_PART}={part}");
    let program = program.to_str().unwrap();
    start(&["env", &variable, program, "--exact", test, "--ignored", "--nocapture"], SMALLEST)
}

#[test]
#[ignore = "runs only inside the pseudo-terminal of a_panic_shows_its_message_on_the_terminal_as_it_was"]
fn a_viewer_that_panics() {
    let Ok(part) = std::env::var(BROKEN_PART) else { return };
    show_a_sphere(part == "tracer");
}

/// Runs the viewer on a sphere; it panics at the second picture.
fn show_a_sphere(in_tracer: bool) {
    let sphere = Primitive::new(Shape::Sphere, DAffine3::IDENTITY, MaterialId(0));
    let object = Object { name: None, solid: Solid::Primitive(sphere) };
    let scene = Scene { objects: vec![object], materials: vec![Material::default()], ..Scene::default() };
    let studio = Studio::new(scene).unwrap();
    let broken = Broken { studio, in_tracer, cameras: AtomicU32::new(0) };
    let settings = Settings { title: "broken.scene".to_owned(), ..Settings::default() };
    app::run(broken, settings).unwrap();
}

/// Signals were caught for ever, and had no effect on a program that went on after the viewer.
#[test]
fn after_the_viewer_signals_have_their_default_action() {
    for (name, number) in [("TERM", 15), ("INT", 2), ("HUP", 1), ("QUIT", 3)] {
        let mut pty = start_that_goes_on(Pty::start);
        pty.signal(name);
        pty.wait_for_end(128 + number);
    }
    let mut pty = start_that_goes_on(Pty::start_job);
    pty.signal("TSTP");
    pty.wait_for("the shell", |pty| pty.text().contains("stopped modes=same"));
    pty.send("\n");
    pty.signal("TERM");
    pty.wait_for_end(128 + 15);
}

fn start_that_goes_on(start: impl Fn(&[&str], Size) -> Pty) -> Pty {
    let mut pty = start_self("viewer::embedded::a_program_that_goes_on", "none", start);
    pty.wait_for("the first picture", |pty| pty.row(0).contains(" BROKEN.SCENE ") && pty.eye() != "");
    pty.send("q");
    pty.wait_for("the end of the viewer", |pty| pty.text().contains("it goes on"));
    pty
}

#[test]
#[ignore = "runs only inside the pseudo-terminal of after_the_viewer_signals_have_their_default_action"]
fn a_program_that_goes_on() {
    if std::env::var_os(BROKEN_PART).is_none() {
        return;
    }
    show_a_sphere(false);
    println!("it goes on");
    // Until a signal ends it, or its test has failed.
    thread::sleep(Duration::from_secs(120));
}
