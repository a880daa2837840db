//! One ray through the stages, as text or as JSON.

use serde_json::{Value, json};

use crate::frame::{FollowedRay, Request};
use crate::math::Size;
use crate::shade::Channel;
use crate::tell::{Story, StoryLine};

use super::arguments::FollowArguments;
use super::error::{CliError, visible};
use super::opened::opened;
use super::write::print;

/// Follows the ray of a dot.
pub fn run(arguments: &FollowArguments) -> Result<(), CliError> {
    let (studio, request) = opened(&arguments.scene, &arguments.picture)?;
    let FollowArguments { column, row, .. } = *arguments;
    let Some(followed) = studio.follow(&request, [column, row]) else {
        let Size { width, height } = request.dots;
        return Err(CliError::Input(format!(
            "there is no dot {column}, {row}: the picture has {width} × {height}, the last is {}, {}",
            width - 1,
            height - 1
        )));
    };
    let frame = studio.draw(&request);
    let story = Story::new(&followed, &request, studio.scene(), Some(&frame));
    let text = if arguments.json {
        format!("{}\n", value(&followed, &request, &story))
    } else {
        let Size { width, height } = request.dots;
        visible(&format!("dot {column}, {row} of {width} × {height}, by the exact engine\n\n{story}"))
    };
    print(text.as_bytes())
}

fn value(followed: &FollowedRay, request: &Request, story: &Story) -> Value {
    let line = |line: &StoryLine| {
        json!({
            "number": line.stage.number(), "stage": line.stage.name().to_lowercase(), "depth": line.depth,
            "text": line.text,
        })
    };
    json!({
        "dot": followed.dot, "dots": [request.dots.width, request.dots.height],
        "ray": { "origin": followed.ray.o.to_array(), "direction": followed.ray.d.to_array() },
        "light": followed.light.gray(), "left_out": followed.left_out,
        "steps": story.lines.iter().map(line).collect::<Vec<_>>(),
    })
}
