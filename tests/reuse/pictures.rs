//! Glyphs, palette and tone: the light of the picture before is there.

use std::sync::Arc;

use ray13::frame::{Frame, Request, Studio, Wants};
use ray13::glyph::{ColorDepth, GlyphMode, Palette};
use ray13::math::Size;
use ray13::scene::{self, ReadOptions};
use ray13::stage::{Counts, Stage};
use ray13::tone::Tone;

use crate::support::agreement::assert_same_picture;
use crate::support::request::request;

/// Not a multiple of any tile, with a rim of half a cell.
const DOTS: Size = Size::new(121, 83);

fn studio() -> Studio {
    let text = b"color([0.9, 0.4, 0.1]) difference() { cube(2, center = true); sphere(1.3); }";
    Studio::new(scene::read("part.csg", text, &ReadOptions::default()).unwrap()).unwrap()
}

fn plain(studio: &Studio) -> Request {
    Request { wants: Wants::CELLS, ..request(studio.camera(0, 1.5), DOTS) }
}

/// Its light was computed, and takes time and counts.
#[track_caller]
fn assert_traced(frame: &Frame) {
    assert!(frame.counts.primary_hits > 0);
    assert!(!frame.trace.is_zero() && !frame.times[Stage::Shade].is_zero());
}

/// Its light was there, for nothing.
#[track_caller]
fn assert_taken_over(frame: &Frame) {
    assert_eq!(frame.counts, Counts::default());
    assert!(frame.trace.is_zero() && frame.times[Stage::Shade].is_zero());
}

#[test]
fn the_same_request_is_answered_by_the_same_grids() {
    let studio = studio();
    let first = studio.draw(&plain(&studio));
    let again = studio.draw(&plain(&studio));
    assert_traced(&first);
    assert_taken_over(&again);
    assert!(Arc::ptr_eq(&first.light, &again.light));
    assert!(Arc::ptr_eq(first.cells.as_ref().unwrap(), again.cells.as_ref().unwrap()));
    assert_eq!(again.times.total(), std::time::Duration::ZERO);
}

#[test]
fn a_fresh_picture_is_traced_whatever_was_drawn_before() {
    let studio = studio();
    let first = studio.draw(&plain(&studio));
    let fresh = studio.draw_anew(&plain(&studio));
    assert_eq!(first.counts, fresh.counts);
    assert_traced(&fresh);
    assert!(!Arc::ptr_eq(&first.light, &fresh.light));
    assert_same_picture("drawn anew", &fresh, &first);
}

#[test]
fn glyphs_palette_and_tone_need_no_rays() {
    let studio = studio();
    let plain = plain(&studio);
    studio.draw(&plain);
    for changed in [
        Request { glyphs: GlyphMode::Braille, ..plain.clone() },
        Request { palette: Palette::Gray(ColorDepth::Direct), ..plain.clone() },
        Request { tone: Tone::Even, ..plain.clone() },
    ] {
        let before = studio.draw(&plain).cells;
        let frame = studio.draw(&changed);
        assert_taken_over(&frame);
        assert!(!frame.times[Stage::Dither].is_zero());
        assert_ne!(frame.cells, before);
        assert_same_picture(&format!("{changed:?}"), &frame, &self::studio().draw(&changed));
    }
}

#[test]
fn whatever_dots_depend_on_is_computed() {
    let studio = studio();
    let plain = plain(&studio);
    let changed: [fn(&mut Request); 9] = [
        |r| r.camera.zoom = 1.5,
        |r| r.dots.width += 1,
        |r| r.dot_aspect = 0.5,
        |r| r.options.shadows = false,
        |r| r.options.samples = 2,
        |r| r.options.threads = 1,
        |r| r.palette = Palette::Color(ColorDepth::Direct),
        |r| r.options.color = true,
        |r| r.wants.depth = true,
    ];
    for change in changed {
        studio.draw(&plain);
        let mut request = plain.clone();
        change(&mut request);
        let frame = studio.draw(&request);
        assert_traced(&frame);
        assert_same_picture(&format!("{request:?}"), &frame, &self::studio().draw(&request));
    }
}

#[test]
fn a_frame_has_what_is_wanted_and_nothing_else() {
    let studio = studio();
    let all = Request { wants: Wants::ALL, ..plain(&studio) };
    let full = studio.draw(&all);
    let light = studio.draw(&Request { wants: Wants::LIGHT, ..all.clone() });
    assert_taken_over(&light);
    assert!(
        light.cells.is_none() && light.depth.is_none() && light.normal.is_none() && light.object.is_none()
    );
    assert_eq!(light.light, full.light);
    for wants in [
        Wants { depth: true, ..Wants::LIGHT },
        Wants { normal: true, ..Wants::LIGHT },
        Wants { object: true, ..Wants::LIGHT },
        Wants::CELLS,
    ] {
        let frame = self::studio().draw(&Request { wants, ..all.clone() });
        assert_eq!(frame.depth, full.depth.clone().filter(|_| wants.depth));
        assert_eq!(frame.normal, full.normal.clone().filter(|_| wants.normal));
        assert_eq!(frame.object, full.object.clone().filter(|_| wants.object));
        assert_eq!(frame.cells, full.cells.clone().filter(|_| wants.cells));
    }
    // The studio still has them.
    assert_taken_over(&studio.draw(&all));
}

#[test]
fn a_frame_stays_as_it_is_while_others_are_drawn() {
    let studio = studio();
    let mut request = Request { wants: Wants::ALL, ..plain(&studio) };
    let kept = studio.draw(&request);
    let copy = Frame { light: Arc::new((*kept.light).clone()), ..kept.clone() };
    for step in 1..5 {
        request.camera.zoom = 1.0 + f64::from(step);
        // Dropped, so that the next picture takes its memory.
        let frame = studio.draw(&request);
        assert_ne!(frame.light, kept.light);
    }
    assert_same_picture("kept while others are drawn", &kept, &copy);
    request.camera.zoom = 1.0;
    assert_same_picture("after others", &studio.draw(&request), &kept);
}
