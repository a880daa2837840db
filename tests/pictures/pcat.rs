//! Figures 8 and 9 of the paper, as `--preset pcat` draws them, and a third picture from inside the world.

use crate::support::scenery::embedded_scenes;
use ray13::frame::{Studio, pcat};
use ray13::output::levels;

fn hanyang() -> Studio {
    let scene = embedded_scenes().into_iter().find(|(name, _)| *name == "hanyang");
    Studio::new(scene.expect("the first scene").1).unwrap()
}

#[test]
fn the_pictures_of_the_paper() {
    let studio = hanyang();
    for (index, view) in studio.scene().views.iter().enumerate() {
        let request = pcat::request(studio.camera(index, 1.0));
        let frame = studio.draw(&request);
        let mut text = Vec::new();
        levels(&frame.levels(request.tone), &mut text).unwrap();
        let name = view.name.as_deref().expect("a named view");
        insta::assert_snapshot!(name.to_owned(), String::from_utf8(text).unwrap());
    }
}

#[test]
fn the_field_is_kept_on_dots_that_are_not_square() {
    let studio = hanyang();
    for index in 0..studio.scene().views.len() {
        let frame = studio.draw(&pcat::request(studio.camera(index, 1.0)));
        let off = [frame.field[0] - 40.0, frame.field[1] - 25.0];
        assert!(off.iter().all(|o| o.abs() < 1e-12), "{:?}", frame.field);
        assert_eq!((frame.light.size().width, frame.light.size().height), (164, 188));
        assert_eq!((frame.counts.shadow_rays, frame.counts.secondary_rays), (0, 0));
        assert_eq!(frame.space.name(), "lattice");
    }
}
