//! A part of a picture as a file: a line of JSON that says of which picture it is, and the dots of its tiles;
//! all of it in gzip, so that what is cut short or damaged is found out.

use std::io::{self, BufRead, BufReader, Read, Write};

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use serde_json::{Value, json};

use crate::frame::{Frame, MOST_DOTS};
use crate::math::Size;
use crate::view::TileShare;

use super::digest::PictureDigest;
use super::dots::{DotChannels, ShareDots};

/// The version that draws, and joins.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A longer line is none of a part: the options of a command are far shorter.
const MOST_ABOUT: u64 = 1 << 16;

/// What a part says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct PartAbout {
    /// Of which picture it is.
    pub picture: PictureDigest,
    /// Which of its tiles.
    pub share: TileShare,
    /// Columns and rows of the whole picture's dots.
    pub dots: Size,
    /// Which values there are of each.
    pub channels: DotChannels,
    /// How the picture is to be shown, as options of the command line: its dots do not depend on that.
    pub shown: Vec<String>,
}

/// A part of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePart {
    /// Of which picture it is.
    pub about: PartAbout,
    pub(super) dots: ShareDots,
}

/// Why a file is no part that can be joined.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// Something else.
    #[error("it is no part of a picture, as render --part writes it")]
    NotAPart,
    /// Drawn by another version, whose dots may differ.
    #[error("ray13 {0} drew it, and this is {VERSION}: draw all parts with one version")]
    OtherVersion(String),
    /// It ends too early, or goes on behind its end, or does not say what it was written to say.
    #[error("it is cut short or damaged: draw it again")]
    Damaged,
    /// The system's answer.
    #[error(transparent)]
    Io(io::Error),
}

impl PicturePart {
    /// The share of a drawn picture.
    pub fn of(frame: &Frame, picture: PictureDigest, share: TileShare, shown: Vec<String>) -> Self {
        let channels = DotChannels::of(frame);
        let about = PartAbout { picture, share, dots: frame.light.size(), channels, shown };
        Self { about, dots: ShareDots::of(frame, share) }
    }

    /// Writes it. The same part is the same bytes.
    pub fn write(&self, out: impl Write) -> io::Result<()> {
        // Light looks like noise: more effort makes it no smaller.
        let mut out = GzEncoder::new(out, Compression::fast());
        writeln!(out, "{}", self.about.value())?;
        self.dots.write(&mut out)?;
        out.finish()?.flush()
    }

    /// Reads one.
    pub fn read(from: impl Read) -> Result<Self, PartError> {
        let mut from = BufReader::new(MultiGzDecoder::new(from));
        let mut line = Vec::new();
        from.by_ref().take(MOST_ABOUT).read_until(b'\n', &mut line).map_err(|error| match error.kind() {
            // Not even the head of a gzip file.
            io::ErrorKind::InvalidInput => PartError::NotAPart,
            _ => damage(error),
        })?;
        let about = serde_json::from_slice(&line).map_err(|_| PartError::NotAPart)?;
        let about = PartAbout::from_value(&about)?;
        let tiles = about.share.tiles(about.dots);
        let dots = tiles.iter().map(|tile| tile.size.area()).sum();
        let dots = ShareDots::read(dots, about.channels, &mut from).map_err(damage)?;
        // At the end the checksum is looked at, and what stands behind it would be read as a file of its own.
        match from.read(&mut [0]).map_err(damage)? {
            0 => Ok(Self { about, dots }),
            _ => Err(PartError::Damaged),
        }
    }
}

/// What an error means that comes up within a part.
fn damage(error: io::Error) -> PartError {
    match error.kind() {
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData => {
            PartError::Damaged
        }
        _ => PartError::Io(error),
    }
}

impl PartAbout {
    fn value(&self) -> Value {
        let Self { picture, share, dots, channels, shown } = self;
        let DotChannels { color, depth, normal, object } = channels;
        json!({
            "ray13": VERSION, "picture": picture.to_string(), "part": share.number(), "of": share.of(),
            "dots": [dots.width, dots.height], "color": color, "depth": depth, "normal": normal,
            "object": object, "shown": shown,
        })
    }

    fn from_value(value: &Value) -> Result<Self, PartError> {
        let version = value["ray13"].as_str().ok_or(PartError::NotAPart)?;
        if version != VERSION {
            return Err(PartError::OtherVersion(version.escape_debug().take(20).collect()));
        }
        let number = |value: &Value| value.as_u64().and_then(|number| u32::try_from(number).ok());
        let about = || {
            let dots = Size::new(number(&value["dots"][0])?, number(&value["dots"][1])?);
            let area = u64::from(dots.width) * u64::from(dots.height);
            Some(Self {
                picture: PictureDigest::from_digits(value["picture"].as_str()?)?,
                share: TileShare::new(number(&value["part"])?, number(&value["of"])?)?,
                dots: (1..=MOST_DOTS as u64).contains(&area).then_some(dots)?,
                channels: DotChannels {
                    color: value["color"].as_bool()?,
                    depth: value["depth"].as_bool()?,
                    normal: value["normal"].as_bool()?,
                    object: value["object"].as_bool()?,
                },
                shown: value["shown"]
                    .as_array()?
                    .iter()
                    .map(|v| Some(v.as_str()?.to_owned()))
                    .collect::<Option<_>>()?,
            })
        };
        about().ok_or(PartError::Damaged)
    }
}
