//! What a view shows, in words: for who does not see it, and for scripts.

use serde_json::{Value, json};

use crate::frame::{Inventory, Request, SeenObject};
use crate::scene::Scene;
use crate::tell::{described, why_unseen};

use super::arguments::DescribeArguments;
use super::error::{CliError, visible};
use super::opened::opened;
use super::write::print;

/// Describes a view.
pub fn run(arguments: &DescribeArguments) -> Result<(), CliError> {
    let (studio, request) = opened(&arguments.scene, &arguments.picture)?;
    let inventory = studio.inventory(&request);
    let text = if arguments.json {
        format!("{}\n", value(&inventory, &request, studio.scene()))
    } else {
        visible(&described(&inventory, &request.camera, studio.scene()))
    };
    print(text.as_bytes())
}

fn value(inventory: &Inventory, request: &Request, scene: &Scene) -> Value {
    let name = |object: u32| scene.objects.get(object as usize).and_then(|object| object.name.as_deref());
    let objects = |numbers: &[u32]| numbers.iter().map(|number| number + 1).collect::<Vec<_>>();
    let seen = |object: &SeenObject| {
        json!({
            "object": object.object + 1, "name": name(object.object), "share": object.share,
            "middle": object.middle, "extent": object.extent, "distance": object.distance,
            "before": objects(&object.before),
        })
    };
    json!({
        "view": request.camera.name, "dots": [request.dots.width, request.dots.height],
        "eye": request.camera.eye.to_array(), "target": request.camera.target.to_array(),
        "background": inventory.background,
        "seen": inventory.seen.iter().map(seen).collect::<Vec<_>>(),
        "unseen": inventory.unseen.iter().map(|unseen| json!({
            "object": unseen.object + 1, "name": name(unseen.object), "why": why_unseen(unseen.why),
        })).collect::<Vec<_>>(),
    })
}
