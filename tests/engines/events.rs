//! What a probe records of a ray through the exact engine: what happens to it, in its order, as often as it
//! is counted; and nothing else is different for that.

use ray13::integrate::RayIntegrator;
use ray13::lattice::{Bvh8, Lattice, Structure, SubLattices, Tree};
use ray13::math::{DVec3, Ray, Size};
use ray13::plan::{Options, Plan};
use ray13::scene::{Camera, FieldSpan, ReadOptions, Scene, read};
use ray13::solid::Assembly;
use ray13::stage::{Counts, Meter, RayEvent, RayKind, Recorder, Silent, Stage};
use ray13::trace::Exact;
use ray13::view::{Picture, PinholeCamera};

use crate::support::scenery::embedded_scenes;

/// Few enough for each to be followed, many enough to meet all that a scene has.
const DOTS: Size = Size::new(12, 8);

/// A scene as it is made ready for rays.
struct Prepared {
    assembly: Assembly,
    pinhole: PinholeCamera,
    plan: Plan,
    scene: Scene,
}

impl Prepared {
    fn new(scene: Scene, camera: &Camera) -> Self {
        let assembly = Assembly::new(&scene).unwrap();
        let pinhole = PinholeCamera::new(camera, &Picture { dots: DOTS, dot_aspect: 1.0 });
        let plan = Plan::new(&scene, &assembly, &pinhole, &Options::default());
        Self { assembly, pinhole, plan, scene }
    }

    /// The light along a ray, what was counted, and what happened.
    fn follow(&self, structure: Structure, ray: &Ray) -> (f64, Counts, Vec<RayEvent>) {
        let engine = Exact::new(&self.assembly, structure);
        let integrator = RayIntegrator::<_, f64>::new(&self.scene, &self.assembly, &self.plan, &engine);
        let mut silent = Meter::new(Silent);
        let unwatched = integrator.view(ray, &mut integrator.memory(), &mut silent);
        let mut meter = Meter::new(Recorder::default());
        let view = integrator.view(ray, &mut integrator.memory(), &mut meter);
        assert_eq!((view, meter.counts), (unwatched, silent.counts), "{ray:?} is another when it is watched");
        (view.light, meter.counts, meter.probe.events)
    }
}

/// How many events are of a kind.
fn number(events: &[RayEvent], of: impl Fn(&RayEvent) -> bool) -> u64 {
    events.iter().filter(|event| of(event)).count() as u64
}

/// How many rays of a kind are sent.
fn sent(events: &[RayEvent], of: &[RayKind]) -> u64 {
    number(events, |event| matches!(event, RayEvent::Sent { kind, .. } if of.contains(kind)))
}

/// The counts that the events come to.
fn counted(events: &[RayEvent]) -> Counts {
    let truncated_rays = number(events, |event| matches!(event, RayEvent::Truncated));
    let hits = number(events, |event| matches!(event, RayEvent::Hit { .. }));
    let of_eye = events.iter().take_while(|event| !matches!(event, RayEvent::Lit { .. }));
    let primary_hits = of_eye.filter(|event| matches!(event, RayEvent::Hit { .. })).count().min(1) as u64;
    Counts {
        primary_rays: sent(events, &[RayKind::Eye]),
        primary_hits,
        shadow_rays: sent(events, &[RayKind::Shadow]),
        shadow_hits: number(
            events,
            |event| matches!(event, RayEvent::Lit { visible: Some(v), .. } if *v < 1.0),
        ),
        secondary_rays: sent(events, &[RayKind::Mirror, RayKind::Snell]) - truncated_rays,
        secondary_hits: hits - primary_hits,
        clipped_rays: number(events, |event| matches!(event, RayEvent::Clipped)),
        cells_visited: number(events, |event| event.stage() == Stage::Cell),
        primitive_tests: number(events, |event| matches!(event, RayEvent::Tested { .. })),
        csg_evaluations: number(events, |event| matches!(event, RayEvent::Evaluated { .. })),
        truncated_rays,
    }
}

/// What a ray hits it was tested against, crossed there, and nothing that it crossed lies before that.
fn assert_hits_follow(events: &[RayEvent], what: &str) {
    let mut since = 0;
    for (at, event) in events.iter().enumerate() {
        match *event {
            RayEvent::Sent { ray, weight, .. } => {
                assert!(
                    (ray.d.length() - 1.0).abs() < 1e-14 && (0.0..=1.0).contains(&weight),
                    "{what}: {event:?}"
                );
                since = at;
            }
            RayEvent::Hit { primitive, t, .. } => {
                let before = &events[since..at];
                let tested = |event: &RayEvent| matches!(event, RayEvent::Tested { primitive: tested, span: Some(_) } if *tested == primitive);
                assert!(before.iter().any(tested), "{what}: {event:?} was not tested");
                let crossed = before.iter().filter_map(|event| match *event {
                    RayEvent::Crossed { primitive, t, error, .. } => Some((primitive, t, error)),
                    _ => None,
                });
                let (mut own, mut least) = (None, f64::INFINITY);
                for (crossed, place, error) in crossed {
                    if crossed == primitive {
                        own = Some((place, error));
                    }
                    least = least.min(place + error);
                }
                let (place, error) = own.unwrap_or_else(|| panic!("{what}: {event:?} was not crossed"));
                // A far eye is moved nearer: its own ray is longer than the one that is tested.
                assert!(t >= place, "{what}: {event:?} lies before {place}");
                assert!(place - error <= least, "{what}: something lies before {event:?}");
            }
            RayEvent::Tested { span: Some([first, last]), .. } => assert!(first <= last, "{what}: {event:?}"),
            _ => {}
        }
    }
}

#[test]
fn events_are_what_is_counted_through_every_structure() {
    let mut all = Counts::default();
    for (name, scene) in embedded_scenes() {
        let Some(camera) = scene.views.first().cloned() else { continue };
        let prepared = Prepared::new(scene, &camera);
        let (tree, subs) = (Tree::new(&prepared.assembly), SubLattices::new(&prepared.assembly));
        let lattice = Lattice::new(&prepared.assembly).ok();
        let boxes = Bvh8::new(&prepared.assembly);
        let structures = [
            Some(Structure::None),
            lattice.as_ref().map(|lattice| Structure::Lattice(lattice, &subs)),
            Some(Structure::Tree(&tree, &subs)),
            Some(Structure::Boxes(&boxes, &subs)),
        ];
        for j in 0..DOTS.height {
            for i in 0..DOTS.width {
                let ray = prepared.pinhole.ray(f64::from(i) + 0.5, f64::from(j) + 0.5);
                let ray = prepared.assembly.ray(&ray);
                for structure in structures.into_iter().flatten() {
                    let what = format!("{name}, {}, dot {i} {j}", structure.name());
                    let (_, counts, events) = prepared.follow(structure, &ray);
                    let mut expected = counted(&events);
                    // Clear glass between a surface and a lamp is a hit that takes no light.
                    assert!(expected.shadow_hits <= counts.shadow_hits, "{what}");
                    expected.shadow_hits = counts.shadow_hits;
                    assert_eq!(expected, counts, "{what}: {events:#?}");
                    assert_hits_follow(&events, &what);
                    all += counts;
                }
            }
        }
    }
    // Each kind of event is held against something.
    for count in [all.primary_hits, all.shadow_hits, all.secondary_hits, all.clipped_rays, all.cells_visited]
    {
        assert!(count > 0, "{all:?}");
    }
    assert!(all.csg_evaluations > 0 && all.truncated_rays > 0, "{all:?}");
}

#[test]
fn one_ray_is_told_step_by_step() {
    let text = "world(ambient = 0.1, background = 0); light(at = [0, 0, 10]);
        material(name = \"half\", kd = 0.5, ks = 0); material(\"half\") sphere(1);";
    let scene = read("test", text.as_bytes(), &ReadOptions::default()).unwrap();
    let (eye, d) = (DVec3::new(0.0, 0.0, 3.0), DVec3::NEG_Z);
    let camera = Camera {
        name: None,
        eye,
        target: DVec3::ZERO,
        up: DVec3::Y,
        field: [10.0, 10.0],
        span: FieldSpan::Edges,
        zoom: 1.0,
    };
    let prepared = Prepared::new(scene, &camera);
    let ray = prepared.assembly.ray(&Ray::new(eye, d));
    let (light, _, events) = prepared.follow(Structure::None, &ray);
    let unit = prepared.assembly.scene_frame.unit;
    let steps: Vec<String> = events.iter().map(|event| told(event, unit)).collect();
    let expected = [
        "Eye ray along -z",
        "outcode 100000",
        "comes into the world",
        "tested 0: 2 to 4",
        "crosses 0 at 2, inward",
        "hits 0 at 2",
        "Shadow ray along z",
        "tested 0: nothing",
        "lamp 0: 0.5 + 0, visible 1",
        "has 0.09 + 0.45",
    ];
    assert_eq!(steps, expected);
    assert!(light > 0.5, "{light}");
    let aside = Ray::new(ray.o, DVec3::X);
    let (_, _, events) = prepared.follow(Structure::None, &aside);
    assert_eq!(events[2..], [RayEvent::Clipped, RayEvent::Missed]);
}

/// An event in words, lengths in the scene's unit.
fn told(event: &RayEvent, unit: f64) -> String {
    match *event {
        RayEvent::Sent { kind, ray, .. } => {
            format!("{kind:?} ray along {}", if ray.d == DVec3::Z { "z" } else { "-z" })
        }
        RayEvent::Tested { primitive, span: Some([first, last]) } => {
            format!("tested {primitive}: {:.12} to {:.12}", first * unit, last * unit)
                .replace(".000000000000", "")
        }
        RayEvent::Tested { primitive, span: None } => format!("tested {primitive}: nothing"),
        RayEvent::Crossed { primitive, t, entering, .. } => {
            format!("crosses {primitive} at {}, {}", t * unit, if entering { "inward" } else { "outward" })
        }
        RayEvent::Hit { object, t, .. } => format!("hits {object} at {}", t * unit),
        RayEvent::Lit { lamp, diffuse, highlight, visible, .. } => {
            format!("lamp {lamp}: {diffuse} + {highlight}, visible {}", visible.unwrap_or(f64::NAN))
        }
        RayEvent::Coded { outcode, .. } => format!("outcode {outcode:06b}"),
        RayEvent::Entered { .. } => "comes into the world".to_owned(),
        RayEvent::Gathered { ambient, lamps, .. } => format!("has {ambient:.2} + {lamps:.2}"),
        _ => format!("{event:?}"),
    }
}
