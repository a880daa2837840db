//! Each event in words.

use crate::frame::{FollowedRay, Frame, Request, Space};
use crate::math::DVec3;
use crate::scene::Scene;
use crate::shade::Channel;
use crate::stage::{RayEvent, RayKind, Stage};
use crate::tone::{Tone, lightness};

use super::figure::{figure, triple};
use super::line::StoryLine;
use super::names::{Names, paint_name};

/// What happened to a ray, in order.
pub fn told(
    followed: &FollowedRay,
    request: &Request,
    scene: &Scene,
    frame: Option<&Frame>,
) -> Vec<StoryLine> {
    let mut teller = Teller {
        followed,
        names: Names::of(scene, &followed.objects),
        lines: Vec::new(),
        depth: 0,
        moved: 0.0,
        rays: Vec::new(),
    };
    teller.beginning(request);
    let mut number = 0;
    while number < followed.events.len() {
        number += teller.tell(number);
    }
    teller.end(request, frame);
    teller.lines
}

struct Teller<'a> {
    followed: &'a FollowedRay,
    names: Names,
    lines: Vec<StoryLine>,
    depth: usize,
    /// How far the start of the ray in hand was moved nearer, in the assembly's unit.
    moved: f64,
    /// Mirror and Snell rays that have not arrived yet: the depth of what sent each.
    rays: Vec<usize>,
}

impl Teller<'_> {
    fn say(&mut self, stage: Stage, text: String) {
        self.lines.push(StoryLine { stage, depth: self.depth, text });
    }

    /// A distance of the assembly, along the ray in hand, from where that was sent.
    fn along(&self, t: f64) -> f64 {
        (self.moved + t) * self.followed.scene_frame.unit
    }

    fn beginning(&mut self, request: &Request) {
        let camera = &request.camera;
        let cut = match self.followed.space {
            Space::Whole => "space is not cut: every object is tested".to_owned(),
            Space::Lattice([x, y, z]) => format!("a lattice of {x} × {y} × {z} cells"),
            Space::Tree(nodes) => format!("lattices within lattices: {}", many(nodes, "node")),
            Space::Boxes(nodes) => format!("boxes around boxes: {}", many(nodes, "node")),
        };
        self.say(Stage::Lattice, cut);
        let looks = format!("the eye at {} looks to {}", triple(camera.eye), triple(camera.target));
        self.say(Stage::View, looks);
    }

    /// Tells the event of this number, and says how many were told: cells without anything in them are told
    /// at once.
    fn tell(&mut self, number: usize) -> usize {
        let event = &self.followed.events[number];
        let stage = event.stage();
        match *event {
            RayEvent::Sent { kind, ray, weight } => self.sent(kind, ray.o, ray.d, weight),
            RayEvent::Coded { outcode, moved } => self.coded(outcode, moved),
            RayEvent::Clipped => self.say(stage, "it misses the world".to_owned()),
            RayEvent::Entered { t } => {
                // An eye in the world enters nothing.
                if self.along(t) > 0.0 {
                    self.say(stage, format!("it comes into the world at t = {}", figure(self.along(t))));
                }
            }
            RayEvent::Cell { .. } => return self.cells(number),
            RayEvent::Tested { primitive, span } => {
                let within = match span {
                    None => "not met".to_owned(),
                    Some([first, last]) => {
                        format!("t = {} to {}", figure(self.along(first)), figure(self.along(last)))
                    }
                };
                self.say(stage, format!("{}: {within}", self.names.primitive(primitive)));
            }
            RayEvent::Evaluated { leaves, crossings } => {
                let text = format!("of {}, {}", many(leaves, "primitive"), many(crossings, "crossing"));
                self.say(stage, text);
            }
            RayEvent::Crossed { object, primitive, t, error, entering, .. } => {
                let text = format!(
                    "it {} {} through {} at t = {}, give or take {}",
                    if entering { "enters" } else { "leaves" },
                    self.names.object(object),
                    self.names.primitive(primitive),
                    figure(self.along(t)),
                    figure(error * self.followed.scene_frame.unit)
                );
                self.say(stage, text);
            }
            RayEvent::Hit { object, primitive, t, .. } => {
                // From where the ray was sent.
                let text = format!(
                    "first of all it meets {}: {}, at t = {}",
                    self.names.object(object),
                    self.names.primitive(primitive),
                    figure(t * self.followed.scene_frame.unit)
                );
                self.say(stage, text);
                self.depth += 1;
            }
            RayEvent::Missed => self.say(stage, "it meets nothing: the background".to_owned()),
            RayEvent::Truncated => {
                self.say(stage, "it is not followed, and counts as ambient light".to_owned());
            }
            RayEvent::Lit { lamp, diffuse, highlight, visible, adds } => {
                // Behind the shadow ray, where there was one.
                if visible.is_some() {
                    self.depth -= 1;
                }
                let visible =
                    visible.map_or_else(String::new, |v| format!(", of which V = {} arrives", figure(v)));
                let text = format!(
                    "lamp {}: kd · (L·N) = {}, ks · cosⁿθ = {}{visible}; it adds {}",
                    lamp + 1,
                    figure(diffuse),
                    figure(highlight),
                    figure(adds)
                );
                self.say(stage, text);
            }
            RayEvent::Gathered { ambient, lamps, path_length, light } => {
                let [ambient, lamps, light] = [ambient, lamps, light].map(figure);
                let text = match self.followed.plan.depth {
                    Some(k) => {
                        let far = figure(path_length * self.followed.scene_frame.unit);
                        let k = figure(k);
                        format!("I = Ia·C + Σ / (R + k) = {ambient} + {lamps} / ({far} + {k}) = {light}")
                    }
                    None => format!("I = Ia·C + Σ = {ambient} + {lamps} = {light}"),
                };
                self.say(stage, text);
            }
            RayEvent::Arrived { light, share } => {
                self.depth = self.rays.pop().unwrap_or_default();
                let text = format!(
                    "{} · {} = {} arrives of it",
                    figure(share),
                    figure(light),
                    figure(share * light)
                );
                self.say(stage, text);
            }
        }
        1
    }

    fn sent(&mut self, kind: RayKind, o: DVec3, d: DVec3, weight: f64) {
        self.moved = 0.0;
        let from = self.followed.scene_frame.outward(o);
        let (name, from) = match kind {
            RayKind::Eye => ("", self.followed.ray.o),
            RayKind::Mirror => ("a mirror ray ", from),
            RayKind::Snell => ("a Snell ray ", from),
            RayKind::Shadow => ("a shadow ray ", from),
        };
        let weight = match kind {
            RayKind::Mirror | RayKind::Snell => format!(", of which {} reaches the eye", share(weight)),
            RayKind::Eye | RayKind::Shadow => String::new(),
        };
        if matches!(kind, RayKind::Mirror | RayKind::Snell) {
            self.rays.push(self.depth);
        }
        self.say(Stage::Ray, format!("{name}P(t) = {} + t · {}{weight}", triple(from), triple(d)));
        if kind != RayKind::Eye {
            self.depth += 1;
        }
    }

    fn coded(&mut self, outcode: u8, moved: f64) {
        self.moved = moved;
        let place = match outcode {
            0 => "0: it begins in the world's box".to_owned(),
            code if moved > 0.0 => {
                let by = figure(moved * self.followed.scene_frame.unit);
                format!("{code:06b}: moved nearer by {by}, it begins {}", beyond(code))
            }
            code => format!("{code:06b}: it begins {}", beyond(code)),
        };
        self.say(Stage::Clip, format!("outcode {place}"));
    }

    /// Cells from that of this number on, up to one in which anything is tested; and how many.
    fn cells(&mut self, number: usize) -> usize {
        let events = &self.followed.events[number..];
        let count = events.iter().take_while(|event| matches!(event, RayEvent::Cell { .. })).count();
        let RayEvent::Cell { from, .. } = events[count - 1] else { return 1 };
        let last = figure(self.along(from).max(0.0));
        let is_tested = matches!(events.get(count), Some(RayEvent::Tested { .. }));
        let subject = self.cell_names(&events[..count]);
        let text = match (count, is_tested) {
            (1, true) => format!("{subject} from t = {last}"),
            (1, false) => format!("{subject} from t = {last}, with nothing new in it"),
            (_, true) => format!("{subject}, nothing new in all but the last, from t = {last}"),
            (_, false) => format!("{subject}, the last from t = {last}, with nothing new in them"),
        };
        self.say(Stage::Cell, text);
        count
    }

    /// Some cells, by their places in the lattice where they have one.
    fn cell_names(&self, cells: &[RayEvent]) -> String {
        let number = |event: &RayEvent| match event {
            RayEvent::Cell { number, .. } => *number,
            _ => None,
        };
        let (what, places) = match self.followed.space {
            Space::Boxes(_) => ("box", Vec::new()),
            Space::Lattice(sides) => {
                ("cell", cells.iter().filter_map(number).map(|number| place(number, sides)).collect())
            }
            Space::Whole | Space::Tree(_) => ("cell", Vec::new()),
        };
        let all = match &places[..] {
            [] if cells.len() == 1 => return format!("a {what}"),
            [] => return many(cells.len(), what),
            [one] => format!("cell {one}"),
            [first, .., last] if places.len() > MOST_PLACES => {
                format!("{} from {first} to {last}", many(places.len(), "cell"))
            }
            some => format!("cells {}", some.join(", ")),
        };
        match cells.len() - places.len() {
            0 => all,
            others => format!("{all}, and {others} of a sub-lattice"),
        }
    }

    fn end(&mut self, request: &Request, frame: Option<&Frame>) {
        self.depth = 0;
        let FollowedRay { light, left_out, dot: [column, row], .. } = self.followed;
        if *left_out > 0 {
            self.say(Stage::Shade, format!("and so on: {left_out} more events are not told"));
        }
        let own = light.gray();
        self.say(Stage::Shade, format!("the light along the ray: {}", figure(own)));
        let gray = frame.map_or(own, |frame| frame.light[(*column, *row)]);
        if request.options.samples > 1 || (request.options.adaptive.is_some() && gray != own) {
            self.say(Stage::Shade, format!("with the dot's other rays: {}", figure(gray)));
        }
        if request.needs_levels() {
            let by = match request.tone {
                Tone::Lightness => format!("L* = {}", figure(lightness(gray.clamp(0.0, 1.0)))),
                Tone::Even => "even steps of 1/12".to_owned(),
            };
            let level = request.tone.level(gray);
            let nearest = figure(lightness(level.light()));
            self.say(Stage::Dither, format!("{by}: level {} of 12, whose own L* is {nearest}", level.get()));
        } else {
            self.say(Stage::Dither, "the terminal shows the colour itself: no level".to_owned());
        }
        let Some(cells) = frame.and_then(|frame| frame.cells.as_ref()) else { return };
        let per_cell = request.glyphs.dots_per_cell();
        let cell = (column / per_cell.width, row / per_cell.height);
        if cell.0 >= cells.size().width || cell.1 >= cells.size().height {
            self.say(Stage::Display, "the dot is in no whole cell".to_owned());
            return;
        }
        let shown = cells[cell];
        let text = format!(
            "cell {}, {} is '{}' in {} on {}; the dot is {} of {} in it",
            cell.0,
            cell.1,
            shown.glyph,
            paint_name(shown.ink, "ink"),
            paint_name(shown.paper, "paper"),
            1 + column % per_cell.width + per_cell.width * (row % per_cell.height),
            per_cell.area()
        );
        self.say(Stage::Display, text);
    }
}

/// So many places of cells are told one by one.
const MOST_PLACES: usize = 4;

/// The place i, j, k of a cell of this number, in a lattice of so many cells along x, y and z.
fn place(number: u32, [x, y, _]: [usize; 3]) -> String {
    let number = number as usize;
    format!("({}, {}, {})", number % x, number / x % y, number / (x * y))
}

/// Beyond which faces of a box an outcode says that a point lies.
fn beyond(code: u8) -> String {
    const FACES: [&str; 6] = ["below x", "above x", "below y", "above y", "below z", "above z"];
    let faces = FACES.into_iter().enumerate().filter(|(bit, _)| code >> bit & 1 == 1);
    faces.map(|(_, face)| face).collect::<Vec<_>>().join(", ")
}

fn many(count: usize, of: &str) -> String {
    match (count, of) {
        (1, _) => format!("1 {of}"),
        (_, "box") => format!("{count} boxes"),
        _ => format!("{count} {of}s"),
    }
}

/// A share in percent.
fn share(weight: f64) -> String {
    format!("{} %", figure(100.0 * weight))
}
