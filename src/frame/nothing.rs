//! Why a picture is all background.

use std::fmt;

use crate::math::{Bounds, DVec3};
use crate::solid::Assembly;
use crate::view::PinholeCamera;

/// So many times the scene's size an eye is too far away: its coordinates have 53 bits, so from there on all
/// of the scene is in one place as seen by them.
const TOO_FAR: f64 = 1e15;

/// Why no ray from the eye met anything, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NothingInView {
    /// The scene has no objects.
    NoObjects,
    /// The eye is more than 10¹⁵ times the scene's size away.
    TooFar,
    /// All of the scene is behind the eye.
    Behind,
    /// The scene lies beside the field.
    Beside,
    /// The scene's box is in the field, but smaller than a dot.
    TooSmall,
    /// The field looks past all of it, or through a hole.
    Unknown,
}

impl NothingInView {
    /// Finds the cause for a picture in which nothing is seen.
    pub(super) fn cause(assembly: &Assembly, pinhole: &PinholeCamera) -> Self {
        if assembly.objects.is_empty() || assembly.limit.is_empty() {
            return Self::NoObjects;
        }
        Self::of_box(&assembly.limit, assembly, pinhole)
    }

    /// The same for what is in a box of the assembly that is not empty.
    pub(super) fn of_box(limit: &Bounds, assembly: &Assembly, pinhole: &PinholeCamera) -> Self {
        let eye = assembly.scene_frame.inward_near(pinhole.eye);
        let size = (limit.hi - limit.lo).max_element();
        let away = (limit.center() - eye).length();
        if away > TOO_FAR * size {
            return Self::TooFar;
        }
        // Of each corner as the picture has it: how deep, and how far across and down, in parts of the half
        // field.
        let seen = limit.corners().map(|corner| {
            let from_eye = corner - eye;
            let depth = from_eye.dot(pinhole.forward);
            let [across, down] = pinhole.tangents;
            DVec3::new(from_eye.dot(pinhole.right) / across, from_eye.dot(pinhole.up) / down, depth)
        });
        if seen.iter().all(|corner| corner.z <= 0.0) {
            return Self::Behind;
        }
        let beyond = |side: fn(&DVec3) -> f64| seen.iter().all(|corner| side(corner) > corner.z);
        if beyond(|c| c.x) || beyond(|c| -c.x) || beyond(|c| c.y) || beyond(|c| -c.y) {
            return Self::Beside;
        }
        if size < pinhole.least_dot() * away { Self::TooSmall } else { Self::Unknown }
    }
}

impl fmt::Display for NothingInView {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("nothing in view")?;
        match self {
            Self::NoObjects => f.write_str(": the scene has no objects"),
            Self::TooFar => f.write_str(": the eye is over 1e15 times the scene's size away"),
            Self::Behind => f.write_str(": the scene is behind the eye"),
            Self::Beside => f.write_str(": the scene is beside the field"),
            Self::TooSmall => f.write_str(": the scene is smaller than a dot"),
            Self::Unknown => f.write_str(": no ray meets a solid"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::NothingInView::{self, Behind, Beside, NoObjects, TooFar, TooSmall, Unknown};
    use crate::frame::{Request, Studio, Wants};
    use crate::glyph::{GlyphMode, Palette};
    use crate::math::{DVec3, Size};
    use crate::plan::Options;
    use crate::scene::{self, Camera, ReadOptions};
    use crate::tone::Tone;

    /// What a picture of a scene says, from an eye towards a target.
    fn seen(text: &str, eye: [f64; 3], target: [f64; 3]) -> Option<NothingInView> {
        let studio =
            Studio::new(scene::read("test", text.as_bytes(), &ReadOptions::default()).unwrap()).unwrap();
        let camera = Camera {
            eye: DVec3::from(eye),
            target: DVec3::from(target),
            field: [40.0, 25.0],
            ..studio.camera(0, 1.0)
        };
        let request = Request {
            camera,
            dots: Size::new(40, 25),
            dot_aspect: 1.0,
            options: Options { threads: 1, ..Options::default() },
            wants: Wants::CELLS,
            glyphs: GlyphMode::Ascii,
            palette: Palette::MONO,
            tone: Tone::Lightness,
        };
        let first = studio.draw(&request).nothing;
        // Neither a picture whose light is that of the one before nor one whose hits are counts any ray.
        let other = Request { glyphs: GlyphMode::Shade, ..request.clone() };
        assert_eq!(studio.draw(&other).nothing, first);
        let mut options = request.options;
        for _ in 0..3 {
            options.shadows = !options.shadows;
            assert_eq!(studio.draw(&Request { options, ..request.clone() }).nothing, first);
        }
        first
    }

    #[test]
    fn each_cause_has_its_name() {
        let ball = "sphere(1);";
        assert_eq!(seen(ball, [0.0, -9.0, 0.0], [0.0; 3]), None);
        assert_eq!(seen(ball, [0.0, -9.0, 0.0], [0.0, -99.0, 0.0]), Some(Behind));
        assert_eq!(seen(ball, [0.0, -9.0, 0.0], [9.0, -8.0, 0.0]), Some(Beside));
        assert_eq!(seen(ball, [0.0, -1e6, 0.0], [0.0; 3]), Some(TooSmall));
        for far in [1e17, 1e300] {
            assert_eq!(seen(ball, [0.0, -far, 0.0], [0.0, far, 0.0]), Some(TooFar), "{far:e}");
        }
        let frame = "difference() { cube([10, 1, 10], center = true); cube([9.9, 9, 9.9], center = true); }";
        assert_eq!(seen(frame, [0.0, -9.0, 0.0], [0.0; 3]), Some(Unknown));
    }

    #[test]
    fn a_scene_of_nothing_says_so() {
        let studio = Studio::new(scene::Scene::default()).unwrap();
        assert_eq!(
            NothingInView::cause(
                &studio.assembly,
                &crate::view::PinholeCamera::new(
                    &studio.camera(0, 1.0),
                    &crate::view::Picture { dots: Size::new(4, 4), dot_aspect: 1.0 }
                )
            ),
            NoObjects
        );
    }
}
