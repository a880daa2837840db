//! What a view shows, in words: for who does not see it, and for scripts.

use crate::frame::{Inventory, NothingInView, SeenObject};
use crate::scene::{Camera, Scene};

use super::figure::{rounded, triple};
use super::names::object_name;

/// So many objects have a line: who wants all of thousands has them as JSON.
const MOST_LINES: usize = 100;

/// So many names stand in one line.
const MOST_NAMES: usize = 20;

/// Digits of a distance: more are of no use in words.
const DIGITS: usize = 3;

/// What a picture of `scene` from `camera` shows, a line for each object that is seen and one for each reason
/// why others are not.
pub fn described(inventory: &Inventory, camera: &Camera, scene: &Scene) -> String {
    let Inventory { seen, unseen, background } = inventory;
    let view = camera.name.as_ref().map_or_else(String::new, |name| format!("{name}: "));
    let mut text = format!(
        "{view}{} of {} objects in sight; {} of the picture is background\nthe eye at {} looks to {}\n",
        seen.len(),
        seen.len() + unseen.len(),
        percent(*background),
        triple(camera.eye),
        triple(camera.target)
    );
    if !seen.is_empty() {
        text.push('\n');
    }
    for object in seen.iter().take(MOST_LINES) {
        text += &format!("{}\n", line(object, scene));
    }
    if let Some(more) = seen.len().checked_sub(MOST_LINES).filter(|&more| more > 0) {
        text += &format!("and {more} smaller ones\n");
    }
    for why in [
        NothingInView::Unknown,
        NothingInView::TooSmall,
        NothingInView::Beside,
        NothingInView::Behind,
        NothingInView::TooFar,
        NothingInView::NoObjects,
    ] {
        let all: Vec<String> = unseen
            .iter()
            .filter(|unseen| unseen.why == why)
            .map(|unseen| object_name(scene, unseen.object))
            .collect();
        if !all.is_empty() {
            text += &format!("\n{}: {}\n", why_unseen(why), listed(&all));
        }
    }
    text
}

fn line(object: &SeenObject, scene: &Scene) -> String {
    let [across, down] = object.extent.map(percent);
    let [near, far] = object.distance.map(|t| rounded(t, DIGITS));
    let away = if near == far { near } else { format!("{near} to {far}") };
    let before: Vec<String> = object.before.iter().map(|&other| object_name(scene, other)).collect();
    let before = if before.is_empty() { String::new() } else { format!("; before {}", listed(&before)) };
    format!(
        "{}: {}, {} of the picture, {across} of its width, {down} of its height; {away} away{before}",
        object_name(scene, object.object),
        place(object.middle),
        percent(object.share)
    )
}

/// In which ninth of the picture.
fn place(middle: [f64; 2]) -> &'static str {
    const NINTHS: [[&str; 3]; 3] = [
        ["at the top left", "at the top", "at the top right"],
        ["at the left", "in the middle", "at the right"],
        ["at the bottom left", "at the bottom", "at the bottom right"],
    ];
    let [across, down] = middle.map(|share| ((3.0 * share) as usize).min(2));
    NINTHS[down][across]
}

fn percent(share: f64) -> String {
    match 100.0 * share {
        nothing if nothing <= 0.0 => "0 %".to_owned(),
        little if little < 1.0 => "under 1 %".to_owned(),
        nearly if nearly > 99.0 && nearly < 100.0 => "over 99 %".to_owned(),
        some => format!("{some:.0} %"),
    }
}

/// Names in a line, as many as one takes in.
fn listed(names: &[String]) -> String {
    match names.len().checked_sub(MOST_NAMES).filter(|&more| more > 0) {
        Some(more) => format!("{} and {more} more", names[..MOST_NAMES].join(", ")),
        None => names.join(", "),
    }
}

/// Why an object is not seen.
pub const fn why_unseen(why: NothingInView) -> &'static str {
    match why {
        NothingInView::Unknown => "met by no ray straight from the eye",
        NothingInView::TooSmall => "smaller than a dot",
        NothingInView::Beside => "beside the picture",
        NothingInView::Behind => "behind the eye",
        NothingInView::TooFar => "too far away",
        NothingInView::NoObjects => "without anything in it",
    }
}
