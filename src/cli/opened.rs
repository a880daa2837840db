//! A scene that is opened for one picture of which characters are not written.

use crate::frame::{Request, Studio, Wants};

use super::arguments::{PictureArguments, SceneArguments};
use super::error::CliError;
use super::picture::Unsized;
use super::{effects, input};

/// Reads a scene, makes it ready, and says on the way what is noted of it; with the picture that is meant.
pub fn opened(scene: &SceneArguments, picture: &PictureArguments) -> Result<(Studio, Request), CliError> {
    input::say(&effects::check(picture, effects::Presentation::Cells)?);
    let scene = input::read(&scene.file, &scene.reading)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let request = picture.request(&studio, picture.look(None), Wants::CELLS, Unsized::Screen)?;
    Ok((studio, request))
}
