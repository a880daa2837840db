//! One dot's ray, followed through all stages.

use crate::integrate::{RayIntegrator, View};
use crate::lattice::Structure;
use crate::math::{Bounds, DVec3, Ray, Size};
use crate::plan::{Channels, EngineChoice, Options, Plan, PrecisionChoice};
use crate::shade::Channel;
use crate::solid::SceneFrame;
use crate::stage::{GiveUp, Meter, RayEvent, Recorder};
use crate::trace::Exact;
use crate::view::settled;

use super::{Request, Space, Studio};

/// So many events are told: of rays that split at every surface there may be millions. At some twenty for
/// each ray they are those of five hundred.
const MOST_EVENTS: usize = 10_000;

/// What happens to the ray through the middle of a dot, as the exact engine records it.
#[derive(Clone, Debug)]
pub struct FollowedRay {
    /// The dot: column and row, from 0.
    pub dot: [u32; 2],
    /// The ray, in the scene's coordinates.
    pub ray: Ray,
    /// What happens to it and to all rays that are sent on, in order.
    pub events: Vec<RayEvent>,
    /// By the numbers of objects in the events: those in the file, from 0.
    pub objects: Vec<u32>,
    /// From the coordinates and the unit of the events to the scene's.
    pub scene_frame: SceneFrame,
    /// How space is cut.
    pub space: Space,
    /// How space is cut, to be drawn.
    pub drawn_space: DrawnSpace,
    /// How many more events there were, which are not told.
    pub left_out: u64,
    /// What the picture requires.
    pub plan: Plan,
    /// The light along the ray, by its three linear primaries, 0 or more.
    pub light: DVec3,
}

/// So many boxes are drawn at most: more can not be told apart on a screen.
const MOST_BOXES: usize = 1_000;

/// The space of a picture as it is drawn, in the scene's coordinates.
#[derive(Clone, Debug)]
pub struct DrawnSpace {
    /// A box around all objects.
    pub world: Bounds,
    /// The planes across each axis, ascending; none where there is no lattice.
    pub planes: [Vec<f64>; 3],
    /// The boxes around the first 1 000 objects.
    pub boxes: Vec<Bounds>,
}

impl Studio {
    fn drawn_space(&self, structure: &Structure) -> DrawnSpace {
        let frame = self.assembly.scene_frame;
        let outward = |b: &Bounds| Bounds::new(frame.outward(b.lo), frame.outward(b.hi));
        let planes = [0, 1, 2].map(|axis| match structure {
            Structure::Lattice(lattice, _) => {
                let list = lattice.planes().list(axis).iter();
                list.map(|x| x * frame.unit + frame.origin[axis]).collect()
            }
            _ => Vec::new(),
        });
        let objects = &self.assembly.objects;
        let world = objects.iter().fold(Bounds::EMPTY, |all, object| all.join(&object.bounds));
        let boxes = objects.iter().take(MOST_BOXES).map(|object| outward(&object.bounds)).collect();
        DrawnSpace { world: outward(&world), planes, boxes }
    }

    /// Follows the ray through the middle of a dot, by the exact engine whatever the request has; `None`
    /// where the picture has no such dot.
    pub fn follow(&self, request: &Request, dot: [u32; 2]) -> Option<FollowedRay> {
        let Size { width, height } = request.dots;
        if dot[0] >= width || dot[1] >= height {
            return None;
        }
        let options =
            Options { engine: EngineChoice::Exact, precision: PrecisionChoice::Auto, ..request.options };
        let request = Request { options, ..request.clone() };
        let never = GiveUp::never();
        let prepared = self.prepare(&request, None, &never);
        let ray = prepared.pinhole.ray(f64::from(dot[0]) + 0.5, f64::from(dot[1]) + 0.5);
        let engine = Exact::new(&self.assembly, prepared.structure);
        let mut meter = Meter::new(Recorder::of_the_first(MOST_EVENTS));
        // As every ray from the eye.
        let ray = Ray::new(ray.o, settled(ray.d, prepared.longest_path()));
        let light = match prepared.plan.channels {
            Channels::Gray => self.traced_light::<f64>(&engine, &prepared.plan, &ray, &mut meter),
            Channels::Three => self.traced_light::<DVec3>(&engine, &prepared.plan, &ray, &mut meter),
        };
        Some(FollowedRay {
            dot,
            ray,
            events: meter.probe.events,
            objects: self.assembly.objects.iter().map(|object| object.number).collect(),
            scene_frame: self.assembly.scene_frame,
            space: Space::of(&prepared.structure),
            drawn_space: self.drawn_space(&prepared.structure),
            left_out: meter.probe.left_out,
            light,
            plan: prepared.plan,
        })
    }

    fn traced_light<C: Channel>(
        &self,
        engine: &Exact,
        plan: &Plan,
        ray: &Ray,
        meter: &mut Meter<Recorder>,
    ) -> DVec3 {
        let integrator = RayIntegrator::<_, C>::new(self.scene(), &self.assembly, plan, engine);
        let View { light, .. } = integrator.view(&self.assembly.ray(ray), &mut integrator.memory(), meter);
        light.rgb()
    }
}
