//! `v`: from where the scene is seen.

use crate::scene::diagnostic::Reported;
use crate::scene::{Camera, CameraError, FieldSpan};

use super::entity::Entity;
use super::ignored::Extra;

/// The words of a viewpoint, in the order that the format gives them; any other order is read too.
const WORDS: [&str; 7] = ["from", "at", "up", "angle", "hither", "yon", "resolution"];

/// The camera of a viewpoint. Its picture is square, and its angle is that between the outermost centres of
/// dots.
pub fn camera(entity: &mut Entity) -> Result<Camera, Reported> {
    let (mut from, mut at, mut up, mut angle) = (None, None, None, None);
    while let Some(word) = entity.tokens.peek().filter(|token| WORDS.contains(&token.word)) {
        entity.tokens.take();
        let point = |entity: &mut Entity| entity.vector(|| format!("`{}`", word.word));
        match word.word {
            "from" => from = Some(point(entity)?),
            "at" => at = Some(point(entity)?),
            "up" => up = Some(point(entity)?),
            "angle" => {
                let [number] = entity.numbers(["the angle"])?;
                let inside = number.value > 0.0 && number.value < 180.0;
                entity.check(number, inside, "the angle is between 0 and 180 degrees, both excluded")?;
                angle = Some(number.value);
            }
            "hither" => {
                entity.numbers(["the distance of `hither`"])?;
            }
            "yon" => {
                entity.numbers(["the distance of `yon`"])?;
                entity.ignored.add(Extra::FarPlane, word.span());
            }
            _ => {
                for number in entity.numbers(["the width of `resolution`", "the height of `resolution`"])? {
                    let whole = number.value >= 1.0 && number.value.fract() == 0.0;
                    entity.check(number, whole, "the resolution is two whole numbers above 0")?;
                }
            }
        }
    }
    let eye = given(entity, from, "`from`")?;
    let target = given(entity, at, "`at`")?;
    let up = given(entity, up, "`up`")?;
    let angle = given(entity, angle, "`angle`")?;
    let camera =
        Camera { name: None, eye, target, up, field: [angle; 2], span: FieldSpan::Centers, zoom: 1.0 };
    match camera.check() {
        Ok(()) => Ok(camera),
        Err(CameraError::NoSight) => Err(entity
            .wrong(entity.keyword, "`from` and `at` are the same point: there is no direction to look in")),
        Err(error) => Err(entity.wrong(entity.keyword, &error.to_string())),
    }
}

/// A part that a viewpoint can not be without.
fn given<T>(entity: &mut Entity, part: Option<T>, name: &str) -> Result<T, Reported> {
    match part {
        Some(part) => Ok(part),
        None if entity.tokens.peek().is_none() => Err(entity.cut_off(name)),
        None => Err(entity.wrong(entity.keyword, &format!("{name} is missing"))),
    }
}
