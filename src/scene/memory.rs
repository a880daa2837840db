//! How much memory a scene takes, counted while it is read: a scene too large for the machine is an error in
//! place of an abort, or of a machine that stands still.

use super::Diagnostic;
use super::diagnostic::{Reported, Sink};

/// Bytes that showing a primitive takes beside its place in the scene: its form for rays, its object, its
/// share of the boxes, and what is needed to build those at once. Peaks of 440 for cubes and 460 for
/// cylinders were measured: the table "How cost grows" of `docs/performance.md`, less what is in
/// [`super::Object`].
///
/// The sub-lattices of composite objects are not counted: however large the scene, they have bounds of their
/// own.
pub const ASSEMBLED: u64 = 480;

/// Bytes more that a solid of flat faces, or a mesh, takes: 420 for six faces and 1 200 for four triangles
/// were measured.
pub const ASSEMBLED_FACES: u64 = 450;

/// Bytes that showing a triangle of a mesh takes: between 190 of a mesh of four and 370 of one of many were
/// measured.
pub const ASSEMBLED_TRIANGLE: u64 = 330;

/// Bytes that showing a piece of a Bézier patch takes: its control points, twice while pieces are put
/// in order, and its share of the boxes.
pub const ASSEMBLED_PIECE: u64 = 1000;

/// Bytes more that an operator takes, in the scene and as expressions for rays: 800 were measured.
pub const ASSEMBLED_OPERATOR: u64 = 800;

/// What has been taken, and how much there may be.
#[derive(Debug)]
pub(crate) struct Memory {
    /// Bytes that may be taken.
    limit: u64,
    /// Bytes taken, by the scene as far as it is read and by what will show it.
    taken: u64,
    /// Bytes of the text.
    text: u64,
}

impl Memory {
    /// Of a text that is in memory itself; no `limit` is none.
    pub fn new(limit: Option<u64>, text: usize) -> Self {
        Self { limit: limit.unwrap_or(u64::MAX), taken: text as u64, text: text as u64 }
    }

    /// Counts what is taken.
    pub fn take(&mut self, bytes: u64) {
        self.taken = self.taken.saturating_add(bytes);
    }

    /// Bytes that may still be taken.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.taken)
    }

    /// Whether there is room for so much more.
    pub fn has_room_for(&self, bytes: u64) -> bool {
        self.taken.saturating_add(bytes) <= self.limit
    }

    /// The error of a scene for which there is no room, where `bytes` are all that is still needed.
    pub fn refuse_last(&self, bytes: u64, sink: &mut Sink) -> Reported {
        sink.report(too_little(self.limit, self.taken.saturating_add(bytes)))
    }

    /// The error of a scene for which there is no room: `bytes` more at this byte of the text.
    pub fn refuse(&self, bytes: u64, at: u32, sink: &mut Sink) -> Reported {
        // As the text began it will go on; what is held besides the scene, the text itself, is there already.
        let scene = (self.taken.saturating_add(bytes) - self.text) as f64;
        let share = f64::from(at.max(1)) / self.text.max(1) as f64;
        let whole = self.text.saturating_add((scene / share.min(1.0)) as u64);
        sink.report(too_little(self.limit, whole))
    }
}

/// The error of a scene that takes about `needed` bytes where `limit` may be taken.
pub(crate) fn too_little(limit: u64, needed: u64) -> Diagnostic {
    let message = format!("the scene takes more than the {} of memory that it may", in_words(limit));
    let needed = in_words(needed.max(limit.saturating_add(1)));
    let option = needed.replace(' ', "");
    Diagnostic::error(0..0, message).help(format!(
        "all of it would take about {needed}: allow that with --memory {option}, split the scene, or leave detail out \
         where it was exported"
    ))
}

/// Bytes as a person would say them, rounded up.
fn in_words(bytes: u64) -> String {
    let (unit, name) = match bytes {
        0..0x10_0000 => (1 << 10, "KiB"),
        0x10_0000..0x4000_0000 => (1 << 20, "MiB"),
        _ => (1 << 30, "GiB"),
    };
    let tenths = (bytes as f64 / f64::from(unit) * 10.0).ceil() / 10.0;
    // More than ten of a unit are said without tenths.
    if tenths < 10.0 { format!("{tenths} {name}") } else { format!("{} {name}", tenths.ceil()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn says_bytes_in_the_next_unit_up() {
        assert_eq!([0, 1000, 1 << 20, 13 << 30].map(in_words), ["0 KiB", "1 KiB", "1 MiB", "13 GiB"]);
        assert_eq!(in_words((1 << 30) + 1), "1.1 GiB");
        assert_eq!(in_words((521 << 20) + 1), "522 MiB");
    }

    #[test]
    fn expects_the_rest_to_be_like_the_beginning() {
        let mut memory = Memory::new(Some(100 << 20), 1 << 20);
        memory.take(50 << 20);
        assert!(memory.has_room_for(49 << 20) && !memory.has_room_for(50 << 20));
        let mut sink = Sink::default();
        let Reported = memory.refuse(50 << 20, 1 << 18, &mut sink);
        let errors = sink.finish("test", "").expect_err("an error").to_string();
        assert!(errors.contains("100 MiB") && errors.contains("401 MiB"), "{errors}");
    }
}
