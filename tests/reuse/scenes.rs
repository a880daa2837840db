//! Another light, material or world in the same solids: they are neither put together nor traced again.

use ray13::frame::{Request, Studio};
use ray13::math::DVec3;
use ray13::plan::{Options, Shading};
use ray13::scene::{Anchor, Light, Material, MaterialId, Scene, Solid};
use ray13::solid::AssemblyError;

use super::hits::{DOTS, FLUSH, SURFACES, all, assert_looked_up, assert_same, assert_traced, scene};
use crate::support::request::request;

/// A change of a scene, by what it changes.
type Change = (&'static str, fn(&mut Scene));

/// The same solids, in another light and of other materials.
fn changed() -> Vec<Change> {
    vec![
        ("a light", |s| s.lights.push(lamp(DVec3::new(-3.0, -9.0, 7.0), DVec3::ONE))),
        ("one light, of a colour", |s| {
            s.lights = vec![lamp(DVec3::new(5.0, -5.0, 9.0), DVec3::new(1.0, 0.6, 0.2))];
        }),
        ("the world", |s| {
            s.world.ambient = DVec3::new(0.2, 0.1, 0.3);
            (s.world.background, s.world.k) = (DVec3::splat(0.4), Some(2.0));
        }),
        ("no mirrors and no glass", |s| {
            s.materials.iter_mut().for_each(|m| (m.kr, m.kt) = (0.0, 0.0));
        }),
        ("all of glass", |s| {
            for m in &mut s.materials {
                *m = Material { kt: 0.6, kr: 0.1, index: 1.3, kd: 0.2, ..m.clone() };
            }
        }),
        ("one material", |s| {
            s.materials = vec![Material { color: DVec3::new(0.2, 0.7, 0.4), ..Material::default() }];
            s.objects.iter_mut().for_each(|object| paint(&mut object.solid, &mut || MaterialId(0)));
        }),
        ("materials by turns", |s| {
            s.materials.push(Material { kt: 0.5, kr: 0.2, ..Material::default() });
            let last = s.materials.len() as u32 - 1;
            let mut turn = 0;
            let mut next = || {
                turn = (turn + 1) % 2;
                MaterialId(turn * last)
            };
            s.objects.iter_mut().for_each(|object| paint(&mut object.solid, &mut next));
        }),
        ("names", |s| s.objects.iter_mut().for_each(|object| object.name = Some("a".into()))),
    ]
}

fn lamp(at: DVec3, color: DVec3) -> Light {
    Light { anchor: Anchor::World(at), intensity: 0.8, color }
}

fn paint(solid: &mut Solid, next: &mut impl FnMut() -> MaterialId) {
    match solid {
        Solid::Primitive(p) => p.material = next(),
        Solid::Union(parts) | Solid::Intersection(parts) | Solid::Difference(parts) => {
            for part in parts {
                paint(part, next);
            }
        }
    }
}

#[test]
fn what_does_not_depend_on_light_and_materials_is_kept() {
    for (name, scene, plain) in all() {
        let on = |threads| Request { options: Options { threads, ..plain.options }, ..plain.clone() };
        let mut studios = [on(1), on(2)].map(|request| {
            let studio = Studio::new(scene.clone()).unwrap();
            let before = studio.draw(&request);
            let built = studio.built();
            (studio, request, before, built)
        });
        for (number, (what, change)) in changed().into_iter().enumerate() {
            let mut scene = scene.clone();
            change(&mut scene);
            let anew = Studio::new(scene.clone()).unwrap().draw_anew(&plain);
            for (studio, request, _, built) in &mut studios {
                studio.set_scene(scene.clone()).unwrap();
                assert_eq!(studio.scene(), &scene);
                let frame = studio.draw(request);
                let what = format!("{name}, {what}, {} threads", request.options.threads);
                assert_same(&frame, &anew, &what);
                // The first change keeps what it traces.
                if number == 0 {
                    assert_traced(&frame, &anew, &what);
                } else {
                    assert_looked_up(&frame, &anew, &what);
                }
                assert_eq!(studio.built(), *built, "{what}");
            }
        }
        for (studio, request, before, _) in &mut studios {
            studio.set_scene(scene.clone()).unwrap();
            assert_same(&studio.draw(request), before, name);
        }
    }
}

#[test]
fn an_edited_file_keeps_its_solids_and_numbers_its_materials_anew() {
    let edits = [
        (FLUSH, "flush.scene", "[0.9, 0.3, 0.2]", "[0.2, 0.3, 0.9]"),
        (FLUSH, "flush.scene", "kt = 0.7", "kt = 0"),
        (SURFACES, "surfaces.nff", "f 0.3 0.5 0.8 0.8 0.2 20 0.5 1.2", "f 0.8 0.5 0.3 0.8 0.2 20 0 1"),
        (SURFACES, "surfaces.nff", "l 4 -6 8 1 1 1\n", ""),
    ];
    for (text, name, from, to) in edits {
        assert!(text.contains(from));
        let mut studio = Studio::new(scene(name, text)).unwrap();
        let plain = request(studio.camera(0, 1.5), DOTS);
        let flat =
            Request { options: Options { shading: Shading::Lambert, ..plain.options }, ..plain.clone() };
        for request in [&flat, &plain] {
            studio.draw(request);
        }
        let edited = scene(name, &text.replacen(from, to, 1));
        studio.set_scene(edited.clone()).unwrap();
        let (frame, anew) = (studio.draw(&plain), Studio::new(edited).unwrap().draw_anew(&plain));
        assert_looked_up(&frame, &anew, &format!("{name}, {to}"));
        assert_same(&frame, &anew, to);
    }
}

#[test]
fn other_solids_are_made_ready_anew() {
    let text = "light(at = [3, -4, 5]); difference() { cube(2); sphere(1); } cylinder(h = 3, r = 0.4);";
    for (from, to) in [
        ("cube(2)", "cube(2.5)"),
        ("difference", "union"),
        ("difference", "intersection"),
        ("sphere(1);", ""),
        ("sphere(1)", "cylinder(h = 1, r = 1)"),
        ("r = 0.4", "r1 = 0.4, r2 = 0.2"),
        (" cylinder(h = 3, r = 0.4);", ""),
    ] {
        let mut studio = Studio::new(scene("a.scene", text)).unwrap();
        let plain = request(studio.camera(0, 1.5), DOTS);
        let flat =
            Request { options: Options { shading: Shading::Lambert, ..plain.options }, ..plain.clone() };
        for request in [&plain, &flat] {
            studio.draw(request);
        }
        let edited = scene("a.scene", &text.replacen(from, to, 1));
        assert!(!studio.scene().has_solids_of(&edited), "{to}");
        studio.set_scene(edited.clone()).unwrap();
        let (frame, anew) = (studio.draw(&plain), Studio::new(edited).unwrap().draw_anew(&plain));
        assert_traced(&frame, &anew, to);
        assert_same(&frame, &anew, to);
    }
}

#[test]
fn a_scene_that_can_not_be_put_together_leaves_the_studio_as_it_was() {
    let mut studio = Studio::new(scene("a.scene", "sphere(1);")).unwrap();
    let plain = request(studio.camera(0, 1.5), DOTS);
    let (before, own) = (studio.draw(&plain), studio.scene().clone());
    let mut flat = own.clone();
    let Solid::Primitive(ball) = &mut flat.objects[0].solid else { panic!("one ball") };
    ball.map.matrix3.x_axis = DVec3::ZERO;
    let error = studio.set_scene(flat).unwrap_err();
    assert_eq!(error, AssemblyError::Singular { object: 1, primitive: 1 });
    assert_eq!(studio.scene(), &own);
    assert_same(&studio.draw(&plain), &before, "the ball");
}
