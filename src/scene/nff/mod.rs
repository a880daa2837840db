//! NFF, Eric Haines's Neutral File Format: spheres, open cones and cylinders, polygons and patches.
//!
//! Text → words ([`tokens`]) → entities ([`entity`]) → scene: [`view`], [`light`] and [`solids`] take what each
//! entity says. Words count, not lines: a polygon may go on over as many as it likes. `docs/nff.md` describes it for
//! people.

mod entity;
mod light;
mod polygon;
mod solids;
#[cfg(test)]
mod tests;
mod tokens;
mod view;

use super::diagnostic::{Reported, Sink};
use super::{Diagnostic, Diagnostics, Scene};

use entity::{ENTITIES, Entity, begins_an_entity};
use light::{Fills, Lamps};
use solids::Solids;
use tokens::{Token, Tokens};

/// Reads a scene.
pub(super) fn read(name: &str, text: &str) -> Result<Scene, Diagnostics> {
    let mut reader = Reader::default();
    let mut tokens = Tokens::new(text);
    while let Some(keyword) = tokens.take() {
        if reader.sink.is_full() {
            break;
        }
        if reader.entity(keyword, &mut tokens).is_err() {
            // What follows up to the next entity belongs to the one that is wrong.
            while tokens.peek().is_some_and(|token| !begins_an_entity(token)) {
                tokens.take();
            }
        }
    }
    reader.finish(name, text)
}

/// What was read so far.
#[derive(Default)]
struct Reader {
    scene: Scene,
    lamps: Lamps,
    fills: Fills,
    solids: Solids,
    sink: Sink,
}

impl Reader {
    fn entity<'a>(&mut self, keyword: Token<'a>, tokens: &mut Tokens<'a>) -> Result<(), Reported> {
        let mut entity = Entity { keyword, tokens, sink: &mut self.sink };
        match keyword.word {
            "v" => self.scene.views.push(view::camera(&mut entity)?),
            "b" => self.scene.world.background = entity.color()?,
            "l" => self.lamps.read(&mut entity)?,
            "f" => self.fills.read(&mut entity)?,
            "s" => self.solids.sphere(&mut entity, &mut self.fills)?,
            "c" => self.solids.tube(&mut entity, &mut self.fills)?,
            "p" => self.solids.face(&mut entity, &mut self.fills)?,
            "pp" => self.solids.patch(&mut entity, &mut self.fills)?,
            _ => return Err(self.no_entity(keyword)),
        }
        Ok(())
    }

    fn no_entity(&mut self, token: Token) -> Reported {
        let message = if token.begins_a_number() {
            "a number stands where an entity begins"
        } else {
            "NFF has no such entity"
        };
        let known: Vec<String> = ENTITIES.iter().map(|(word, what)| format!("`{word}` ({what})")).collect();
        let error = Diagnostic::error(token.span(), message).label(format!("this is `{}`", token.shown()));
        self.sink.report(error.help(format!("its entities are {}", known.join(", "))))
    }

    fn finish(mut self, name: &str, text: &str) -> Result<Scene, Diagnostics> {
        let mut scene = self.scene;
        scene.objects = self.solids.finish(&mut self.sink);
        scene.materials = self.fills.finish(&mut self.sink);
        self.lamps.finish(&mut scene);
        if scene.objects.is_empty() && self.sink.is_clean() {
            let error = Diagnostic::error(0..0, "the scene is empty: there is nothing to see in it");
            self.sink.report(
                error.help("a file of NFF shows spheres `s`, cones `c`, polygons `p` and patches `pp`"),
            );
        }
        scene.notes = self.sink.finish(name, text)?;
        Ok(scene)
    }
}
