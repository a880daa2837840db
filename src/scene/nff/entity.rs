//! One entity of a file while it is read: its word, its numbers, and what is wrong with them.

use crate::math::DVec3;
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Reported, Sink};

use super::ignored::{Extra, Ignored};
use super::tokens::{NffToken, Tokens};

/// The words that begin entities, with what each is.
pub const ENTITIES: [(&str, &str); 8] = [
    ("v", "viewpoint"),
    ("b", "background"),
    ("l", "light"),
    ("f", "fill: colour and surface"),
    ("c", "cone or cylinder"),
    ("s", "sphere"),
    ("p", "polygon"),
    ("pp", "polygonal patch"),
];

/// What other programs add to them: BART's textured triangles, the textured patches, textures and facets that
/// Assimp reads.
const ADDED: [&str; 5] = ["tt", "ttp", "tpp", "shader", "tess"];

/// Shapes of other programs, with what each is: of ENFF, and of Assimp.
pub const OTHER_SHAPES: [(&str, &str); 7] = [
    ("pb", "a Bézier patch"),
    ("pn", "a NURBS surface"),
    ("pnn", "a NURBS surface"),
    ("tet", "a tetrahedron"),
    ("hex", "a hexahedron"),
    ("oct", "an octahedron"),
    ("dod", "a dodecahedron"),
];

/// Whether a word begins an entity, of whatever program.
pub fn begins_an_entity(word: &[u8]) -> bool {
    let known = ENTITIES.iter().chain(&OTHER_SHAPES).map(|(known, _)| known).chain(&ADDED);
    known.into_iter().any(|known| known.as_bytes() == word)
}

/// A number and where it stands.
#[derive(Clone, Copy, Debug)]
pub struct NumberToken<'a> {
    /// Finite.
    pub value: f64,
    /// Its word.
    pub token: NffToken<'a>,
}

/// An entity whose numbers are being read.
#[derive(Debug)]
pub struct Entity<'r, 'a> {
    /// The word that began it.
    pub keyword: NffToken<'a>,
    /// What follows.
    pub tokens: &'r mut Tokens<'a>,
    /// Where remarks go.
    pub sink: &'r mut Sink,
    /// Where it is counted what nothing is shown of.
    pub ignored: &'r mut Ignored,
}

impl<'a> Entity<'_, 'a> {
    /// Takes a finite number, or reports what stands in its place. A word that is no number stays the next.
    #[inline]
    pub fn number(&mut self, name: impl Fn() -> String) -> Result<NumberToken<'a>, Reported> {
        let Some(token) = self.tokens.peek() else { return Err(self.cut_off(&name())) };
        match token.number() {
            // `inf` and `nan` are numbers for Rust; here they are words.
            Some(value) if value.is_finite() && token.begins_a_number() => {
                self.tokens.take();
                Ok(NumberToken { value, token })
            }
            _ => Err(self.no_number(token, &name())),
        }
    }

    /// Takes one number for each name.
    pub fn numbers<const N: usize>(&mut self, names: [&str; N]) -> Result<[NumberToken<'a>; N], Reported> {
        let mut found = [NumberToken { value: 0.0, token: self.keyword }; N];
        for (number, name) in found.iter_mut().zip(names) {
            *number = self.number(|| name.to_owned())?;
        }
        Ok(found)
    }

    /// Takes the three numbers of a point or a direction.
    #[inline]
    pub fn vector(&mut self, name: impl Fn() -> String) -> Result<DVec3, Reported> {
        let mut vector = DVec3::ZERO;
        for axis in 0..3 {
            vector[axis] = self.number(|| format!("{} of {}", ["x", "y", "z"][axis], name()))?.value;
        }
        Ok(vector)
    }

    /// Takes a colour, each channel 0 or more.
    pub fn color(&mut self) -> Result<DVec3, Reported> {
        let channels = self.numbers(["red", "green", "blue"])?;
        for channel in channels {
            self.check(channel, channel.value >= 0.0, "a colour is not negative")?;
        }
        Ok(DVec3::from_array(channels.map(|channel| channel.value)))
    }

    /// Ignores a texture's name, which is on the line of the keyword: a name could be any word, and a line
    /// that begins with an entity's word has to begin that entity.
    pub fn texture_name(&mut self) -> Result<(), Reported> {
        match self.tokens.peek_on_line(self.keyword.span().end) {
            Some(name) => {
                self.tokens.take();
                self.ignored.add(Extra::Texture, name.span());
                Ok(())
            }
            None => Err(self.wrong(self.keyword, "the texture's name is missing on this line")),
        }
    }

    /// Reports a number that breaks a rule.
    pub fn check(&mut self, number: NumberToken, holds: bool, rule: &str) -> Result<(), Reported> {
        if holds { Ok(()) } else { Err(self.wrong(number.token, rule)) }
    }

    /// Reports a number that breaks a rule, or the whole entity by its keyword.
    pub fn wrong(&mut self, token: NffToken, rule: &str) -> Reported {
        let error = Diagnostic::error(token.span(), format!("`{}`: {rule}", self.keyword.word));
        let is_number = token != self.keyword;
        let label = if is_number { format!("this is {}", token.shown()) } else { String::new() };
        self.sink.report(error.label(label))
    }

    /// Reports that the file ends before the entity does.
    pub fn cut_off(&mut self, missing: &str) -> Reported {
        let message = format!("the file ends within `{}`", self.keyword.word);
        let error = Diagnostic::error(self.keyword.span(), message).label(format!("{missing} is missing"));
        self.sink.report(error.help("the file is cut off: get it again whole, or take this entity out"))
    }

    fn no_number(&mut self, token: NffToken<'a>, missing: &str) -> Reported {
        let entity = self.keyword.word;
        if begins_an_entity(token.word.as_bytes()) {
            let message = format!("`{entity}` ends too early: {missing} is missing");
            let error = Diagnostic::error(token.span(), message);
            return self.sink.report(error.label(format!("here `{}` begins", token.word)));
        }
        self.tokens.take();
        let infinite = token.begins_a_number() && token.word.parse::<f64>().is_ok();
        let message = if infinite {
            format!("{missing} of `{entity}` is beyond the largest number that there is")
        } else {
            format!("{missing} of `{entity}` is no number")
        };
        let error = Diagnostic::error(token.span(), message);
        self.sink.report(error.label(format!("this is `{}`", token.shown())))
    }
}
