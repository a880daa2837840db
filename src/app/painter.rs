//! Who makes the pictures: a [`Studio`], or something in its place.

use std::sync::atomic::AtomicBool;

use crate::frame::{FollowedRay, Frame, Request, Studio};
use crate::math::DVec3;
use crate::scene::{Camera, Scene};
use crate::stage::{GiveUp, Progress};
use crate::trade::{Sweep, SweepLimits, SweepStep};

/// What the viewer asks for scene, views and pictures. Pictures are drawn on a thread of their own.
pub trait Painter: Send + Sync {
    /// The scene that is shown.
    fn scene(&self) -> &Scene;

    /// The camera of a view; the framing from the bounds where `index` is past the last. `aspect` is the
    /// width of the whole picture divided by its height, on the screen.
    fn camera(&self, index: usize, aspect: f64) -> Camera;

    /// A camera that sees all of the scene from a side: `back` is the direction from the scene to the eye,
    /// and `up` is upwards in the picture. The framing from the bounds where a painter has no other.
    fn framed(&self, _back: DVec3, _up: DVec3, aspect: f64) -> Camera {
        self.camera(usize::MAX, aspect)
    }

    /// Draws one picture.
    fn draw(&self, request: &Request) -> Frame;

    /// Draws one picture, unless it is given up. Keys wait for a painter that can not give up.
    fn draw_unless(&self, request: &Request, _give_up: &GiveUp) -> Option<Frame> {
        Some(self.draw(request))
    }

    /// Follows the ray through the middle of a dot; `None` where that can not be had.
    fn follow(&self, _request: &Request, _dot: [u32; 2]) -> Option<FollowedRay> {
        None
    }

    /// Measures how time trades against accuracy in a picture; `None` where that can not be had, or nothing
    /// was measured. `watch` learns of each step.
    fn trade(
        &self,
        _request: &Request,
        _limits: &SweepLimits,
        _interrupt: &AtomicBool,
        _watch: &mut dyn FnMut(SweepStep),
    ) -> Option<Sweep> {
        None
    }

    /// Where it can be read how far a picture is that is being drawn.
    fn progress(&self) -> Progress {
        Progress::default()
    }
}

impl Painter for Studio {
    fn scene(&self) -> &Scene {
        self.scene()
    }

    fn camera(&self, index: usize, aspect: f64) -> Camera {
        self.camera(index, aspect)
    }

    fn framed(&self, back: DVec3, up: DVec3, aspect: f64) -> Camera {
        self.framed_from(back, up, aspect)
    }

    fn draw(&self, request: &Request) -> Frame {
        self.draw(request)
    }

    fn draw_unless(&self, request: &Request, give_up: &GiveUp) -> Option<Frame> {
        self.draw_unless(request, give_up)
    }

    fn follow(&self, request: &Request, dot: [u32; 2]) -> Option<FollowedRay> {
        self.follow(request, dot)
    }

    fn trade(
        &self,
        request: &Request,
        limits: &SweepLimits,
        interrupt: &AtomicBool,
        watch: &mut dyn FnMut(SweepStep),
    ) -> Option<Sweep> {
        Sweep::new(self, request, limits, interrupt, watch).ok()
    }

    fn progress(&self) -> Progress {
        self.progress().clone()
    }
}
