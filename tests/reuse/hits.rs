//! Another light from the same view: the rays from the eye are not traced again.

use ray13::frame::{Frame, Request, Studio, Wants};
use ray13::glyph::{ColorDepth, Palette};
use ray13::math::{DVec3, Size};
use ray13::plan::{EngineChoice, Options, Precision, PrecisionChoice, Shading, StructureChoice};
use ray13::scene::{ReadOptions, Scene, read};

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;
use crate::support::scenery::embedded_scenes;

/// Several tiles, those at the rim cut, and their last blocks too.
pub const DOTS: Size = Size::new(43, 35);

pub fn scene(name: &str, text: &str) -> Scene {
    read(name, text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// Solids flush with each other, opaque and of glass, of which another one shows where glass lets no light
/// through; and one that is not convex.
pub const FLUSH: &str = "
    camera(eye = [-4, -7, 5], target = [1, 1, 0.5], field = [45, 30]);
    light(at = [-6, -2, 9], intensity = 0.7); light(at = [4, -8, 3], intensity = 0.3);
    material(kt = 0.7, kr = 0.1, index = 1.5, color = [0.7, 0.9, 0.8]) cube(2);
    color([0.9, 0.3, 0.2]) translate([0, 0, 1]) cube([1, 2, 1]);
    translate([1, 0, 0]) cube([2, 1, 2]);
    color([0.2, 0.3, 0.9]) translate([2, 0, 0]) cube([1, 3, 1]);
    translate([0, 2.5, 1]) polyhedron([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, 0.25]],
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]);
";

/// Surfaces that bound no solid: polygons, one above the other, patches with normals of their own, cones; and
/// a mirror.
pub const SURFACES: &str = include_str!("../files/surfaces.nff");

/// A solid that is not convex, from so far that the way there is most of each distance.
const FAR: &str = "
    light(at = [6, -6, 8]);
    polyhedron([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, 0.25]],
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]);
    translate([0, 0, -1.5]) cube(2, center = true);
    translate([0, 0, -1.5]) rotate(45) cube(2, center = true);
";

/// Scenes with a view of each.
pub fn all() -> Vec<(&'static str, Scene, Request)> {
    let mut scenes = embedded_scenes();
    scenes.push(("flush", scene("flush.scene", FLUSH)));
    scenes.push(("surfaces", scene("surfaces.nff", SURFACES)));
    let plain = |(name, scene): (&'static str, Scene)| {
        let studio = Studio::new(scene.clone()).unwrap();
        (name, scene, request(studio.camera(0, f64::from(DOTS.width) / f64::from(DOTS.height)), DOTS))
    };
    let mut all: Vec<_> = scenes.into_iter().map(plain).collect();
    let (name, far, mut request) = plain(("far", scene("far.scene", FAR)));
    let camera = &mut request.camera;
    (camera.eye, camera.zoom) = (camera.target + (camera.eye - camera.target) * 1e5, 1e5);
    all.push((name, far, request));
    all
}

/// All that light depends on beside the view and the scene, each changed.
fn changes(plain: &Request) -> Vec<Request> {
    let with = |change: fn(&mut Options)| {
        let mut request = plain.clone();
        change(&mut request.options);
        request
    };
    let mut all = vec![
        with(|o| o.shading = Shading::Lambert),
        with(|o| o.shading = Shading::Depth),
        with(|o| o.shading = Shading::Phong),
        with(|o| o.shadows = false),
        with(|o| o.depth = 1),
        with(|o| o.cutoff = 0.3),
        with(|o| o.color = true),
        with(|o| o.threads = 1),
        with(|o| o.threads = 2),
        with(|o| o.samples = 2),
        with(|o| o.engine = EngineChoice::Fast),
        plain.clone(),
    ];
    all.push(Request { palette: Palette::Color(ColorDepth::Direct), ..plain.clone() });
    all
}

/// The share of all hits that lie, in any of these scenes, where several surfaces are in one place: which of
/// them shows is a question of material, and their rays are traced again. [`FLUSH`] has the most.
const MOST_IN_ONE_PLACE: f64 = 0.6;

/// The picture was traced as if nothing had been kept.
#[track_caller]
pub fn assert_traced(frame: &Frame, anew: &Frame, what: &str) {
    assert_eq!(frame.counts.primary_hits, anew.counts.primary_hits, "{what}");
    assert_eq!(frame.counts.primary_rays, anew.counts.primary_rays, "{what}");
}

/// What rays from the eye met was looked up, but for those that are told about materials.
#[track_caller]
pub fn assert_looked_up(frame: &Frame, anew: &Frame, what: &str) {
    assert_eq!(frame.counts.primary_hits, anew.counts.primary_hits, "{what}");
    let (again, hits) = (frame.counts.primary_rays, anew.counts.primary_hits);
    assert!(again as f64 <= MOST_IN_ONE_PLACE * hits as f64, "{what}: {again} rays traced for {hits} hits");
}

#[track_caller]
pub fn assert_same(frame: &Frame, anew: &Frame, what: &str) {
    assert_same_picture(what, frame, anew);
}

#[test]
fn another_light_from_the_same_view_is_the_same_as_anew() {
    for (name, scene, plain) in all() {
        let fresh = Studio::new(scene.clone()).unwrap();
        let studio = Studio::new(scene).unwrap();
        assert_traced(&studio.draw(&plain), &fresh.draw_anew(&plain), name);
        for (number, request) in changes(&plain).iter().enumerate() {
            let what = format!("{name}, {:?}", request.options);
            let (frame, anew) = (studio.draw(request), fresh.draw_anew(request));
            assert_same(&frame, &anew, &what);
            // The first sample is the ray through the middle.
            let beside = u64::from(request.options.samples.pow(2) - 1) * DOTS.area() as u64;
            if number == 0 {
                // The first change keeps what it traces.
                assert_traced(&frame, &anew, &what);
            } else if request.options.samples > 1 {
                // Only what the ray through the middle of a dot met is kept.
                let rays = [frame.counts.primary_rays, anew.counts.primary_rays];
                assert!(beside <= rays[0] && rays[0] < rays[1], "{what}: {rays:?}, {beside} beside middles");
            } else {
                assert_looked_up(&frame, &anew, &what);
            }
        }
    }
}

#[test]
fn no_ray_from_the_eye_is_traced_where_no_two_surfaces_lie_in_one_place() {
    let text = "light(at = [3, -4, 5]); sphere(1); translate([1.5, 0, 0]) cube(1);";
    for (name, scene) in embedded_scenes().into_iter().chain([("apart", scene("apart.scene", text))]) {
        let studio = Studio::new(scene).unwrap();
        let plain = request(studio.camera(0, 1.5), DOTS);
        for request in changes(&plain).iter().filter(|request| request.options.samples == 1) {
            studio.draw(request);
        }
        let unlit = Options { shading: Shading::Lambert, shadows: false, ..plain.options };
        let frame = studio.draw(&Request { options: unlit, ..plain });
        assert!(frame.counts.primary_hits > 0 && !frame.trace.is_zero(), "{name}");
        let counts = frame.counts;
        assert_eq!((counts.primary_rays, counts.cells_visited, counts.primitive_tests), (0, 0, 0), "{name}");
    }
}

#[test]
fn where_surfaces_lie_in_one_place_materials_are_asked_again() {
    let studio = Studio::new(scene("flush.scene", FLUSH)).unwrap();
    let plain = request(studio.camera(0, 1.5), DOTS);
    let drawn = changes(&plain)[..3].iter().map(|request| studio.draw(request)).collect::<Vec<_>>();
    let again = drawn[2].counts.primary_rays;
    assert!(0 < again && again < drawn[2].counts.primary_hits, "{again}");
}

#[test]
fn what_is_wanted_beside_light_needs_no_rays_either() {
    for (name, scene, plain) in all() {
        let studio = Studio::new(scene).unwrap();
        let anew = studio.draw_anew(&plain);
        let light = |shading| Request {
            wants: Wants::LIGHT,
            options: Options { shading, ..plain.options },
            ..plain.clone()
        };
        studio.draw(&light(Shading::Lambert));
        studio.draw(&light(Shading::Phong));
        let frame = studio.draw(&plain);
        assert_same(&frame, &anew, name);
        assert_looked_up(&frame, &anew, name);
    }
}

#[test]
fn another_view_is_traced() {
    let (name, scene, plain) = all().swap_remove(0);
    let fresh = Studio::new(scene.clone()).unwrap();
    let studio = Studio::new(scene).unwrap();
    let views: [fn(&mut Request); 7] = [
        |r| r.camera.zoom = 1.5,
        |r| r.camera.eye += DVec3::new(0.1, 0.0, 0.0),
        |r| r.camera.up = DVec3::new(0.1, 0.0, 1.0),
        |r| r.dots.width += 1,
        // As many tiles.
        |r| r.dots.height -= 1,
        |r| r.dot_aspect = 0.5,
        |r| r.camera.field[0] += 1.0,
    ];
    for change in views {
        let flat = Options { shading: Shading::Lambert, ..plain.options };
        let mut other = plain.clone();
        change(&mut other);
        // The second is kept, and not what the third has.
        let requests = [plain.clone(), Request { options: flat, ..plain.clone() }, other.clone()];
        let [_, _, frame] = requests.each_ref().map(|request| studio.draw(request));
        let anew = fresh.draw_anew(&other);
        assert_traced(&frame, &anew, &format!("{other:?}"));
        assert_same(&frame, &anew, name);
        let back = studio.draw(&plain);
        assert_traced(&back, &fresh.draw_anew(&plain), &format!("what {other:?} left"));
    }
}

#[test]
fn a_picture_that_is_drawn_anew_takes_nothing_over_and_leaves_nothing() {
    let (name, scene, plain) = all().swap_remove(0);
    let studio = Studio::new(scene).unwrap();
    let flat = Request { options: Options { shading: Shading::Lambert, ..plain.options }, ..plain.clone() };
    let [_, _, kept] = [&plain, &flat, &plain].map(|request| studio.draw(request));
    let anew = studio.draw_anew(&plain);
    assert_looked_up(&kept, &anew, name);
    assert_eq!(anew.counts.primary_rays, DOTS.area() as u64);
    assert_same(&kept, &anew, name);
    assert_traced(&studio.draw(&flat), &studio.draw_anew(&flat), name);
}

#[test]
fn the_exact_engine_traces_anew_and_leaves_what_was_kept() {
    let (name, scene, plain) = all().swap_remove(0);
    let studio = Studio::new(scene).unwrap();
    let anew = studio.draw_anew(&plain);
    let flat = Options { shading: Shading::Lambert, ..plain.options };
    let exact = Options { engine: EngineChoice::Exact, structure: StructureChoice::Tree, ..plain.options };
    let [_, exact, frame] =
        [flat, exact, plain.options].map(|options| studio.draw(&Request { options, ..plain.clone() }));
    assert_traced(&exact, &anew, name);
    assert_looked_up(&frame, &anew, name);
    assert_same(&exact, &anew, name);
    assert_same(&frame, &anew, name);
}

/// Shadows are what the digits depend on: hits of one kind were kept until the view changed, and no others.
#[test]
fn hits_of_half_the_digits_and_of_all_are_kept_side_by_side() {
    let text = "light(at = [6, -6, 8]); difference() { cube(2, center = true); sphere(1.2); }";
    let [studio, fresh] = [(); 2].map(|()| Studio::new(scene("cut.scene", text)).unwrap());
    let plain = request(studio.camera(0, 1.0), DOTS);
    let ask = |shadows: bool, shading: Shading| {
        let options = Options { shadows, shading, precision: PrecisionChoice::Auto, ..plain.options };
        Request { options, ..plain.clone() }
    };
    let mut traced = Vec::new();
    for (shadows, shading) in [
        (false, Shading::Lambert),
        (false, Shading::Depth),
        (true, Shading::Lambert),
        (false, Shading::Phong),
        (true, Shading::Depth),
        (false, Shading::Lambert),
    ] {
        let request = ask(shadows, shading);
        let (frame, anew) = (studio.draw(&request), fresh.draw_anew(&request));
        assert_eq!(frame.precision, if shadows { Precision::Double } else { Precision::Single });
        assert_same_picture(&format!("{:?}", request.options), &frame, &anew);
        traced.push(frame.counts.primary_rays > 0);
    }
    assert_eq!(traced, [true, true, true, false, false, false]);
}
