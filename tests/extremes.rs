//! Scenes and views at the ends of what numbers can hold. Each of these came from an attack on the program that found
//! it wanting.

mod request;

use ray13::frame::{Frame, Studio};
use ray13::math::{DVec3, Size};
use ray13::plan::StructureChoice;
use ray13::scene::{Camera, ReadOptions, read};
use ray13::tone::Tone;
use request::request;

/// Odd, so that one dot looks along the line of sight.
const DOTS: Size = Size::new(21, 21);

/// The same picture by every structure.
#[track_caller]
fn drawn(text: &str, eye: DVec3, target: DVec3) -> Frame {
    let scene = read("extreme", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let camera = Camera {
        name: None,
        eye,
        target,
        up: DVec3::new(0.1, 1.0, 0.2),
        field: [30.0, 30.0],
        span: ray13::scene::FieldSpan::Edges,
        zoom: 1.0,
    };
    let studio = Studio::new(scene).unwrap();
    let choices = [StructureChoice::None, StructureChoice::Lattice, StructureChoice::Tree];
    let [frame, others @ ..] = choices.map(|structure| {
        let mut request = request(camera.clone(), DOTS);
        request.options.structure = structure;
        studio.draw(&request)
    });
    for other in others {
        assert_eq!(
            (&frame.depth, &frame.object, &frame.normal),
            (&other.depth, &other.object, &other.normal)
        );
        assert_eq!(frame.light, other.light);
    }
    frame
}

const MIDDLE: (u32, u32) = (10, 10);

// The error of a crossing at the apex was infinite: alone, the cone was entered through its base; in a composite,
// the crossing took all those behind it along.
#[test]
fn a_ray_through_the_apex_meets_the_cone() {
    let cone = "cylinder(h = 2, r1 = 1, r2 = 0, center = true);";
    for text in [cone.to_owned(), format!("difference() {{ {cone} translate([5, 0, 0]) sphere(1); }}")] {
        let above = drawn(&text, DVec3::new(3.0, 0.0, 9.0), DVec3::Z);
        assert!((above.depth[MIDDLE] - 73_f64.sqrt()).abs() < 1e-9, "{text} {}", above.depth[MIDDLE]);
    }
    let within = format!("difference() {{ {cone} translate([5, 0, 0]) sphere(1); }}");
    assert!((drawn(&within, DVec3::Z, DVec3::ZERO).depth[MIDDLE] - 2.0).abs() < 1e-9);
}

// From 1e155 on the square of a light's distance overflowed, and it lit nothing.
#[test]
fn a_light_lights_from_any_distance() {
    let lit = |at: f64| {
        let text = format!("light(at = [0, -{at:e}, {at:e}]); sphere(1); translate([0, 0, 2]) cube(1);");
        drawn(&text, DVec3::new(4.0, -6.0, 5.0), DVec3::ZERO).levels(Tone::default())
    };
    for at in [1e150, 1e160, 1e300, 1e308] {
        assert_eq!(lit(at), lit(1e20), "{at:e}");
    }
}

// An eye farther away than numbers can hold, in the scene's own size, gave rays without a start.
#[test]
fn an_eye_at_any_distance_sees_nothing_or_something() {
    for (size, far) in [(1.0, 1e300), (1e-150, 1e200), (1e-300, 1e308)] {
        let frame = drawn(&format!("sphere({size:e});"), DVec3::new(far, 0.0, 0.3 * far), DVec3::ZERO);
        assert!(frame.light.values().iter().all(|light| light.is_finite()));
        let nothing = |place: usize| frame.object.values()[place] == 0;
        assert!((0..DOTS.area()).all(|p| frame.depth.values()[p].is_finite() != nothing(p)), "{size} {far}");
    }
}

// Each object that coincides with the nearest was compared with all others: a minute for a picture of these.
#[test]
fn thousands_of_objects_may_coincide() {
    let frame = drawn(&"sphere(1);".repeat(4000), DVec3::new(4.0, -6.0, 5.0), DVec3::ZERO);
    assert_eq!(frame.object[MIDDLE], 1);
}
