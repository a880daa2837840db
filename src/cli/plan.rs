//! What a picture requires, as a table: what each stage is expected to cost and, where the picture is drawn,
//! what it did.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::frame::{Frame, Studio, Wants};
use crate::plan::{EngineChoice, StagePlan, Term};
use crate::stage::Stage;

use super::arguments::PlanArguments;
use super::error::CliError;
use super::picture::Unsized;
use super::stats::ms;
use super::write::print;
use super::{effects, input};

/// Explains a picture; draws it only where that is asked for.
pub fn run(arguments: &PlanArguments) -> Result<(), CliError> {
    input::say(&effects::check(&arguments.picture, effects::Presentation::Cells)?);
    let reading = Instant::now();
    let scene = input::read(&arguments.scene.file, &arguments.scene.reading)?;
    input::say(&scene.notes);
    let studio = input::studio(scene)?;
    let read = reading.elapsed();
    let request =
        arguments.picture.request(&studio, arguments.picture.look(None), Wants::CELLS, Unsized::Screen)?;
    let stages = studio.explain(&request);
    let threads = match request.options.threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        some => some,
    };
    let ran = arguments.run.then(|| Ran::new(&studio, studio.draw_anew(&request), read));
    let plan = Printed { stages, threads, ran };
    let text = if arguments.json { format!("{}\n", plan.value()) } else { plan.table() };
    print(text.as_bytes())
}

/// A picture that was drawn.
struct Ran {
    frame: Frame,
    /// OBJECTS and LATTICE, which are done before any picture.
    before: [Duration; 2],
}

impl Ran {
    fn new(studio: &Studio, frame: Frame, read: Duration) -> Self {
        Self { frame, before: [read, studio.built().cutting] }
    }

    fn time(&self, stage: Stage) -> Duration {
        match stage {
            Stage::Objects => self.before[0],
            Stage::Lattice => self.before[1],
            _ => self.frame.times[stage],
        }
    }

    /// What a stage counted.
    fn stage(&self, stage: Stage) -> Option<(u64, &'static str)> {
        let counts = &self.frame.counts;
        match stage {
            Stage::Objects | Stage::Lattice => Some((self.frame.objects as u64, "object")),
            Stage::Ray => Some((counts.primary_rays, "ray")),
            Stage::Clip => Some((counts.clipped_rays, "ray")),
            // Rays side by side take their steps together.
            Stage::Cell if self.frame.engine == EngineChoice::Fast => Some((counts.rays(), "ray")),
            Stage::Cell => Some((counts.cells_visited, "step")),
            Stage::Solid => Some((counts.primitive_tests, "test")),
            Stage::Csg => Some((counts.csg_evaluations, "expression")),
            Stage::Shade => Some((counts.primary_hits + counts.secondary_hits, "surface")),
            Stage::Dither => Some((self.frame.light.size().area() as u64, "dot")),
            Stage::View | Stage::Display => None,
        }
    }

    fn term(&self, term: &Term) -> Option<(u64, &'static str)> {
        match term.name {
            "shadow rays" => Some((self.frame.counts.shadow_rays, "ray")),
            "secondary rays" => Some((self.frame.counts.secondary_rays, "ray")),
            _ => None,
        }
    }
}

/// A plan, as it is printed.
struct Printed {
    stages: Vec<StagePlan>,
    threads: usize,
    ran: Option<Ran>,
}

impl Printed {
    fn expected(&self, stage: &StagePlan) -> Option<f64> {
        stage.cost.map(|cost| (cost.ms(self.threads) * 1e3).round() / 1e3)
    }

    /// Of the stages that every picture goes through; LATTICE is done once, before the first.
    fn expected_frame(&self) -> f64 {
        self.stages.iter().filter(|s| s.stage != Stage::Lattice).filter_map(|s| self.expected(s)).sum()
    }

    fn expected_total(&self) -> f64 {
        self.stages.iter().filter_map(|stage| self.expected(stage)).sum()
    }

    fn value(&self) -> Value {
        let term = |t: &Term| {
            let mut value = json!({ "name": t.name, "needed": t.needed, "why": t.why });
            if let Some((count, _)) = self.ran.as_ref().and_then(|ran| ran.term(t)) {
                value["count"] = json!(count);
            }
            value
        };
        let stage = |s: &StagePlan| {
            let mut value = json!({
                "number": s.stage.number(), "stage": s.stage.name().to_lowercase(), "needed": s.needed,
                "why": s.why, "terms": s.terms.iter().map(term).collect::<Vec<_>>(),
                "expected_ms": self.expected(s), "expected_count": s.cost.map(|cost| cost.count.round()),
                "expected_of": s.cost.map(|cost| cost.of),
            });
            if let Some(ran) = &self.ran {
                value["ms"] = json!(ms(ran.time(s.stage)));
                value["count"] = json!(ran.stage(s.stage).map(|(count, _)| count));
            }
            value
        };
        let mut all = json!({
            "stages": self.stages.iter().map(stage).collect::<Vec<_>>(),
            "threads": self.threads, "expected_ms": self.expected_total(),
            "expected_frame_ms": self.expected_frame(),
        });
        if let Some(ran) = &self.ran {
            all["ms"] = json!(ms(ran.before.iter().sum::<Duration>() + ran.frame.total));
            all["frame_ms"] = json!(ms(ran.frame.total));
            all["engine"] = json!(ran.frame.engine.name());
            all["precision"] = json!(ran.frame.precision.name());
        }
        all
    }

    /// A line per stage, and below it one for each of its terms.
    fn table(&self) -> String {
        let ran = |words: fn(&Ran) -> String| self.ran.as_ref().map(words);
        let mut rows = vec![Row {
            name: "stage".into(),
            plan: "plan",
            expected: "expected".into(),
            foreseen: String::new(),
            measured: ran(|_| "measured".into()),
            counted: ran(|_| "counted".into()),
            why: "why",
        }];
        let counted = |count: Option<(u64, &str)>| {
            let words = count.filter(|(n, _)| *n > 0).map(|(n, of)| format!("{n} {of}{}", plural(n)));
            words.unwrap_or_default()
        };
        for s in &self.stages {
            rows.push(Row {
                name: format!("{:2} {}", s.stage.number(), s.stage.name()),
                plan: verdict(s.needed),
                expected: self.expected(s).map_or_else(String::new, time),
                foreseen: counted(s.cost.map(|cost| (cost.count.round() as u64, cost.of))),
                measured: self.ran.as_ref().map(|ran| match ran.time(s.stage) {
                    Duration::ZERO => String::new(),
                    took => time(ms(took)),
                }),
                counted: self.ran.as_ref().map(|ran| counted(ran.stage(s.stage))),
                why: &s.why,
            });
            rows.extend(s.terms.iter().map(|t| Row {
                name: format!("   - {}", t.name),
                plan: verdict(t.needed),
                expected: String::new(),
                foreseen: String::new(),
                measured: self.ran.as_ref().map(|_| String::new()),
                counted: self.ran.as_ref().map(|ran| counted(ran.term(t))),
                why: &t.why,
            }));
        }
        let sum = |name: &str, expected: f64, measured: fn(&Ran) -> Duration| Row {
            name: name.into(),
            plan: "",
            expected: time(expected),
            foreseen: String::new(),
            measured: self.ran.as_ref().map(|ran| time(ms(measured(ran)))),
            counted: ran(|_| String::new()),
            why: "",
        };
        rows.push(sum("each picture", self.expected_frame(), |ran| ran.frame.total));
        rows.push(sum("with what is done once", self.expected_total(), |ran| {
            ran.before.iter().sum::<Duration>() + ran.frame.total
        }));
        let wide = |of: fn(&Row) -> usize| rows.iter().map(of).max().unwrap_or(0);
        let name = wide(|row| row.name.chars().count());
        let expected = wide(|row| row.expected.chars().count());
        let foreseen = wide(|row| row.foreseen.chars().count());
        let measured = wide(|row| row.measured.as_ref().map_or(0, |m| m.chars().count()));
        let count = wide(|row| row.counted.as_ref().map_or(0, |c| c.chars().count()));
        let line = |row: &Row| {
            let Row { expected: ms, foreseen: of, .. } = row;
            let mut line = format!("{:name$}  {:8}  {ms:>expected$}  {of:<foreseen$}", row.name, row.plan);
            if let (Some(m), Some(c)) = (&row.measured, &row.counted) {
                line += &format!("  {m:>measured$}  {c:<count$}");
            }
            line += &format!("  {}", row.why);
            format!("{}\n", line.trim_end())
        };
        rows.iter().map(line).collect()
    }
}

/// A line of the table.
struct Row<'a> {
    name: String,
    plan: &'a str,
    expected: String,
    /// How much of what that is for.
    foreseen: String,
    measured: Option<String>,
    counted: Option<String>,
    why: &'a str,
}

const fn verdict(needed: bool) -> &'static str {
    if needed { "needed" } else { "left out" }
}

const fn plural(n: u64) -> &'static str {
    if n == 1 { "" } else { "s" }
}

/// Milliseconds, as far as they can be foreseen.
fn time(ms: f64) -> String {
    if ms < 10.0 { format!("{ms:.2} ms") } else { format!("{ms:.0} ms") }
}
