//! What one setting costs and what it is worth.

use std::time::Duration;

use crate::frame::{Frame, Request, Studio, Wants};

use super::layers::Accuracy;
use super::reference::Reference;
use super::setting::Setting;
use super::timing::Times;

/// What one setting costs and what it is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Where the knobs stand.
    pub setting: Setting,
    /// How long its picture takes.
    pub times: Times,
    /// How far its picture is from the reference.
    pub accuracy: Accuracy,
    /// Whether it shows something else than the request on purpose, and does.
    pub is_another_picture: bool,
}

impl Measurement {
    /// Draws the picture of a setting twice, from the request's view and from that turned by a tenth of a
    /// dot, and compares it; `own` is that of the request's own setting. It has no times yet.
    pub fn new(studio: &Studio, reference: &Reference, setting: Setting, own: Option<&Self>) -> Self {
        let base = reference.base();
        let request = setting.request(base);
        let all = Wants { cells: request.wants.cells, ..Wants::ALL };
        let frame = studio.draw_anew(&Request { wants: all, ..request.clone() });
        let moved = request.wants.cells.then(|| studio.draw_anew(&reference.turned(&request)));
        let accuracy = reference.accuracy(&request, &frame, moved.as_ref());
        // A scene without mirrors shows the same without mirror rays.
        let meant = setting.shows_another_picture(&Setting::of(base));
        let differs = |own: &Self| {
            let meant_alone = setting.what_is_meant(&Setting::of(base));
            if meant_alone == setting {
                return own.accuracy.light != accuracy.light;
            }
            // What else it changes is not meant: the picture without that says.
            let request = meant_alone.request(base);
            let frame = studio.draw_anew(&Request { wants: all, ..request.clone() });
            own.accuracy.light != reference.accuracy(&request, &frame, None).light
        };
        let is_another_picture = meant && own.is_some_and(differs);
        Self { setting, times: Times::default(), accuracy, is_another_picture }
    }

    /// Draws the picture once more, as it was asked for, and takes its time.
    pub fn time(&mut self, studio: &Studio, base: &Request) -> Frame {
        let frame = studio.draw_anew(&self.setting.request(base));
        self.times.push(frame.total);
        frame
    }

    /// Its time: the median.
    pub fn cost(&self) -> Duration {
        self.times.median()
    }

    /// The share of dots with a wrong level, 0 to 1.
    pub fn wrong(&self) -> f64 {
        self.accuracy.light.wrong()
    }
}
