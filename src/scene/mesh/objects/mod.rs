//! Formats of objects that name each other: 3MF and AMF, of XML in archives.

pub mod amf;
pub mod three_mf;
mod tree;
mod zip;

use crate::scene::Format;

/// The format of a file by its content.
pub fn format_of(bytes: &[u8]) -> Option<Format> {
    if !zip::is_zip(bytes) {
        return amf::is_amf(bytes).then_some(Format::Amf);
    }
    let archive = zip::ZipArchive::new(bytes).ok()?;
    if three_mf::is_three_mf(&archive) {
        return Some(Format::ThreeMf);
    }
    amf::entry(&archive).map(|_| Format::Amf)
}
