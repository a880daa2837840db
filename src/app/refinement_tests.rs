//! What is drawn after what.

use super::*;
use crate::frame::{Studio, Wants};
use crate::glyph::{GlyphMode, Palette};
use crate::math::{Grid, Size};
use crate::scene::Scene;
use crate::stage::Counts;
use crate::tone::Tone;

const MS: Duration = Duration::from_millis(1);

/// A request told apart by its zoom.
fn request(zoom: f64) -> Request {
    let camera = Studio::new(Scene::default()).unwrap().camera(0, 1.0);
    Request {
        camera: crate::scene::Camera { zoom, ..camera },
        dots: Size::new(160, 96),
        dot_aspect: 1.0,
        options: Options::default(),
        wants: Wants::CELLS,
        glyphs: GlyphMode::Blocks,
        palette: Palette::DOS,
        tone: Tone::Lightness,
    }
}

fn blank(dots: Size) -> Frame {
    Frame::blank(dots, Grid::from_values(Size::new(0, 0), Vec::new()))
}

/// Draws the next picture, which takes so long for each dot that it would be as long for all of them.
fn draw(refinement: &mut Refinement, wanted: &Request, all: Duration) -> Option<(Order, String)> {
    let detail = refinement.next(wanted)?;
    let order = refinement.begin(wanted, detail, Instant::now());
    assert_eq!(refinement.next(wanted), None);
    let drawn = order.request.coarser(order.factor).dots.area() as u64;
    let samples = u64::from(order.request.options.samples).pow(2);
    let blank = blank(wanted.dots);
    let frame = Frame {
        counts: Counts { primary_rays: drawn * samples, ..Counts::default() },
        total: all.mul_f64((drawn * samples) as f64 / wanted.dots.area() as f64),
        ..blank
    };
    let told = refinement.finished(&frame).unwrap();
    Some((order, told.to_string()))
}

fn all(refinement: &mut Refinement, wanted: &Request, time: Duration) -> Vec<String> {
    std::iter::from_fn(|| draw(refinement, wanted, time)).map(|(_, told)| told).collect()
}

#[test]
fn at_rest_a_picture_gets_better_until_it_is_what_was_asked_for() {
    let mut refinement = Refinement::new(Some(50 * MS), true);
    assert_eq!(all(&mut refinement, &request(1.0), MS), ["1 a dot", "adaptive"]);
    // While it fits, the eye sees every dot; then larger ones, as many as fit.
    assert_eq!(all(&mut refinement, &request(2.0), 60 * MS), ["1 a dot", "adaptive"]);
    assert_eq!(all(&mut refinement, &request(3.0), 60 * MS), ["1 for 4 dots", "1 a dot", "adaptive"]);
    assert_eq!(all(&mut refinement, &request(4.0), 600 * MS), ["1 for 4 dots", "1 a dot", "adaptive"]);
    assert_eq!(all(&mut refinement, &request(5.0), 600 * MS), ["1 for 16 dots", "1 a dot", "adaptive"]);
    assert_eq!(all(&mut refinement, &request(6.0), 600_000 * MS)[0], "1 for 16 dots");
    assert_eq!(all(&mut refinement, &request(7.0), 600_000 * MS)[0], "1 for 64 dots");
    // Then there is nothing more to do.
    assert_eq!(refinement.next(&request(7.0)), None);
}

#[test]
fn a_key_that_is_held_has_pictures_that_fit() {
    let mut refinement = Refinement::new(Some(50 * MS), true);
    let mut told = Vec::new();
    for zoom in 1..5 {
        // The next key is there before the picture is refined.
        told.push(draw(&mut refinement, &request(f64::from(zoom)), 300 * MS).unwrap().1);
    }
    assert_eq!(told, ["1 a dot", "1 for 9 dots", "1 for 9 dots", "1 for 9 dots"]);
    // Where it is quick again, that is seen at once.
    draw(&mut refinement, &request(5.0), 20 * MS);
    assert_eq!(draw(&mut refinement, &request(6.0), 20 * MS).unwrap().1, "1 a dot");
}

#[test]
fn what_was_asked_for_is_what_there_is_at_rest() {
    let with = |samples, adaptive| {
        let options = Options { samples, adaptive, ..Options::default() };
        Request { options, ..request(1.0) }
    };
    // `--aa off`.
    let mut off = Refinement::new(Some(50 * MS), false);
    assert_eq!(all(&mut off, &request(1.0), 100 * MS), ["1 a dot"]);
    assert_eq!(all(&mut off, &request(2.0), 100 * MS), ["1 for 4 dots", "1 a dot"]);
    // `--samples 3`, which is drawn at once where there is the time.
    for (time, told) in [(2 * MS, vec!["9 a dot"]), (20 * MS, vec!["1 a dot", "9 a dot"])] {
        let mut fixed = Refinement::new(Some(50 * MS), false);
        assert_eq!(all(&mut fixed, &with(3, None), time), ["1 a dot", "9 a dot"]);
        let moved = Request { camera: request(2.0).camera, ..with(3, None) };
        assert_eq!(all(&mut fixed, &moved, time), told);
    }
    // `--aa adaptive --error 0.5`.
    let mut adaptive = Refinement::new(Some(50 * MS), false);
    let wanted = with(1, Some(0.5));
    assert_eq!(draw(&mut adaptive, &wanted, MS).unwrap().1, "1 a dot");
    assert_eq!(draw(&mut adaptive, &wanted, MS).unwrap().0.request, wanted);
    // Without a limit it is drawn at once; `--fps 0`.
    for wanted in [with(3, None), with(1, Some(0.5))] {
        let mut at_once = Refinement::new(None, false);
        assert_eq!(draw(&mut at_once, &wanted, 900 * MS).unwrap().0.request, wanted);
        assert_eq!(at_once.next(&wanted), None);
    }
    assert_eq!(all(&mut Refinement::new(None, true), &request(1.0), 900 * MS), ["1 a dot", "adaptive"]);
}

#[test]
fn refinement_ends_at_once_and_motion_after_its_time() {
    let begin = Instant::now();
    let mut refinement = Refinement::new(Some(50 * MS), true);
    let [here, there] = [request(1.0), request(2.0)];
    draw(&mut refinement, &here, MS);
    assert_eq!(refinement.due(&there), None);
    refinement.begin(&there, Detail::OneRay, begin);
    refinement.finished(&blank(here.dots));
    assert_eq!((refinement.due(&there), refinement.due(&here)), (Some(begin + REST), None));
    refinement.begin(&here, Detail::OneRay, begin);
    refinement.finished(&blank(here.dots));
    let order = refinement.begin(&here, Detail::Full, begin + REST);
    // What refines it does not begin the time anew.
    assert_eq!(refinement.due(&here), Some(begin + REST));
    assert_eq!(order.patience, Duration::ZERO);
    assert!(refinement.is_outdated(Some(&there)) && !refinement.is_outdated(Some(&here)));
    refinement.given_up(begin + REST + MS);
    // That teaches nothing of the time; what is shown is what it was.
    assert_eq!(refinement.next(&there), Some(Detail::OneRay));
    assert_eq!(refinement.next(&here), Some(Detail::Full));
    let order = refinement.begin(&there, Detail::OneRay, begin);
    assert_eq!(order.patience, 100 * MS);
    refinement.given_up(begin + 100 * MS);
    assert_eq!(refinement.next(&there), Some(Detail::Coarse(2)));
    assert_eq!(Refinement::new(None, true).begin(&here, Detail::OneRay, begin).patience, Duration::MAX);
}

#[test]
fn what_was_taken_over_teaches_nothing() {
    let mut refinement = Refinement::new(Some(50 * MS), false);
    let blank = blank(Size::new(160, 96));
    refinement.begin(&request(1.0), Detail::OneRay, Instant::now());
    refinement.finished(&Frame { total: 900 * MS, ..blank });
    assert_eq!(refinement.next(&request(2.0)), Some(Detail::OneRay));
}
