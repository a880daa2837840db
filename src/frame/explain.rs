//! What a picture requires, stage by stage, before it is drawn.

use crate::glyph::Palette;
use crate::plan::{Cost, StagePlan, Term};
use crate::stage::{GiveUp, Stage};
use crate::tone::Tone;

use super::prepare::Prepared;
use super::{Request, Space, Studio};

impl Studio {
    /// All eleven stages of the picture that [`Studio::draw`] draws of the same request: which it needs,
    /// which it leaves out, why, and what each is expected to cost on this machine: some tiles are traced to
    /// see that. Builds the structure, where it was not built before; what that took is what LATTICE costs.
    pub fn explain(&self, request: &Request) -> Vec<StagePlan> {
        let never = GiveUp::never();
        let prepared = self.prepare(request, None, &never);
        let Prepared { plan, pinhole, structure, over_budget, .. } = &prepared;
        let mut stages = plan.explain(self.scene(), &self.assembly, pinhole, request.dots);
        let sample = prepared.sample(request);
        let costs = plan.costs(&sample, request.dots);
        for stage in &mut stages {
            stage.cost = costs(stage.stage).filter(|_| stage.needed);
        }
        let built = match Space::of(structure) {
            Space::Whole => None,
            Space::Lattice([x, y, z]) => Some(format!("{x} × {y} × {z} cells")),
            Space::Tree(1) | Space::Boxes(1) => Some("1 node".to_owned()),
            Space::Tree(nodes) | Space::Boxes(nodes) => Some(format!("{nodes} nodes")),
        };
        let objects = self.assembly.objects.len() as f64;
        for stage in stages.iter_mut().filter(|s| s.stage == Stage::Lattice) {
            if stage.needed && objects > 0.0 {
                let each = self.built().cutting.as_secs_f64() * 1e9 / objects;
                stage.cost = Some(Cost { count: objects, of: "object", each, shared: false });
            }
            if let Some(over) = over_budget {
                stage.why += &format!("; {over} → tree");
            }
            if let Some(built) = &built {
                stage.why += &format!(": {built}");
                let all = 0..self.assembly.objects.len() as u32;
                stage.terms.push(sub_lattices(
                    all.filter(|&o| structure.sub(o).is_some() || structure.cells(o).is_some()).count(),
                ));
            }
        }
        stages.push(StagePlan { cost: costs(Stage::Dither), ..levels(request) });
        stages.push(characters(request));
        stages
    }
}

fn sub_lattices(n: usize) -> Term {
    let why = match n {
        0 => "no object can be cut into cells of its own".to_owned(),
        1 => "1 object of several primitives is cut into cells of its own".to_owned(),
        n => format!("{n} objects of several primitives are each cut into cells of their own"),
    };
    Term { name: "sub-lattices", needed: n > 0, why }
}

fn levels(request: &Request) -> StagePlan {
    let needed = request.needs_levels();
    let why = match (needed, request.tone) {
        (false, _) => "any colour can be shown → no levels",
        (true, Tone::Lightness) => "light becomes the nearest of 13 levels in lightness",
        (true, Tone::Even) => "light becomes the nearest of 13 levels in even steps of 1/12",
    };
    StagePlan { stage: Stage::Dither, needed, why: why.into(), cost: None, terms: Vec::new() }
}

fn characters(request: &Request) -> StagePlan {
    let (per_cell, cells) = (request.glyphs.dots_per_cell(), request.cells());
    let colors = match request.palette {
        Palette::Dos(_) => "four grays",
        Palette::Gray(_) => "13 grays",
        Palette::Mono(_) => "the terminal's ink",
        Palette::Color(_) => "any colour",
    };
    let glyphs = request.glyphs.name();
    let needed = request.wants.cells;
    if !needed {
        let why = "no characters are wanted".to_owned();
        return StagePlan { stage: Stage::Display, needed, why, cost: None, terms: Vec::new() };
    }
    let why = format!(
        "{glyphs} in {colors}, {} × {} dots to a cell → {} × {} cells",
        per_cell.width, per_cell.height, cells.width, cells.height
    );
    StagePlan { stage: Stage::Display, needed, why, cost: None, terms: Vec::new() }
}
