//! The figures of a picture, for people and for programs.

use std::time::Duration;

use serde_json::{Map, Value, json};

use crate::frame::{Built, Frame, Space};
use crate::stage::Stage;

use super::error::tell;
use super::formats::StatsFormat;

/// Says the figures on standard error, and why there is nothing in view where there is nothing.
pub fn say(frame: &Frame, built: &Built, form: StatsFormat) {
    let mut figures = figures(frame, built);
    // A program finds the key whether there is something in view or not; a person reads what there is to say.
    if frame.nothing.is_some() || form == StatsFormat::Json {
        figures.insert("nothing_in_view".to_owned(), json!(frame.nothing.map(|why| why.to_string())));
    }
    match form {
        StatsFormat::Json => tell(&Value::Object(figures).to_string()),
        StatsFormat::Text => tell(lines(&figures).trim_end()),
    }
}

/// All figures by name.
pub fn figures(frame: &Frame, built: &Built) -> Map<String, Value> {
    let counts = &frame.counts;
    let stages: Map<String, Value> = Stage::ALL
        .into_iter()
        .map(|stage| (stage.name().to_lowercase(), json!(ms(frame.times[stage]))))
        .collect();
    let mut all = Map::new();
    let mut put = |key: &str, value: Value| {
        all.insert(key.to_owned(), value);
    };
    put("primary_rays", json!(counts.primary_rays));
    put("primary_hits", json!(counts.primary_hits));
    put("shadow_rays", json!(counts.shadow_rays));
    put("shadow_hits", json!(counts.shadow_hits));
    put("secondary_rays", json!(counts.secondary_rays));
    put("secondary_hits", json!(counts.secondary_hits));
    put("clipped_rays", json!(counts.clipped_rays));
    put("cells_visited", json!(counts.cells_visited));
    put("primitive_tests", json!(counts.primitive_tests));
    put("csg_evaluations", json!(counts.csg_evaluations));
    put("truncated_rays", json!(counts.truncated_rays));
    put("build_ms", json!(ms(built.assembling + built.cutting)));
    put("trace_ms", json!(ms(frame.trace)));
    put("total_ms", json!(ms(frame.total)));
    put("stage_ms", Value::Object(stages));
    put("threads", json!(frame.threads));
    put("engine", json!(frame.engine.name()));
    put("precision", json!(frame.precision.name()));
    put("structure", json!(frame.space.name()));
    match frame.space {
        Space::Whole => {}
        Space::Lattice(cells) => put("lattice_cells", json!(cells)),
        Space::Tree(nodes) => put("tree_nodes", json!(nodes)),
        Space::Boxes(nodes) => put("box_nodes", json!(nodes)),
    }
    put("objects", json!(frame.objects));
    put("primitives", json!(frame.primitives));
    all
}

/// A line per figure, those of the stages behind their names.
pub fn lines(figures: &Map<String, Value>) -> String {
    let mut text = String::new();
    for (key, value) in figures {
        match value {
            Value::Object(inner) => {
                for (stage, time) in inner {
                    text.push_str(&format!("{:<24}{time}\n", format!("{key} {stage}")));
                }
            }
            Value::String(word) => text.push_str(&format!("{key:<24}{word}\n")),
            other => text.push_str(&format!("{key:<24}{other}\n")),
        }
    }
    text
}

/// Milliseconds to the microsecond: clocks are not better.
pub fn ms(time: Duration) -> f64 {
    (time.as_secs_f64() * 1e6).round() / 1e3
}
