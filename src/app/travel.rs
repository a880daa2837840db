//! How the eye gets from view to view: those of the scene, those of draughtsmen, and back.

use super::Painter;
use super::actions::StandardView;
use super::model::Model;
use crate::math::DVec3;
use crate::scene::Camera;

/// So many places are remembered; the oldest are forgotten.
const MOST_PLACES: usize = 64;

impl StandardView {
    /// What it is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "from the front",
            Self::Right => "from the right",
            Self::Top => "from the top",
            Self::Isometric => "isometric",
        }
    }

    /// The direction from the scene to the eye, and that which is upwards in the picture.
    const fn directions(self) -> [DVec3; 2] {
        match self {
            Self::Front => [DVec3::NEG_Y, DVec3::Z],
            Self::Right => [DVec3::X, DVec3::Z],
            Self::Top => [DVec3::Z, DVec3::Y],
            Self::Isometric => [DVec3::new(1.0, -1.0, 1.0), DVec3::Z],
        }
    }

    /// The camera that sees all of the scene from there, in a picture of that width divided by its height.
    pub fn camera(self, painter: &dyn Painter, aspect: f64) -> Camera {
        let [back, up] = self.directions();
        painter.framed(back, up, aspect)
    }
}

impl Model {
    /// Moves the eye a step.
    pub fn look(&mut self, camera: Camera) {
        self.moved |= camera != self.camera;
        self.camera = camera;
    }

    /// Goes to a camera, and remembers where the eye was.
    pub fn jump(&mut self, camera: Camera) {
        self.remember();
        self.look(camera);
    }

    /// Goes so many views further, in the ring of those that the scene has.
    pub fn go_to_view(&mut self, painter: &dyn Painter, further: usize) {
        self.remember();
        // From a camera of one's own the first stop is the view it stands for.
        if self.settings.camera.take().is_none() {
            self.settings.view = (self.settings.view + further) % self.views.max(1);
        }
        self.go_home(painter);
    }

    /// Goes back to the view as it was before any move.
    pub fn go_home(&mut self, painter: &dyn Painter) {
        let view = || painter.camera(self.settings.view, self.aspect());
        self.camera = self.settings.camera.clone().unwrap_or_else(view);
        self.moved = false;
    }

    /// Goes where draughtsmen look from.
    pub fn go_to_standard(&mut self, painter: &dyn Painter, view: StandardView) {
        let camera = view.camera(painter, self.aspect());
        self.jump(camera.clone());
        self.standing = Some((camera, view));
    }

    /// Sees all of the scene from the side where the eye is.
    pub fn fit_all(&mut self, painter: &dyn Painter) {
        let Camera { eye, target, up, .. } = self.camera;
        let camera = painter.framed(eye - target, up, self.aspect());
        self.jump(camera);
    }

    /// Goes to where the eye was before the last jump, and further back each time.
    pub fn go_back(&mut self) {
        if let Some(camera) = self.history.pop() {
            self.look(camera);
        }
    }

    /// Remembers where the eye is.
    pub fn remember(&mut self) {
        if self.history.last() != Some(&self.camera) {
            self.history.push(self.camera.clone());
            let too_many = self.history.len().saturating_sub(MOST_PLACES);
            self.history.drain(..too_many);
        }
    }

    /// The width of the picture divided by its height, on the screen.
    pub fn aspect(&self) -> f64 {
        let picture = self.layout.picture;
        self.cell_aspect * f64::from(picture.width) / f64::from(picture.height.max(1))
    }
}
