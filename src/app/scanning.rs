//! The viewer with Turbo off: what is known of a picture is shown dot by dot.

use std::time::Instant;

use super::AppError;
use super::scan::Scan;
use super::viewer::Viewer;
use crate::frame::Frame;

impl Viewer<'_> {
    /// Takes a finished picture; gives what is shown of it.
    pub(super) fn scanned(&mut self, frame: Frame, now: Instant) -> Frame {
        let wanted = self.drawing.refinement.shown().cloned();
        let (Some(request), false) = (wanted, self.model.pace.turbo) else {
            (self.scan, self.scan_due) = (None, None);
            return frame;
        };
        let scan = match self.scan.take() {
            Some(scan) if scan.is_of(&request) => scan.with(frame),
            before => Scan::new(request, frame, self.pace.megahertz(), now).after(before.as_ref()),
        };
        let so_far = scan.frame(now);
        self.scan_due = scan.due(now);
        self.scan = Some(scan);
        so_far
    }

    /// Shows more of the picture, where it is time, and has the ray in hand followed.
    pub(super) fn go_on_scanning(&mut self, now: Instant) -> Result<(), AppError> {
        if self.scan_due.is_none_or(|due| due > now) {
            return Ok(());
        }
        let Some(scan) = &self.scan else { return Ok(()) };
        self.scan_due = scan.due(now);
        let frame = scan.frame(now);
        if let Some(shown) = &mut self.shown {
            (shown.frame, shown.in_hand) = (frame, scan.in_hand(now));
        }
        match scan.order(now) {
            Some(order) => Ok(self.office.scan(order)?),
            None => Ok(()),
        }
    }

    /// Takes the pace that the keys have chosen.
    pub(super) fn change_pace(&mut self, now: Instant) {
        let pace = self.model.pace;
        if std::mem::replace(&mut self.pace, pace) == pace {
            return;
        }
        let Some(shown) = &mut self.shown else { return };
        match &mut self.scan {
            Some(scan) if !pace.turbo => scan.set_megahertz(pace.megahertz(), now),
            scan if pace.turbo => {
                if let Some(scan) = scan.take() {
                    (shown.frame, shown.in_hand) = (scan.whole(), None);
                }
                self.scan_due = None;
                return;
            }
            _ => {
                // What is shown is drawn once more.
                let frame = shown.frame.clone();
                let frame = self.scanned(frame, now);
                if let Some(shown) = &mut self.shown {
                    shown.frame = frame;
                }
            }
        }
        self.scan_due = self.scan.as_ref().and_then(|scan| scan.due(now));
    }
}
