//! What holds of every picture, whatever the scene and the view.

use ray13::frame::{Frame, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::{Shading, StructureChoice};
use ray13::scene::Camera;
use ray13::tone::{Level, Tone};

use crate::support::request::request;

/// A picture by every structure.
pub struct Pictures {
    frames: [Frame; 4],
    camera: Camera,
}

impl Pictures {
    /// The pictures of a view, if each holds only values that a picture may hold; else what is wrong. The
    /// light of each primary is computed where `color` says so.
    pub fn sound(
        studio: &Studio,
        camera: &Camera,
        dots: Size,
        shading: Shading,
        color: bool,
    ) -> Result<Self, String> {
        let choices =
            [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree, StructureChoice::Boxes];
        let frames = choices.map(|structure| {
            let mut request = request(camera.clone(), dots);
            request.options.structure = structure;
            request.options.shading = shading;
            request.options.color = color;
            request.options.threads = 1;
            studio.draw(&request)
        });
        match frames.iter().find_map(fault) {
            Some(fault) => Err(format!("{fault}; {camera:?}, {shading:?}")),
            None => Ok(Self { frames, camera: camera.clone() }),
        }
    }

    /// Whether all are the same to the bit; else the first dot that differs.
    pub fn same(&self) -> Result<(), String> {
        let [whole, others @ ..] = &self.frames;
        let dots = whole.light.size();
        for other in others {
            for place in (0..dots.height).flat_map(|j| (0..dots.width).map(move |i| (i, j))) {
                let [a, b] = [whole, other].map(|frame| seen(frame, place));
                if a != b {
                    let what = |f: &Frame| {
                        format!(
                            "{} {:e} {} {}",
                            f.object.as_ref().unwrap()[place],
                            f.depth.as_ref().unwrap()[place],
                            f.normal.as_ref().unwrap()[place],
                            f.light[place]
                        )
                    };
                    return Err(format!(
                        "dot {place:?}: {} alone, {} by {}; {:?}",
                        what(whole),
                        what(other),
                        other.space.name(),
                        self.camera
                    ));
                }
            }
        }
        Ok(())
    }
}

/// All that a dot holds, to the bit.
fn seen(frame: &Frame, place: (u32, u32)) -> [u64; 9] {
    let color = frame.color.as_ref().map_or(DVec3::ZERO, |color| color[place]);
    let normal = frame.normal.as_ref().unwrap()[place];
    [
        color.x,
        color.y,
        color.z,
        normal.x,
        normal.y,
        normal.z,
        frame.light[place],
        frame.depth.as_ref().unwrap()[place],
    ]
    .map(f64::to_bits)
    .into_iter()
    .chain([u64::from(frame.object.as_ref().unwrap()[place])])
    .collect::<Vec<_>>()
    .try_into()
    .expect("nine numbers")
}

/// The first value that no picture may hold.
fn fault(frame: &Frame) -> Option<String> {
    let size = frame.light.size();
    let levels = frame.levels(Tone::default());
    let is_light = |light: f64| light.is_finite() && light >= 0.0;
    for place in (0..size.height).flat_map(|j| (0..size.width).map(move |i| (i, j))) {
        let (light, depth) = (frame.light[place], frame.depth.as_ref().unwrap()[place]);
        let (normal, object) = (frame.normal.as_ref().unwrap()[place], frame.object.as_ref().unwrap()[place]);
        let color = frame.color.as_ref().map_or(DVec3::ZERO, |color| color[place]);
        let say =
            |what: &str| Some(format!("dot {place:?} has {what} {light} {color} {depth} {normal} {object}"));
        if !is_light(light) || !color.to_array().into_iter().all(is_light) {
            return say("a light that is none:");
        }
        let met = if object == 0 {
            depth == f64::INFINITY && normal == DVec3::ZERO
        } else {
            depth.is_finite() && depth >= 0.0 && (normal.length() - 1.0).abs() < 1e-9
        };
        if !met {
            return say("a depth or a normal that is none:");
        }
        for tone in [Tone::Lightness, Tone::Even] {
            let shown = tone.shown_color(color);
            if !(0.0..=1.0).contains(&tone.shown(light)) || shown.clamp(DVec3::ZERO, DVec3::ONE) != shown {
                return say("a light without a tone:");
            }
        }
        if levels[place] == Level::MIN && light > 0.5 {
            return say("the level of another light:");
        }
    }
    (!frame.field.iter().all(|angle| (0.0..=180.0).contains(angle)))
        .then(|| format!("field {:?}", frame.field))
}
