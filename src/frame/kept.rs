//! The last picture, kept by the studio: what a request shares with it is not computed again.

use std::sync::PoisonError;
use std::time::Duration;

use crate::plan::Options;
use crate::stage::{Counts, StageTimes};

use super::{Frame, Request, Studio};

/// A picture, all that was made of it, and what it answers.
#[derive(Debug)]
pub(super) struct Kept {
    request: Request,
    frame: Frame,
}

impl Studio {
    /// As much of the last picture as serves a request; absent where its dots have to be traced. Nothing was counted
    /// in it, and it took no time.
    pub(super) fn reused(&self, request: &Request) -> Option<Frame> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let Kept { request: last, frame } = kept.as_ref()?;
        let wants = request.wants;
        let enough = (!wants.depth || frame.depth.is_some())
            && (!wants.normal || frame.normal.is_some())
            && (!wants.object || frame.object.is_some());
        (enough && request.has_dots_of(last)).then(|| Frame {
            cells: frame.cells.clone().filter(|_| request.has_cells_of(last)),
            counts: Counts::default(),
            times: StageTimes::default(),
            trace: Duration::ZERO,
            total: Duration::ZERO,
            ..frame.clone()
        })
    }

    /// Keeps a picture in place of the last one.
    pub(super) fn keep(&self, request: &Request, frame: &Frame) {
        let kept = Kept { request: request.clone(), frame: frame.clone() };
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }

    /// Gives the last picture up: the next one may have its memory.
    pub(super) fn given_up(&self) -> Option<Frame> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner).take();
        kept.map(|kept| kept.frame)
    }
}

impl Request {
    /// What the plan is made from.
    pub(super) fn planned(&self) -> Options {
        Options { color: self.wants_color(), ..self.options }
    }

    fn has_dots_of(&self, other: &Self) -> bool {
        self.camera == other.camera
            && self.dots == other.dots
            && self.dot_aspect == other.dot_aspect
            && self.planned() == other.planned()
    }

    fn has_cells_of(&self, other: &Self) -> bool {
        (self.glyphs, self.palette, self.tone) == (other.glyphs, other.palette, other.tone)
    }
}

impl Frame {
    /// The same with what is wanted, and nothing more.
    pub(super) fn only(self, request: &Request) -> Self {
        let wants = request.wants;
        Self {
            cells: self.cells.filter(|_| wants.cells),
            depth: self.depth.filter(|_| wants.depth),
            normal: self.normal.filter(|_| wants.normal),
            object: self.object.filter(|_| wants.object),
            ..self
        }
    }
}
