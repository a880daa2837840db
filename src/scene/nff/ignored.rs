//! What other programs add to the format and nothing is shown of: read, counted, and told in one note of each
//! kind.

use std::ops::Range;

use crate::scene::Diagnostic;
use crate::scene::diagnostic::Sink;

/// A kind of what is ignored.
#[derive(Clone, Copy, Debug)]
pub enum Extra {
    /// `yon`: how far is seen.
    FarPlane,
    /// `tess`: into how many facets a round surface is divided.
    Tessellation,
    /// A picture on a surface: its name behind `f`, or a whole entity with places in it.
    Texture,
    /// The ninth number of `f`, by which ENFF gives ambient light a share of its own.
    AmbientShare,
    /// An entity that other programs know, left out where the user asks for that.
    Shape,
}

impl Extra {
    const COUNT: usize = Self::Shape as usize + 1;

    /// Each kind, with what is ignored and what is done instead.
    const WORDS: [(Self, &str, &str); Self::COUNT] = [
        (Self::FarPlane, "`yon`", "what is far away is seen too"),
        (Self::Tessellation, "`tess`", "what is round is shown round"),
        (Self::Texture, "a texture", "the surface has the colour of its `f`"),
        (Self::AmbientShare, "the ninth number of `f`", "the share of ambient light is Kd"),
        (Self::Shape, "a shape that other programs know", "it is left out"),
    ];
}

/// Where the first of each kind stands, and how many there are.
#[derive(Debug, Default)]
pub struct Ignored {
    first: [Option<Range<usize>>; Extra::COUNT],
    counts: [usize; Extra::COUNT],
}

impl Ignored {
    /// Counts one.
    pub fn add(&mut self, extra: Extra, place: Range<usize>) {
        self.first[extra as usize].get_or_insert(place);
        self.counts[extra as usize] += 1;
    }

    /// Whether there is any of a kind.
    pub fn any(&self, extra: Extra) -> bool {
        self.counts[extra as usize] > 0
    }

    /// The same with what follows in the file.
    pub fn append(&mut self, next: Self) {
        for (first, next) in self.first.iter_mut().zip(next.first) {
            *first = first.take().or(next);
        }
        for (count, next) in self.counts.iter_mut().zip(next.counts) {
            *count += next;
        }
    }

    /// Leaves a note of each kind.
    pub fn finish(self, sink: &mut Sink) {
        for (kind, what, instead) in Extra::WORDS {
            let Some(place) = self.first[kind as usize].clone() else { continue };
            let times = match self.counts[kind as usize] {
                1 => String::new(),
                count => format!(" ({count} times, of which this is the first)"),
            };
            sink.note(Diagnostic::note(place, format!("{what} is ignored{times}: {instead}")));
        }
    }
}
