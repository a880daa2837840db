//! What a picture requires, as a table.

use serde_json::{Value, json};

use crate::frame::Wants;
use crate::plan::StagePlan;

use super::arguments::PlanArguments;
use super::error::CliError;
use super::{input, print};

/// Explains a picture without drawing it.
pub fn run(arguments: &PlanArguments) -> Result<(), CliError> {
    let scene = input::read(&arguments.scene.file, arguments.scene.skip_unsupported)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let request = arguments.picture.request(&studio, arguments.picture.palette(), Wants::CELLS)?;
    let stages = studio.explain(&request);
    let text = if arguments.json { format!("{}\n", value(&stages)) } else { table(&stages) };
    print(text.as_bytes())
}

fn value(stages: &[StagePlan]) -> Value {
    let stage = |s: &StagePlan| {
        let term = |t: &crate::plan::Term| json!({ "name": t.name, "needed": t.needed, "why": t.why });
        let terms: Vec<Value> = s.terms.iter().map(term).collect();
        let name = s.stage.name().to_lowercase();
        json!({
            "number": s.stage.number(), "stage": name, "needed": s.needed, "why": s.why, "terms": terms,
        })
    };
    json!({ "stages": stages.iter().map(stage).collect::<Vec<_>>() })
}

/// A line per stage, and below it one for each of its terms.
fn table(stages: &[StagePlan]) -> String {
    let mut rows = vec![("stage".to_owned(), "plan", "why")];
    let verdict = |needed| if needed { "needed" } else { "left out" };
    for s in stages {
        rows.push((format!("{:2} {}", s.stage.number(), s.stage.name()), verdict(s.needed), &s.why));
        rows.extend(s.terms.iter().map(|t| (format!("   - {}", t.name), verdict(t.needed), t.why.as_str())));
    }
    let widest = rows.iter().map(|(name, ..)| name.chars().count()).max().unwrap_or(0);
    rows.iter().map(|(name, plan, why)| format!("{name:widest$}  {plan:8}  {why}\n")).collect()
}
