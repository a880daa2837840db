//! A ray that is followed is the picture's: the same light to the last bit.

use ray13::frame::Studio;
use ray13::math::Size;
use ray13::plan::EngineChoice;
use ray13::shade::Channel;
use ray13::stage::RayEvent;

use crate::support::request::request;
use crate::support::scenery::embedded_scenes;

#[test]
fn has_the_light_of_its_dot() {
    let mut hits = 0;
    for (name, scene) in embedded_scenes() {
        let studio = Studio::new(scene).unwrap();
        let mut request = request(studio.camera(0, 1.5), Size::new(9, 6));
        request.options.engine = EngineChoice::Exact;
        let frame = studio.draw(&request);
        for row in 0..6 {
            for column in 0..9 {
                let followed = studio.follow(&request, [column, row]).unwrap();
                let what = format!("{name}, {column}, {row}");
                assert_eq!(followed.light.gray(), frame.light[(column, row)], "{what}");
                let hit = followed.events.iter().any(|event| matches!(event, RayEvent::Hit { .. }));
                assert_eq!(hit, frame.object.as_ref().unwrap()[(column, row)] > 0, "{what}");
                hits += usize::from(hit);
            }
        }
        assert!(studio.follow(&request, [9, 0]).is_none() && studio.follow(&request, [0, 6]).is_none());
    }
    assert!(hits > 100, "{hits} hits");
}
