//! Parts that become a picture again.

use std::collections::BTreeMap;

use crate::frame::Frame;

use super::dots::ShareDots;
use super::part::{PartAbout, PicturePart};

/// A picture to which parts are added, in any order.
#[derive(Clone, Debug)]
pub struct Joining {
    /// What the first part said: all are of its picture.
    about: PartAbout,
    frame: Frame,
    /// By number what the parts that are there are called.
    names: BTreeMap<u32, String>,
}

/// Why parts are no picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JoinError {
    /// A part is of another picture than the first.
    #[error("{part}: it is of another picture than {first}: another scene, view, size or other options")]
    OtherPicture {
        /// The part that is.
        part: String,
        /// What it was to be joined with.
        first: String,
    },
    /// The picture is cut into another number of parts.
    #[error("{part}: it is one of {of} parts and {first} one of {first_of}: draw all as parts of one number")]
    OtherNumber {
        /// The part that is.
        part: String,
        /// How many it is one of.
        of: u32,
        /// What it was to be joined with.
        first: String,
        /// How many that is one of.
        first_of: u32,
    },
    /// Two parts have the same tiles, and other dots in them.
    #[error("{part}: it has other dots than {other}, which is the same part: one of two machines errs")]
    Differs {
        /// The one.
        part: String,
        /// The other.
        other: String,
    },
    /// Some are not there.
    #[error("{}", missing(.numbers, *.more, *.of))]
    Missing {
        /// Their numbers, the first few of them.
        numbers: Vec<u32>,
        /// How many there are besides.
        more: u32,
        /// How many there have to be.
        of: u32,
    },
}

/// So many of the parts that are missing are told by number: a line holds them.
const TOLD: usize = 8;

fn missing(numbers: &[u32], more: u32, of: u32) -> String {
    let told: Vec<String> = numbers.iter().map(|number| format!("{number}/{of}")).collect();
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    format!("not all parts are there: draw --part {}{more}", told.join(", "))
}

impl Joining {
    /// With a first part of this name.
    pub fn new(name: &str, part: PicturePart) -> Self {
        let PicturePart { about, dots } = part;
        let mut frame = about.channels.room(about.dots);
        dots.put_into(&mut frame, about.share);
        let names = BTreeMap::from([(about.share.number(), name.to_owned())]);
        Self { about, frame, names }
    }

    /// Adds a part. One that is there already may come again.
    pub fn add(&mut self, name: &str, part: PicturePart) -> Result<(), JoinError> {
        let PartAbout { share, .. } = part.about;
        let of_first = self.about.share;
        let (part_name, first) = (name.to_owned(), self.first().to_owned());
        if share.of() != of_first.of() && part.about.picture == self.about.picture {
            let (of, first_of) = (share.of(), of_first.of());
            return Err(JoinError::OtherNumber { part: part_name, of, first, first_of });
        }
        let like_first = PartAbout { share: of_first, ..part.about };
        if like_first != self.about {
            return Err(JoinError::OtherPicture { part: part_name, first });
        }
        if let Some(other) = self.names.get(&share.number()) {
            let is_same = ShareDots::of(&self.frame, share) == part.dots;
            let differs = || JoinError::Differs { part: part_name, other: other.clone() };
            return if is_same { Ok(()) } else { Err(differs()) };
        }
        part.dots.put_into(&mut self.frame, share);
        self.names.insert(share.number(), part_name);
        Ok(())
    }

    /// What the parts say of their picture; of the share only of how many it is one counts.
    pub const fn about(&self) -> &PartAbout {
        &self.about
    }

    /// The picture, without characters, when all parts are there.
    pub fn finish(self) -> Result<Frame, JoinError> {
        let of = self.about.share.of();
        let missing = of - self.names.len() as u32;
        if missing == 0 {
            return Ok(self.frame);
        }
        let absent = (1..=of).filter(|number| !self.names.contains_key(number));
        let numbers: Vec<u32> = absent.take(TOLD).collect();
        Err(JoinError::Missing { more: missing - numbers.len() as u32, numbers, of })
    }

    /// What the first part is called.
    fn first(&self) -> &str {
        self.names.get(&self.about.share.number()).map_or("", String::as_str)
    }
}
