//! Faults are planted, and each is noticed in the layers that ought to.

use std::sync::Arc;

use ray13::frame::{Frame, Request};
use ray13::math::{DVec3, Size};
use ray13::plan::Options;
use ray13::trade::Accuracy;

use super::{given, picture, reference};

const DOTS: Size = Size::new(96, 64);

/// A ball and a block on a floor, all dull: light is what the angles say.
fn scene(lamp: f64) -> String {
    format!(
        "camera(eye = [0, -9, 4], target = [0, 0, 0.6], field = [30, 20]);\n\
         light(at = [4, -8, 9], intensity = {lamp});\n\
         world(ambient = 0, background = 0);\n\
         material(kd = 0.8) translate([-1, 0, 1]) sphere(1);\n\
         material(kd = 0.8) translate([0.5, -0.5, 0]) cube(1);\n\
         material(kd = 0.8) translate([-20, -20, -1]) cube([40, 40, 1]);\n"
    )
}

/// The accuracy of a faultless picture, and of one whose frame a fault has changed.
fn with_fault(fault: impl FnOnce(&mut Frame)) -> [Accuracy; 2] {
    let studio = given(&scene(0.9));
    let base = picture(&studio, DOTS);
    let reference = reference(&studio, &base, 16);
    let mut frame = studio.draw(&base);
    let sound = reference.accuracy(&base, &frame, None);
    fault(&mut frame);
    [sound, reference.accuracy(&base, &frame, None)]
}

/// Nothing is wrong with what a picture of the fast engine met.
#[track_caller]
fn sees_all(accuracy: &Accuracy) {
    let geometry = accuracy.geometry.unwrap();
    assert_eq!((geometry.dots, geometry.others, geometry.depth_ulps), (DOTS.area(), 0, 0));
    assert_eq!(geometry.normal, 0.0);
}

/// The first dot in scan order that sees the ball: there a ray is nearly tangent to it.
fn tangent(frame: &Frame) -> usize {
    frame.object.as_ref().unwrap().values().iter().position(|&object| object == 1).unwrap()
}

/// The dot in the middle of those that see the ball.
fn middle(frame: &Frame) -> usize {
    let objects = frame.object.as_ref().unwrap().values();
    let all: Vec<usize> = (0..objects.len()).filter(|&dot| objects[dot] == 1).collect();
    all[all.len() / 2]
}

#[test]
fn a_lost_tangent_is_another_object() {
    let [sound, faulty] = with_fault(|frame| {
        let dot = tangent(frame);
        Arc::make_mut(frame.object.as_mut().unwrap()).values_mut()[dot] = 0;
        Arc::make_mut(frame.depth.as_mut().unwrap()).values_mut()[dot] = f64::INFINITY;
        Arc::make_mut(frame.normal.as_mut().unwrap()).values_mut()[dot] = DVec3::ZERO;
        Arc::make_mut(&mut frame.light).values_mut()[dot] = 0.0;
    });
    sees_all(&sound);
    assert_eq!(faulty.geometry.unwrap().others, 1);
    // Of depths and normals only those of the same object are compared.
    assert_eq!((faulty.geometry.unwrap().depth_ulps, faulty.geometry.unwrap().normal), (0, 0.0));
}

#[test]
fn a_wrong_normal_is_an_angle_and_a_wrong_light() {
    const OFF: f64 = 10.0;
    let [sound, faulty] = with_fault(|frame| {
        let dot = middle(frame);
        let normals = Arc::make_mut(frame.normal.as_mut().unwrap());
        let normal = normals.values()[dot];
        let across = normal.any_orthonormal_vector();
        let (sin, cos) = libm::sincos(OFF.to_radians());
        normals.values_mut()[dot] = normal * cos + across * sin;
        // What ten degrees do to the cosine to the lamp, where that is 45°: a sixth.
        Arc::make_mut(&mut frame.light).values_mut()[dot] *= 5.0 / 6.0;
    });
    sees_all(&sound);
    let geometry = faulty.geometry.unwrap();
    assert_eq!((geometry.others, geometry.depth_ulps), (0, 0));
    // Each component is rounded to 2⁻⁵³: the angle, in degrees, by some 10⁻¹⁴.
    assert!((geometry.normal - OFF).abs() < 1e-12, "{}", geometry.normal);
    // One dot of all adds the square of a sixth of its light: more than half a level.
    let squared = |x: f64| x * x;
    let added = (squared(faulty.light.rms) - squared(sound.light.rms)) * DOTS.area() as f64;
    assert!(added.sqrt() > 0.25, "{added}");
}

/// A twenty-fourth more light is 116 · ∛Y · (∛(25/24) − 1) = 1.59 ∛Y more of L*: of the floor, Y ≈ 0.4, 0.14
/// of a level, so that many dots change theirs, and of no dot more than 0.19.
#[test]
fn a_brighter_lamp_is_a_wrong_light_and_nothing_else() {
    let [sound, bright] = [0.9, 0.9 * 25.0 / 24.0].map(|lamp| given(&scene(lamp)));
    let base = picture(&sound, DOTS);
    let reference = reference(&sound, &base, 16);
    let [sound, bright] = [sound, bright].map(|studio| studio.draw(&base));
    let own = sound.compare(&bright).unwrap();
    assert!(own.light > 0.1 && own.light < 0.19, "{own}");
    let [sound, bright] = [sound, bright].map(|frame| reference.accuracy(&base, &frame, None));
    sees_all(&sound);
    sees_all(&bright);
    let more = bright.light.wrong() - sound.light.wrong();
    assert!(more > 0.05 && more < 0.19, "{more}");
    assert!(bright.light.rms > sound.light.rms);
    let cells = [sound, bright].map(|accuracy| accuracy.characters.unwrap());
    assert!(cells[1].others > cells[0].others && cells[1].seen > cells[0].seen, "{cells:?}");
}

#[test]
fn a_picture_that_is_shifted_by_a_tenth_of_a_dot_is_wrong_in_all_layers() {
    let studio = given(&scene(0.9));
    let base = picture(&studio, DOTS);
    let reference = reference(&studio, &base, 64);
    // By one ray a dot the light of edges is off by more than a shift can change.
    let base = Request { options: Options { samples: 6, ..base.options }, ..base };
    let sound = studio.draw(&base);
    let shifted = studio.draw(&reference.turned(&base));
    // Of the dots at the edges of objects a tenth sees another, across and down together up to twice as many.
    let objects = sound.object.as_ref().unwrap();
    let edges = (0..DOTS.height)
        .flat_map(|y| (1..DOTS.width).map(move |x| (x, y)))
        .filter(|&(x, y)| objects[(x, y)] != objects[(x - 1, y)])
        .count();
    let accuracy = reference.accuracy(&base, &shifted, None);
    let geometry = accuracy.geometry.unwrap();
    assert!(geometry.others * 20 >= edges && geometry.others * 2 <= edges, "{} of {edges}", geometry.others);
    assert!(geometry.depth_ulps > 1 << 30, "{}", geometry.depth_ulps);
    let sound = reference.accuracy(&base, &sound, Some(&shifted));
    assert!(accuracy.light.rms > sound.light.rms, "{accuracy:?}, {sound:?}");
    assert!(accuracy.characters.unwrap().seen > sound.characters.unwrap().seen);
}

#[test]
fn one_ray_a_dot_flickers_more_than_many() {
    let studio = given(&scene(0.9));
    let base = picture(&studio, DOTS);
    let reference = reference(&studio, &base, 16);
    let [still, turned] = [base.clone(), reference.turned(&base)].map(|request| studio.draw(&request));
    let flicker = reference.accuracy(&base, &still, Some(&turned)).characters.unwrap().shimmer.unwrap();
    assert!(flicker > reference.shimmer().unwrap(), "{flicker}");
    // The same picture again does not.
    let none = reference.accuracy(&base, &still, Some(&still)).characters.unwrap().shimmer;
    assert_eq!(none, Some(0.0));
}
