//! Entities as sides, each a straight line from place to place.

use std::collections::{BTreeMap, HashMap};

use super::entity::DxfEntity;
use crate::math::DVec2;
use crate::scene::degrees;
use crate::scene::drawing::{DrawingFault, DrawingRequest};
use crate::scene::profile::MOST_CORNERS;

/// A straight line.
pub type Side = [DVec2; 2];

/// The width of a cell of OpenSCAD's grid, in the units that a drawing is scaled to.
pub const CELL: f64 = 1.0 / 1024.0;

/// How often something was met, by its name.
type Counts = BTreeMap<String, usize>;

/// The part of a file that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// What is drawn.
    Entities,
    /// What may be drawn, by way of an INSERT.
    Blocks,
    /// What is of no account.
    Other,
}

/// The sides of a file, as they are read.
pub struct Sides<'r> {
    request: &'r DrawingRequest,
    /// Where the entities stand that come.
    pub section: Section,
    /// The name of the block that is open.
    block: Option<String>,
    blocks: HashMap<String, Vec<Side>>,
    /// The sides that show.
    pub drawn: Vec<Side>,
    /// Sides in blocks and elsewhere, so that blocks of blocks of blocks come to an end.
    count: usize,
    unread: Counts,
    bulges: usize,
    unknown_blocks: Counts,
}

impl<'r> Sides<'r> {
    /// None yet.
    pub fn new(request: &'r DrawingRequest) -> Self {
        Self {
            request,
            section: Section::Other,
            block: None,
            blocks: HashMap::new(),
            drawn: Vec::new(),
            count: 0,
            unread: Counts::new(),
            bulges: 0,
            unknown_blocks: Counts::new(),
        }
    }

    /// Takes an entity that is whole.
    pub fn take(&mut self, entity: &DxfEntity) -> Result<(), DrawingFault> {
        match (entity.name.as_str(), self.section) {
            ("SECTION", _) => {
                self.section = match entity.of.as_str() {
                    "ENTITIES" => Section::Entities,
                    "BLOCKS" => Section::Blocks,
                    _ => Section::Other,
                };
            }
            ("BLOCK", _) => {
                self.blocks.entry(entity.of.clone()).or_default();
                self.block = Some(entity.of.clone());
            }
            ("ENDBLK", _) => self.block = None,
            // What describes the drawing is no part of it.
            ("ENDSEC" | "DIMENSION", _) | (_, Section::Other) => {}
            (_, Section::Entities) if !self.is_wanted(entity) => {}
            _ if entity.is_drawn() => self.draw(entity)?,
            (name, _) => *self.unread.entry(name.to_owned()).or_default() += 1,
        }
        Ok(())
    }

    fn is_wanted(&self, entity: &DxfEntity) -> bool {
        let wanted = &self.request.layer;
        wanted.is_empty() || *wanted == entity.layer
    }

    fn draw(&mut self, entity: &DxfEntity) -> Result<(), DrawingFault> {
        self.bulges += usize::from(entity.has_bulge);
        match entity.name.as_str() {
            "LINE" => {
                let places = entity.places(2)?;
                self.give(entity, [places[0], places[1]])
            }
            "LWPOLYLINE" => {
                let places = entity.places(1)?;
                for pair in places.windows(2) {
                    self.give(entity, [pair[0], pair[1]])?;
                }
                let is_closed = entity.flags & 1 != 0;
                if is_closed { self.give(entity, [places[places.len() - 1], places[0]]) } else { Ok(()) }
            }
            "INSERT" => self.insert(entity),
            _ => self.curve(entity),
        }
    }

    /// An arc or an ellipse, with as many sides as its share of a whole turn has.
    fn curve(&mut self, entity: &DxfEntity) -> Result<(), DrawingFault> {
        let centre = entity.places(1)?[0];
        let fragments = &self.request.fragments;
        let of_turn = fragments.of_circle(entity.radius);
        if entity.name == "ELLIPSE" {
            const TURN: f64 = std::f64::consts::TAU;
            let axis = entity.places(2)?[1];
            let large = axis.length();
            let along = if large > 0.0 { axis / large } else { DVec2::X };
            let [start, sweep] = swept(entity.pair.to_array(), TURN);
            let count = (fragments.of_circle(large) * sweep / TURN).ceil();
            return self.chain(entity, count, |share| {
                let angle = start + sweep * share;
                let (x, y) = (libm::cos(angle) * large, libm::sin(angle) * large * entity.radius);
                centre + along * x + along.perp() * y
            });
        }
        let ends = if entity.name == "ARC" { entity.angles } else { [0.0, 360.0] };
        let [start, sweep] = swept(ends, 360.0);
        self.chain(entity, (of_turn * sweep / 360.0).ceil(), |share| {
            let angle = start + sweep * share;
            centre + DVec2::new(degrees::cos(angle), degrees::sin(angle)) * entity.radius
        })
    }

    /// Sides between the places at so many equal shares of a way, and at its start.
    fn chain(
        &mut self,
        entity: &DxfEntity,
        count: f64,
        place: impl Fn(f64) -> DVec2,
    ) -> Result<(), DrawingFault> {
        if self.count as f64 + count > MOST_CORNERS {
            return Err(too_many(entity));
        }
        for side in 0..count as usize {
            let ends = [side, side + 1].map(|end| place(end as f64 / count));
            self.give(entity, ends)?;
        }
        Ok(())
    }

    /// The sides of a block that is complete, turned, scaled and moved. One that inserts itself is none.
    fn insert(&mut self, entity: &DxfEntity) -> Result<(), DrawingFault> {
        let at = entity.places(1)?[0];
        let Some(block) = self.blocks.get(&entity.of) else {
            *self.unknown_blocks.entry(entity.of.clone()).or_default() += 1;
            return Ok(());
        };
        if self.count + block.len() > MOST_CORNERS as usize {
            return Err(too_many(entity));
        }
        let along = DVec2::new(degrees::cos(entity.angles[0]), degrees::sin(entity.angles[0]));
        // Within a block, too: that is scaled anew where it is inserted, as OpenSCAD has it.
        let place = |p: DVec2| (along.rotate(p * entity.pair)) * self.request.scale + at;
        let sides: Vec<Side> = block.iter().map(|side| side.map(place)).collect();
        sides.into_iter().try_for_each(|side| self.give(entity, side))
    }

    fn give(&mut self, entity: &DxfEntity, side: Side) -> Result<(), DrawingFault> {
        if !side.iter().all(|end| end.is_finite()) {
            return Err(entity.too_far());
        }
        self.count += 1;
        if self.count > MOST_CORNERS as usize {
            return Err(too_many(entity));
        }
        match (self.section, &self.block) {
            (Section::Entities, _) => self.drawn.push(side),
            (Section::Blocks, Some(block)) => {
                // As it is read, and again where it is inserted.
                let place = |p: DVec2| if self.request.is_on_grid { (p / CELL).round() * CELL } else { p };
                self.blocks.entry(block.clone()).or_default().push(side.map(place));
            }
            _ => {}
        }
        Ok(())
    }

    /// What was left out, or is not as it looks.
    pub fn notes(&self) -> Vec<String> {
        let list = |counts: &Counts| {
            let names = counts.iter().map(|(name, count)| match count {
                1 => name.clone(),
                _ => format!("{name} ({count})"),
            });
            // A file may have any number of names of its own.
            let mut names: Vec<String> = names.take(10).collect();
            if counts.len() > names.len() {
                names.push(format!("{} others", counts.len() - names.len()));
            }
            names.join(", ")
        };
        let mut notes = Vec::new();
        if !self.unread.is_empty() {
            notes.push(format!("what OpenSCAD does not read is left out: {}", list(&self.unread)));
        }
        if self.bulges > 0 {
            notes.push("arcs (bulges) of LWPOLYLINE are straight, as in OpenSCAD".to_owned());
        }
        if !self.unknown_blocks.is_empty() {
            notes.push(format!("a block that is inserted is not there: {}", list(&self.unknown_blocks)));
        }
        notes
    }
}

/// Where a curve starts, and how far it goes on from there to its other end, forwards, in a turn of this.
fn swept([start, stop]: [f64; 2], turn: f64) -> [f64; 2] {
    let sweep = stop - start;
    let turns = if sweep < 0.0 { (-sweep / turn).ceil() } else { 0.0 };
    [start, sweep + turns * turn]
}

fn too_many(entity: &DxfEntity) -> DrawingFault {
    let message = format!("with this {} the drawing has more than {MOST_CORNERS:e} sides", entity.name);
    DrawingFault::at(entity.line, message)
}
