//! What a request shares with the last picture is not computed again.

use std::sync::PoisonError;
use std::time::Duration;

use crate::plan::Options;
use crate::stage::{Counts, StageTimes};

use super::frame_cache::{FrameCache, Hits};
use super::{Frame, Request, Studio};

/// What of the last picture serves a request.
#[derive(Debug, Default)]
pub(super) struct Reused {
    /// Its grids; absent where the light of the dots is to be computed.
    pub frame: Option<Frame>,
    /// What the dots see, or room for it; absent where that is not worth keeping.
    pub hits: Option<Hits>,
}

impl Studio {
    /// As much of the last picture as serves a request. Nothing was counted in it, and it took no time.
    ///
    /// Hits are kept from the second picture of a view on: a picture from elsewhere each time, as in a
    /// flight, would have nothing of them.
    pub(super) fn reused(&self, request: &Request) -> Reused {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(FrameCache { request: last, frame, hits }) =
            kept.as_mut().filter(|k| request.has_view_of(&k.request))
        else {
            return Reused::default();
        };
        let hits = hits.take();
        let serves = |frame: &&Frame| request.has_dots_of(last) && frame.has(request);
        let Some(frame) = frame.as_ref().filter(serves) else {
            return Reused { frame: None, hits: Some(hits.unwrap_or_default()) };
        };
        let frame = Frame {
            cells: frame.cells.clone().filter(|_| request.has_cells_of(last)),
            counts: Counts::default(),
            times: StageTimes::default(),
            trace: Duration::ZERO,
            total: Duration::ZERO,
            ..frame.clone()
        };
        Reused { frame: Some(frame), hits }
    }

    /// Keeps a picture in place of the last one.
    pub(super) fn keep(&self, request: &Request, frame: &Frame, hits: Option<Hits>) {
        let kept = FrameCache { request: request.clone(), frame: Some(frame.clone()), hits };
        *self.kept.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }

    /// Gives the last picture up: the next one may have its memory.
    pub(super) fn given_up(&self) -> Option<Frame> {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner).take();
        kept.and_then(|kept| kept.frame)
    }
}

impl Request {
    /// What the plan is made from.
    pub(super) fn planned(&self) -> Options {
        Options { color: self.wants_color(), ..self.options }
    }

    /// Whether the rays from the eye are those of another request, but for further samples.
    fn has_view_of(&self, other: &Self) -> bool {
        self.camera == other.camera && self.dots == other.dots && self.dot_aspect == other.dot_aspect
    }

    fn has_dots_of(&self, other: &Self) -> bool {
        self.has_view_of(other) && self.planned() == other.planned()
    }

    fn has_cells_of(&self, other: &Self) -> bool {
        (self.glyphs, self.palette, self.tone) == (other.glyphs, other.palette, other.tone)
    }
}

impl Frame {
    /// Whether it has what is wanted of its dots.
    fn has(&self, request: &Request) -> bool {
        let wants = request.wants;
        (!wants.depth || self.depth.is_some())
            && (!wants.normal || self.normal.is_some())
            && (!wants.object || self.object.is_some())
    }

    /// Whether its characters are wanted and not there.
    pub(super) fn lacks_cells(&self, request: &Request) -> bool {
        request.wants.cells && self.cells.is_none()
    }

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
