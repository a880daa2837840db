//! NFF, Eric Haines's Neutral File Format: spheres, open cones and cylinders, polygons and patches.
//!
//! Text → words ([`tokens`]) → entities ([`entity`]) → scene: [`view`], [`light`] and [`solids`] take what
//! each entity says. Words count, not lines: a polygon may go on over as many as it likes. Stretches of a
//! large text are read by all threads. `docs/nff.md` describes the format for people.

mod entity;
mod ignored;
mod light;
mod room;
mod solids;
#[cfg(test)]
mod tests;
mod tokens;
mod view;

use std::ops::Range;

use rayon::prelude::*;

use crate::math::DVec3;
use crate::stage::Task;

use super::diagnostic::{Reported, Sink};
use super::{Camera, Diagnostic, Diagnostics, ReadOptions, Scene};

use entity::{ENTITIES, Entity, OTHER_SHAPES, begins_an_entity};
use ignored::{Extra, Ignored};
use light::{Fills, Lamps};
use solids::Solids;
use tokens::{NffToken, Tokens};

/// Reads a scene.
pub(super) fn read(name: &str, text: &str, options: &ReadOptions) -> Result<Scene, Diagnostics> {
    if let Some(limit) = options.memory {
        room::check(text, limit).map_err(|error| Diagnostics::whole(name, error))?;
    }
    let whole = || match sense8_keyword(text) {
        Some(keyword) => Reader::of_another_format(keyword),
        None => Reader::of(text, 0..text.len(), options),
    };
    let reader = in_stretches(text, STRETCH, options).unwrap_or_else(whole);
    reader.finish(name, text)
}

/// The word `nff`, with which a file of Sense8's `WorldToolKit` begins, whose format has the same name.
/// Comments there begin with `//`.
fn sense8_keyword(text: &str) -> Option<NffToken<'_>> {
    let mut tokens = Tokens::new(text, 0..text.len());
    loop {
        let token = tokens.take()?;
        if !token.word.starts_with("//") {
            return token.word.eq_ignore_ascii_case("nff").then_some(token);
        }
        while tokens.peek_on_line(token.start).is_some() {
            tokens.take();
        }
    }
}

/// Bytes that one thread reads at a time: 20 000 spheres, a few milliseconds.
const STRETCH: usize = 1 << 20;

/// Reads stretches of about so many bytes by all threads. `None` for a text of one stretch, or with errors.
///
/// Each stretch begins with a line that begins an entity. A text without errors means the same when it is
/// read so: no entity that is right has a word among its numbers, so none goes on behind the beginning of
/// another. Where there are errors, one thread has to find them in the order of the text.
fn in_stretches(text: &str, bytes: usize, options: &ReadOptions) -> Option<Reader> {
    let stretches = stretches(text, bytes);
    if stretches.len() == 1 {
        return None;
    }
    let progress = options.progress.as_ref();
    if let Some(progress) = progress {
        progress.begin(Task::Reading, text.len() as u64);
    }
    let read = stretches.into_par_iter().map(|stretch| {
        let length = stretch.len();
        let reader = Reader::of(text, stretch, options);
        if let Some(progress) = progress {
            progress.advance(length as u64);
        }
        reader.sink.is_clean().then_some(reader)
    });
    let readers: Vec<Reader> = read.collect::<Option<_>>()?;
    let mut whole = Reader::default();
    whole.solids.reserve(readers.iter().map(|reader| reader.solids.len()).sum());
    for reader in readers {
        whole.append(reader);
    }
    Some(whole)
}

fn stretches(text: &str, bytes: usize) -> Vec<Range<usize>> {
    let mut stretches = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let end = line_with_an_entity(text, start + bytes);
        stretches.push(start..end);
        start = end;
    }
    stretches
}

/// Where the first line from the next on begins that begins an entity, else where the text ends.
fn line_with_an_entity(text: &str, from: usize) -> usize {
    let bytes = text.as_bytes();
    let mut at = from;
    while let Some(end) = bytes.get(at..).and_then(|rest| rest.iter().position(|&byte| byte == b'\n')) {
        at += end + 1;
        let word = bytes[at..].split(u8::is_ascii_whitespace).next().unwrap_or_default();
        if begins_an_entity(word) {
            return at;
        }
    }
    text.len()
}

/// Leaves out all words up to the next that begins an entity.
fn pass_over(tokens: &mut Tokens) {
    while tokens.peek().is_some_and(|token| !begins_an_entity(token.word.as_bytes())) {
        tokens.take();
    }
}

/// What was read so far.
#[derive(Default)]
struct Reader {
    views: Vec<Camera>,
    background: Option<DVec3>,
    lamps: Lamps,
    fills: Fills,
    solids: Solids,
    ignored: Ignored,
    sink: Sink,
    /// Whether other programs' shapes are left out, where they would be errors.
    skip_unsupported: bool,
}

impl Reader {
    /// Reads a stretch of the text.
    fn of(text: &str, stretch: Range<usize>, options: &ReadOptions) -> Self {
        let mut reader = Self { skip_unsupported: options.skip_unsupported, ..Self::default() };
        let mut tokens = Tokens::new(text, stretch);
        while let Some(keyword) = tokens.take() {
            if reader.sink.is_full() {
                break;
            }
            if reader.entity(keyword, &mut tokens).is_err() {
                // What follows up to the next entity belongs to the one that is wrong.
                pass_over(&mut tokens);
            }
        }
        reader
    }

    /// Reads nothing of a file of Sense8's, and says so.
    fn of_another_format(keyword: NffToken) -> Self {
        let mut reader = Self::default();
        let message = "this is another format that is called NFF: that of Sense8's WorldToolKit";
        let error = Diagnostic::error(keyword.span(), message).label("here it says so");
        reader.sink.report(error.help(
            "ray13 reads Eric Haines's Neutral File Format: write each polygon as `p`, the number of its corners \
             and their coordinates",
        ));
        reader
    }

    /// The same with what follows in the file.
    fn append(&mut self, mut next: Self) {
        self.views.append(&mut next.views);
        self.background = next.background.or(self.background);
        self.lamps.append(next.lamps);
        let ids = self.fills.append(next.fills);
        self.solids.append(next.solids, &ids);
        self.ignored.append(next.ignored);
    }

    fn entity<'a>(&mut self, keyword: NffToken<'a>, tokens: &mut Tokens<'a>) -> Result<(), Reported> {
        let mut entity = Entity { keyword, tokens, sink: &mut self.sink, ignored: &mut self.ignored };
        match keyword.word {
            "v" => self.views.push(view::camera(&mut entity)?),
            "b" => self.background = Some(entity.color()?),
            "l" => self.lamps.read(&mut entity)?,
            "f" => self.fills.read(&mut entity)?,
            "s" => self.solids.sphere(&mut entity, &mut self.fills)?,
            "c" => self.solids.tube(&mut entity, &mut self.fills)?,
            "p" => self.solids.face(&mut entity, &mut self.fills)?,
            "pp" => self.solids.patch(&mut entity, &mut self.fills)?,
            "tt" => self.solids.textured_triangle(&mut entity, &mut self.fills)?,
            "ttp" => self.solids.textured_triangle_patch(&mut entity, &mut self.fills)?,
            "tpp" => self.solids.textured_patch(&mut entity, &mut self.fills)?,
            "shader" => entity.texture_name()?,
            "tess" => {
                entity.numbers(["the number of divisions"])?;
                entity.ignored.add(Extra::Tessellation, keyword.span());
            }
            word => match OTHER_SHAPES.iter().find(|(shape, _)| *shape == word) {
                Some((_, what)) => self.other_shape(keyword, tokens, what)?,
                None => return Err(self.no_entity(keyword)),
            },
        }
        Ok(())
    }

    fn other_shape(&mut self, keyword: NffToken, tokens: &mut Tokens, what: &str) -> Result<(), Reported> {
        if self.skip_unsupported {
            self.ignored.add(Extra::Shape, keyword.span());
            pass_over(tokens);
            return Ok(());
        }
        let message = format!("`{}`, {what}, is not of NFF but of other programs", keyword.word);
        let error =
            Diagnostic::error(keyword.span(), message).label("this is left out with --skip-unsupported");
        Err(self
            .sink
            .report(error.help("write its faces as `p`, the number of corners and their coordinates")))
    }

    fn no_entity(&mut self, token: NffToken) -> Reported {
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
        let mut scene = Scene { views: self.views, ..Scene::default() };
        scene.world.background = self.background.unwrap_or(scene.world.background);
        let any_left_out = self.solids.any_left_out() || self.ignored.any(Extra::Shape);
        scene.objects = self.solids.finish(&mut self.sink);
        scene.materials = self.fills.finish(&mut self.sink);
        // Beside errors it does not matter what is ignored.
        if self.sink.is_clean() {
            self.ignored.finish(&mut self.sink);
        }
        self.lamps.finish(&mut scene);
        if scene.objects.is_empty() && self.sink.is_clean() {
            self.sink.report(if any_left_out {
                // The notes say why.
                Diagnostic::error(0..0, "nothing is left of the scene: all that it shows is left out")
            } else {
                Diagnostic::error(0..0, "the scene is empty: there is nothing to see in it")
                    .help("a file of NFF shows spheres `s`, cones `c`, polygons `p` and patches `pp`")
            });
        }
        scene.notes = self.sink.finish(name, text)?;
        Ok(scene)
    }
}
